#include "harness/results/result_store.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <system_error>

#include "harness/trajectory_csv.hpp"

namespace bqsa::harness {
namespace {

constexpr const char* kTrajectories = "trajectories";

[[noreturn]] void refuse(const std::filesystem::path& path, int error) {
  throw InputError(
      fmt::format("{}: cannot write: {}", path.string(), std::generic_category().message(error)));
}

void make_writable_directory(const std::filesystem::path& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) refuse(directory, error.value());
  if (!std::filesystem::is_directory(directory)) refuse(directory, ENOTDIR);
  if (access(directory.c_str(), W_OK | X_OK) != 0) refuse(directory, errno);
}

off_t size_of(int file) {
  struct stat status {};
  return fstat(file, &status) == 0 ? status.st_size : 0;
}

bool is_regular(int file) {
  struct stat status {};
  return fstat(file, &status) == 0 && S_ISREG(status.st_mode);
}

bool ends_with_line_break(int file) {
  char last = '\n';
  const off_t size = size_of(file);
  return size == 0 || (pread(file, &last, 1, size - 1) == 1 && last == '\n');
}

}  // namespace

std::filesystem::path runs_file(const std::filesystem::path& directory) {
  return directory / kRunsFile;
}

ResultStore::ResultStore(const std::filesystem::path& directory,
                         const std::filesystem::path& records, Durability durability)
    : directory_(directory), records_(directory / records), durability_(durability) {
  make_writable_directory(directory_);
  make_writable_directory(records_.parent_path());
  make_writable_directory(directory_ / kTrajectories);
  constexpr mode_t kReadableByAll = 0644;
  file_ =
      open(records_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NONBLOCK, kReadableByAll);
  if (file_ < 0) refuse(records_, errno);
  if (!is_regular(file_)) {
    close(file_);
    throw InputError(fmt::format("{}: cannot write: not a regular file", records_.string()));
  }
  if (durability_ == Durability::kMachine) sync_file(records_.parent_path());
  if (!ends_with_line_break(file_)) append("");
}

ResultStore::~ResultStore() {
  if (file_ >= 0) close(file_);
}

void ResultStore::append(std::string_view record) {
  const std::string line = std::string(record) + '\n';
  const off_t before = size_of(file_);
  const ssize_t written = write(file_, line.data(), line.size());
  if (written < 0) refuse(records_, errno);
  if (static_cast<std::size_t>(written) == line.size()) {
    if (durability_ == Durability::kMachine && fdatasync(file_) != 0) refuse(records_, errno);
    return;
  }
  // Not if someone else has appended meanwhile: then the piece stays, and `show` reports it.
  const bool mine = size_of(file_) == before + written;
  if (!mine || ftruncate(file_, before) != 0) append("");
  refuse(records_, ENOSPC);
}

std::string trajectory_file(const std::string& scenario, const std::string& run) {
  return (std::filesystem::path(kTrajectories) / scenario / (run + ".csv")).string();
}

std::unique_ptr<StagedTextFile> stage_trajectory(const std::filesystem::path& directory,
                                                 const std::string& file,
                                                 const Trajectory& trajectory,
                                                 Durability durability) {
  const std::filesystem::path place = directory / file;
  make_writable_directory(place.parent_path());
  return std::make_unique<StagedTextFile>(place, trajectory_text(trajectory), durability);
}

void for_each_line(const std::filesystem::path& file,
                   const std::function<void(const StoredLine&)>& show) {
  std::error_code error;
  const bool regular = std::filesystem::is_regular_file(file, error);
  std::ifstream in;
  if (regular) in.open(file);
  if (!regular || !in) {
    throw InputError(
        fmt::format("{}: cannot read: not a file, or not a readable one", file.string()));
  }
  StoredLine line;
  while (std::getline(in, line.text)) {
    ++line.number;
    if (!line.text.empty()) show(line);
  }
}

std::vector<StoredLine> read_lines(const std::filesystem::path& file) {
  std::vector<StoredLine> lines;
  for_each_line(file, [&lines](const StoredLine& line) { lines.push_back(line); });
  return lines;
}

}  // namespace bqsa::harness
