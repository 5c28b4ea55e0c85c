/// @file
/// The records of a campaign's directory: which are there, and one process that adds to them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "harness/pipe.hpp"
#include "harness/results/record_files.hpp"
#include "harness/results/result_store.hpp"

namespace bqsa::harness {

/// Of a directory, relative to it: whoever adds records has it.
inline constexpr const char* kLockFile = "lock";

/// One of so many equal parts of a campaign, see shard_of().
struct Shard {
  int number = 1;  ///< from 1
  int count = 1;   ///< 1: the whole campaign

  bool is_whole() const { return count == 1; }
};

/// Number of the shard of so many that has a run. Goes round, and starts one further each time, so that
/// no shard gets the runs of one slow method all.
/// @param run  index into the plan
inline int shard_of(std::size_t run, int count) {
  const auto shards = static_cast<std::size_t>(count);
  return static_cast<int>((run + run / shards) % shards) + 1;
}

/// Reads `k/N`.
/// @throws InputError unless 1 <= k <= N <= 100,000
Shard parse_shard(std::string_view text);

/// Files of a shard's records, relative to the campaign's directory: under way, and complete.
std::filesystem::path partial_file(const Shard& shard);
std::filesystem::path complete_file(const Shard& shard);

/// A line that is no record of a campaign.
struct BadLine {
  std::filesystem::path file;
  int number = 0;
  std::string why;
};

/// `<file>:<number>: <why>`
std::string text_of(const BadLine& line);

/// A record, as far as it matters to a campaign.
struct RecordLine {
  std::filesystem::path file;
  std::uint64_t offset = 0;  ///< of the line in the file [byte]
  std::string text;
  std::string key;  ///< empty for a run of no campaign
  bool applicable = true;
  bool success = false;
};

/// Goes through all records of a directory, in the order of record_files(), of which lines may be cut short.
/// @param visit  may throw InputError, too, for a line that is no record
/// @return the lines that are not records
/// @throws InputError for a file that cannot be read: then it is not known what is recorded
std::vector<BadLine> for_each_record(const std::filesystem::path& directory,
                                     const std::function<void(const RecordLine&)>& visit);

/// Removes trajectories that were being written when their process was killed. Nobody else must be at work.
void remove_left_over(const std::filesystem::path& directory);

/// A lock of the kernel's on a file, held by this process and gone with it, whatever ends it.
class FileLock {
 public:
  enum class Kind { kShared, kExclusive };

  /// @throws InputError if another process has it, naming it, or the file cannot be written
  FileLock(const std::filesystem::path& file, Kind kind);

  /// Process that has an exclusive lock on a file; 0 if there is none, or it is on another machine.
  static int holder(const std::filesystem::path& file);

 private:
  Descriptor file_;
};

/// Adds the records of a shard, or of a whole campaign, durably. Keeps every other process from doing the
/// same.
class CampaignLog {
 public:
  /// Makes the directory if needed; takes up what was left of the shard.
  /// @throws InputError if another process is at it, or it cannot be written to
  CampaignLog(const std::filesystem::path& directory, const Shard& shard);

  /// Whether the run of this key is recorded, in whichever file.
  bool has(const std::string& key) const { return runs_.contains(key); }

  /// Whether it is recorded and was not judged a success though it applies.
  bool has_failed(const std::string& key) const { return has(key) && runs_.at(key).failed; }

  /// Whether a file has it that is read after ours, so that a new record of ours would not count.
  bool has_elsewhere(const std::string& key) const { return has(key) && runs_.at(key).elsewhere; }

  const std::vector<BadLine>& bad_lines() const { return bad_lines_; }

  /// @throws InputError if it cannot be written
  void append(std::string_view record) { store_.append(record); }

  /// All runs are recorded: a shard's file takes the name of one that is complete.
  /// @throws InputError if it cannot
  void complete();

 private:
  std::filesystem::path directory_;
  Shard shard_;
  std::vector<FileLock> locks_;
  ResultStore store_;
  struct Recorded {
    bool failed = false;
    bool elsewhere = false;
  };
  std::unordered_map<std::string, Recorded> runs_;  ///< by key
  std::vector<BadLine> bad_lines_;
};

}  // namespace bqsa::harness
