/// @file
/// The outcome of an evaluation as a file, `claims.json` (docs/claims.md), from which all that is
/// printed or published is made.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "harness/claims/evaluation.hpp"
#include "harness/measuring/measurements.hpp"

namespace bqsa::harness::claims {

/// Where an evaluation comes from.
struct EvaluationOrigin {
  std::string command_line = {};
  std::string claims_file = {};
  bool full = false;
  BuildInfo build = {};
  MachineState machine = {};
  std::optional<MeasurementOrigin> measured = {};  ///< of the times; nothing if none were needed
};

/// A JSON object with everything: claims, figures, bounds, outcomes, verdicts, origin.
nlohmann::ordered_json claims_record(const std::vector<EvaluatedClaim>& claims,
                                     const EvaluationOrigin& origin);

/// @throws InputError naming the file if it is not what claims_record() made
nlohmann::ordered_json read_claims_record(const std::filesystem::path& file);

}  // namespace bqsa::harness::claims
