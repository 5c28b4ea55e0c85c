/// @file
/// The bulk of a page, scenes and replays, within limits.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/report/json.hpp"
#include "harness/report/run_index.hpp"
#include "harness/report/run_json.hpp"
#include "harness/report/scenario_finder.hpp"

namespace bqsa::harness::report {

/// What a page may hold.
struct PageLimits {
  int replays = 200;
  std::size_t bytes = std::size_t{20} << 20U;  ///< of scenes and replays, about
};

// NOLINTNEXTLINE(bugprone-exception-escape): as of PageData
struct PageScene {
  Json scene = {};  ///< null if there is none
  std::string missing = {};
  std::string description = {};  ///< of the scenario
};

// NOLINTNEXTLINE(bugprone-exception-escape): as of PageData
struct ScenesAndReplays {
  std::vector<PageScene> scenes;    ///< by scenario
  std::vector<ReplayPlace> places;  ///< by run
  Json replays = Json::array();
};

/// @param directory  the results, with the trajectories
ScenesAndReplays scenes_and_replays(const RunIndex& index, const std::filesystem::path& directory,
                                    const ScenarioFinder& finder, const PageLimits& limits);

}  // namespace bqsa::harness::report
