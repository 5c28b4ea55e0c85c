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

bool ends_with_line_break(int file) {
  char last = '\n';
  struct stat status {};
  if (fstat(file, &status) != 0 || status.st_size == 0) return true;
  return pread(file, &last, 1, status.st_size - 1) == 1 && last == '\n';
}

}  // namespace

std::filesystem::path runs_file(const std::filesystem::path& directory) {
  return directory / "runs.jsonl";
}

ResultStore::ResultStore(const std::filesystem::path& directory) : directory_(directory) {
  make_writable_directory(directory_);
  make_writable_directory(directory_ / kTrajectories);
  const std::filesystem::path runs = runs_file(directory_);
  constexpr mode_t kReadableByAll = 0644;
  file_ = open(runs.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, kReadableByAll);
  if (file_ < 0) refuse(runs, errno);
  if (!ends_with_line_break(file_)) append("");
}

ResultStore::~ResultStore() {
  if (file_ >= 0) close(file_);
}

std::string ResultStore::write_trajectory(const std::string& scenario, const std::string& variant,
                                          const Trajectory& trajectory) const {
  const std::filesystem::path relative =
      std::filesystem::path(kTrajectories) / scenario / (variant + ".csv");
  const std::filesystem::path file = directory_ / relative;
  make_writable_directory(file.parent_path());
  harness::write_trajectory(file, trajectory);
  return relative.string();
}

void ResultStore::append(std::string_view record) {
  const std::string line = std::string(record) + '\n';
  const ssize_t written = write(file_, line.data(), line.size());
  if (written < 0) refuse(runs_file(directory_), errno);
  if (static_cast<std::size_t>(written) < line.size()) refuse(runs_file(directory_), ENOSPC);
}

std::vector<StoredLine> read_lines(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in || std::filesystem::is_directory(file)) {
    throw InputError(fmt::format("{}: cannot read: no such file, or not readable", file.string()));
  }
  std::vector<StoredLine> lines;
  StoredLine line;
  while (std::getline(in, line.text)) {
    ++line.number;
    if (!line.text.empty()) lines.push_back(line);
  }
  return lines;
}

}  // namespace bqsa::harness
