/// @file
/// The scenario file that a record is of, wherever it may lie now.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/exchange/exported_runs.hpp"
#include "harness/scenario/scenario.hpp"

namespace bqsa::harness::report {

struct FoundScenario {
  std::optional<Scenario> scenario;
  std::string missing;  ///< why there is none; empty if there is one
};

class ScenarioFinder {
 public:
  /// @param roots  directories in which the recorded path, or an end of it, may be found
  ScenarioFinder(std::vector<std::filesystem::path> roots, const LoadOptions& options)
      : roots_(std::move(roots)), options_(options) {}

  /// Looks for the file as recorded and then below the roots, for longer ends of its path first. A file with
  /// other bytes than those that were run is not taken.
  FoundScenario find(const ExportedScenario& recorded) const;

 private:
  std::vector<std::filesystem::path> roots_;
  LoadOptions options_;
};

}  // namespace bqsa::harness::report
