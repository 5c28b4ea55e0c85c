/// @file
/// The generated scenarios of a campaign, as files of its directory.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "harness/campaign/plan.hpp"

namespace bqsa::harness {

/// Sees to it that the scenarios lie in the directory. Since making one takes as long as some runs, those
/// that a list of hashes beside them, `<family>_s<seed>.sha256`, says to have been made before are not
/// made again, but for the first of each arm, which show whether generator and robots still make the
/// same.
/// @param made  called after each
/// @throws InputError if a file is there with other bytes, or one cannot be written
std::vector<PlannedScenario> generate_scenarios(const GeneratedScenarios& wanted,
                                                const std::filesystem::path& directory,
                                                const std::function<void()>& made);

}  // namespace bqsa::harness
