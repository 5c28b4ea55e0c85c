/// @file
/// What a directory holds of its plan, and putting several together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/campaign/campaign_log.hpp"
#include "harness/campaign/plan_file.hpp"

namespace bqsa::harness {

/// Where the record of a planned run is; of several the last.
struct RecordPlace {
  std::filesystem::path directory;
  std::filesystem::path file;  ///< empty: the run is missing
  std::uint64_t offset = 0;    ///< [byte]
  bool failed = false;         ///< applicable, and not judged a success

  bool is_missing() const { return file.empty(); }
};

struct Coverage {
  ListedPlan plan;
  std::vector<RecordPlace> records;  ///< by index into the plan
  std::size_t repeated = 0;          ///< records of runs that another one is of, too
  std::vector<RecordPlace> stale;  ///< records of no planned run: of another program, scenario, set
                                   ///< of parameters, or of no campaign
  std::vector<BadLine> bad_lines;
  std::vector<std::filesystem::path> files;  ///< that were read

  std::size_t missing() const;
  std::size_t failed() const;
};

/// @param directories  of one campaign, at least one
/// @throws InputError if one has no plan, or another one than the first
Coverage coverage_of(const std::vector<std::filesystem::path>& directories);

/// Numbers of the shards of which runs are missing.
std::vector<int> incomplete_shards(const Coverage& coverage, int shards);

struct Merged {
  Coverage coverage;  ///< what is now in `out`
  std::vector<std::string>
      complaints;  ///< about lines and trajectories that could not be taken along
};

/// Writes the records that there are in the order of the plan, `out/runs.jsonl`, with plan and trajectories.
/// What is in `out` already counts, but for runs that the directories have, too. Stale records in `out` are kept, after
/// the others. Once all is on the disk, shard files in `out` are removed, unless they have lines that are not
/// records; a `runs.jsonl` that has some is kept as `runs.damaged.jsonl`.
/// @throws InputError as coverage_of(), if a process is at work in `out`, or it cannot be written to
Merged merge(const std::vector<std::filesystem::path>& directories,
             const std::filesystem::path& out);

}  // namespace bqsa::harness
