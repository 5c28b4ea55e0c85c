/// @file
/// Campaign files (schema bqsa-campaign/1): which methods run how often on which scenarios.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/input_error.hpp"
#include "harness/isolated_run.hpp"
#include "harness/method_spec.hpp"

namespace bqsa::harness {

/// Scenarios that are generated, as `bqsa-bench generate` does it.
struct GeneratedScenarios {
  std::string family;
  std::uint64_t seed = 1;
  int count = 0;
  std::filesystem::path robots = "robots";  ///< directory of robot files, for spatial arms
};

/// No campaign has more runs.
inline constexpr int kMostRuns = 10'000'000;

/// Of which runs the trajectory is stored.
enum class KeptTrajectories { kAll, kFailures, kNone };

struct Campaign {
  std::filesystem::path file;
  std::string name;  ///< [a-z0-9_]+
  std::string description;
  std::vector<std::filesystem::path> scenarios;  ///< patterns expanded: files, each once, in order
  std::vector<GeneratedScenarios> generated;     ///< follow them
  std::vector<MethodSpec> methods;               ///< parameter grids expanded, each once
  int repetitions = 1;
  std::uint64_t seed = 1;  ///< from which the seeds of all runs are derived
  RunSettings settings;    ///< but for the seed
  RunLimits limits;
  KeptTrajectories trajectories = KeptTrajectories::kAll;
};

/// Whether a file says that it is a campaign: its top has `schema: bqsa-campaign/...`. A file that cannot be read says
/// nothing.
bool is_campaign_file(const std::filesystem::path& file);

/// Reads and validates a campaign file, scenario files excepted.
/// @param known  the methods that it may name
/// @throws InputError naming file, line, key, what was expected and what was found
Campaign load_campaign(const std::filesystem::path& file, const std::vector<MethodEntry>& known);

}  // namespace bqsa::harness
