/// @file
/// Runs what is missing of a campaign.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/campaign/campaign_log.hpp"
#include "harness/campaign/plan.hpp"
#include "harness/results/table_row.hpp"

namespace bqsa::harness {

struct CampaignOptions {
  int jobs = 1;  ///< processes side by side
  Shard shard;
  bool force = false;  ///< runs that are recorded, too
  std::optional<std::uint64_t>
      shuffle;               ///< seed of a random order of the runs; none: that of the plan
  LoadOptions load = {};     ///< of scenarios
  std::string command_line;  ///< as recorded
  std::vector<std::string> out_of_tree;  ///< likewise
};

/// What came of it.
struct CampaignOutcome {
  std::size_t planned = 0;        ///< runs of the shard
  std::size_t recorded = 0;       ///< of them, before
  std::size_t failed_before = 0;  ///< of those, not judged a success, and not run again
  std::size_t done = 0;           ///< now
  std::size_t failed = 0;         ///< of those, not judged a success
  std::size_t lost = 0;  ///< without a record: the process that was at it died, or could not do it
  int signal = 0;        ///< that put an end to it, else 0
};

/// Is told how it goes.
class CampaignWatcher {
 public:
  CampaignWatcher() = default;
  CampaignWatcher(const CampaignWatcher&) = delete;
  CampaignWatcher& operator=(const CampaignWatcher&) = delete;
  virtual ~CampaignWatcher() = default;

  virtual void begins(const CampaignOutcome& outcome) = 0;
  virtual void has_done(const CampaignOutcome& outcome, const TableRow& run) = 0;
  virtual void has_lost(const PlannedRun& run, const std::string& why) = 0;
  virtual void has_found(const BadLine& line) = 0;
};

/// Runs those runs of a shard that the directory has no record of, each in a process of its own, and
/// records each durably as soon as it is judged. Ends early, and says so, when one of StopSignals comes: runs
/// under way are then not recorded.
/// @param directory  made if missing; gets the plan
/// @throws InputError if it is in use, holds another campaign or cannot be written to; what is recorded
///   stays
CampaignOutcome run_campaign(const Plan& plan, const std::filesystem::path& directory,
                             const CampaignOptions& options, CampaignWatcher& watcher);

}  // namespace bqsa::harness
