/// @file
/// A results directory: `runs.jsonl`, one line a run, and `trajectories/`.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bqsa/method.hpp"
#include "harness/input_error.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {

inline constexpr const char* kRunsFile = "runs.jsonl";

/// Adds runs to a results directory. Lines are only ever appended.
class ResultStore {
 public:
  /// Makes the directory if needed and makes sure that it can be written to. A last line that was cut
  /// short is closed, so that new lines stand on their own.
  /// @param records  file of the records, relative to the directory, as are all files
  /// @throws InputError if it cannot be written to
  explicit ResultStore(const std::filesystem::path& directory,
                       const std::filesystem::path& records = kRunsFile,
                       Durability durability = Durability::kProgram);
  ~ResultStore();
  ResultStore(const ResultStore&) = delete;
  ResultStore& operator=(const ResultStore&) = delete;

  const std::filesystem::path& directory() const { return directory_; }

  /// Appends a record with one system call, so that whatever ends the program leaves whole lines;
  /// what was written of a record that does not fit is taken back.
  /// @throws InputError if it cannot be written
  void append(std::string_view record);

 private:
  std::filesystem::path directory_;
  std::filesystem::path records_;
  Durability durability_;
  int file_ = -1;
};

/// Path `trajectories/<scenario>/<run>.csv` of a trajectory, relative to the directory.
std::string trajectory_file(const std::string& scenario, const std::string& run);

/// Writes a trajectory, but leaves an older one in its place until it is committed.
/// @param file  trajectory_file()
/// @throws InputError if it cannot be written
std::unique_ptr<StagedTextFile> stage_trajectory(const std::filesystem::path& directory,
                                                 const std::string& file,
                                                 const Trajectory& trajectory,
                                                 Durability durability = Durability::kProgram);

/// One line of `runs.jsonl`.
struct StoredLine {
  int number = 0;  ///< counted from 1
  std::string text;
};

std::filesystem::path runs_file(const std::filesystem::path& directory);

/// Shows all lines that are not empty, whole or not, one after the other.
/// @throws InputError if there is no such file or it cannot be read
void for_each_line(const std::filesystem::path& file,
                   const std::function<void(const StoredLine&)>& show);

/// The lines of for_each_line().
std::vector<StoredLine> read_lines(const std::filesystem::path& file);

}  // namespace bqsa::harness
