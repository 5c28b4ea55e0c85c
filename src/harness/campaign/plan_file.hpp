/// @file
/// The plan of a campaign as it lies in its directory, `plan.jsonl`: what status, merge and export go by.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/campaign/plan.hpp"

namespace bqsa::harness {

/// Relative to the directory of a campaign.
inline constexpr const char* kPlanFile = "plan.jsonl";

/// A plan that is larger is refused.
inline constexpr std::size_t kMostPlanBytes = std::size_t{1} << 32U;

/// One run of a stored plan.
struct ListedRun {
  std::string key;
  std::string scenario;  ///< name
  std::string variant;   ///< campaign_variant_name()
  int repetition = 1;
};

struct ListedPlan {
  std::string campaign;  ///< its name
  std::string program;   ///< version_text()
  std::vector<ListedRun> runs;
};

/// The first line, of schema bqsa-plan/1, names campaign, program and number of runs; a line a run follows.
/// The file appears whole or not at all. One with the same bytes is left as it is.
/// @throws InputError if the directory holds the plan of a campaign of another name, or cannot be
///   written to
void write_plan(const Plan& plan, const std::string& program,
                const std::filesystem::path& directory);

/// @throws InputError naming the file and line if there is none or it is not a whole plan
ListedPlan read_plan(const std::filesystem::path& directory);

/// Whether the directory is that of a campaign: it has a plan.
bool has_plan(const std::filesystem::path& directory);

/// Keys of its runs, in the plan's order; nothing if it has no plan.
/// @throws InputError as read_plan()
std::optional<std::vector<std::string>> planned_keys(const std::filesystem::path& directory);

}  // namespace bqsa::harness
