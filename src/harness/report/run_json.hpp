/// @file
/// Runs, methods, scenarios and origins as a page has them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bqsa/method.hpp"
#include "harness/report/json.hpp"
#include "harness/report/run_index.hpp"

namespace bqsa::harness::report {

/// Where a run's replay is, or why there is none.
struct ReplayPlace {
  std::optional<std::size_t> index = {};
  std::string missing = {};
};

/// A `Run` of the schema.
Json run_json(const IndexedRun& run, const ReplayPlace& replay);

/// A `Method`.
/// @param runs   all of the page
/// @param index  of the method
/// @param known  the program's methods: what they say of themselves
Json method_json(const ExportedMethod& method, std::size_t index,
                 const std::vector<IndexedRun>& runs, const std::vector<MethodEntry>& known);

/// A `Scenario`.
Json scenario_json(const ExportedScenario& scenario, const std::string& description, Json scene,
                   const std::string& scene_missing);

/// An `Origin`.
Json origin_json(const Origin& origin);

}  // namespace bqsa::harness::report
