#include "harness/campaign/campaign_log.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "harness/results/record_value.hpp"

namespace bqsa::harness {
namespace fs = std::filesystem;
namespace {

constexpr const char* kShards = "shards";

std::string name_of(const Shard& shard) {
  return fmt::format("{}-of-{}", shard.number, shard.count);
}

/// Fills in what the text of a line says.
/// @throws InputError if it is no record
void read_record(RecordLine& line) {
  const nlohmann::json record = nlohmann::json::parse(line.text, nullptr, false);
  if (record.is_discarded()) throw InputError("cut short or damaged; left out");
  const RecordValue value(record);
  if (value["schema"].text() != "bqsa-run/1") value["schema"].refuse("expected bqsa-run/1");
  const bool in_campaign = value.has("campaign") && !value["campaign"].is_null();
  line.key = in_campaign ? value["campaign"]["key"].text() : "";
  line.applicable = !value["judged"].is_null();
  line.success = line.applicable && value["judged"]["success"].boolean();
}

/// A shard that was complete by a former plan is taken up again.
fs::path taken_up(const fs::path& directory, const Shard& shard) {
  if (shard.is_whole()) return kRunsFile;
  std::error_code error;
  const fs::path partial = directory / partial_file(shard);
  const fs::path complete = directory / complete_file(shard);
  if (!fs::exists(complete, error)) return partial_file(shard);
  if (fs::exists(partial, error)) {
    throw InputError(fmt::format("expected one of {} and {}, got both; merge puts them together",
                                 complete.string(), partial.string()));
  }
  fs::rename(complete, partial);
  return partial_file(shard);
}

std::vector<FileLock> locked(const fs::path& directory, const Shard& shard) {
  std::error_code error;
  fs::create_directories(shard.is_whole() ? directory : directory / kShards, error);
  std::vector<FileLock> locks;
  locks.emplace_back(directory / kLockFile,
                     shard.is_whole() ? FileLock::Kind::kExclusive : FileLock::Kind::kShared);
  if (!shard.is_whole()) {
    locks.emplace_back(directory / kShards / (name_of(shard) + ".lock"),
                       FileLock::Kind::kExclusive);
  }
  return locks;
}

/// Drops a last line that was cut short. What was being written when its process was killed is no result;
/// a whole record that only lacks its line break stays.
void drop_cut_line(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
  RecordLine last;
  for (std::string text; std::getline(in, text); last.text = std::move(text)) {
    begin = end;
    end += text.size() + 1;
  }
  std::error_code error;
  if (last.text.empty() || end <= fs::file_size(file, error)) return;
  try {
    read_record(last);
  } catch (const InputError&) {
    fs::resize_file(file, begin, error);
  }
}

/// The file to which records are added, ready for it.
fs::path opened(const fs::path& directory, const Shard& shard) {
  fs::path file = taken_up(directory, shard);
  drop_cut_line(directory / file);
  return file;
}

}  // namespace

Shard parse_shard(std::string_view text) {
  constexpr int kMostShards = 100'000;
  const auto whole_number = [&](std::string_view word) {
    int value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size() ? value : 0;
  };
  const std::size_t slash = text.find('/');
  Shard shard{0, 0};
  if (slash != std::string_view::npos) {
    shard = {whole_number(text.substr(0, slash)), whole_number(text.substr(slash + 1))};
  }
  if (shard.number < 1 || shard.number > shard.count || shard.count > kMostShards) {
    throw InputError(fmt::format("--shard: expected k/N, k from 1 to N and N at most {}, got {}",
                                 kMostShards, excerpt(text)));
  }
  return shard;
}

fs::path partial_file(const Shard& shard) {
  return fs::path(kShards) / (name_of(shard) + ".part.jsonl");
}

fs::path complete_file(const Shard& shard) {
  return fs::path(kShards) / (name_of(shard) + ".jsonl");
}

std::string text_of(const BadLine& line) {
  return fmt::format("{}:{}: {}", line.file.string(), line.number, line.why);
}

std::vector<BadLine> for_each_record(const fs::path& directory,
                                     const std::function<void(const RecordLine&)>& visit) {
  std::vector<BadLine> bad;
  const auto refuse = [](const fs::path& file) {
    throw InputError(
        fmt::format("{}: cannot read: not a file, or not a readable one", file.string()));
  };
  for (const fs::path& file : record_files(directory)) {
    if (!fs::is_regular_file(file)) refuse(file);  // a pipe would never end
    std::ifstream in(file, std::ios::binary);
    RecordLine line;
    line.file = file;
    std::uint64_t next = 0;
    for (int number = 1; std::getline(in, line.text); ++number) {
      line.offset = std::exchange(next, next + line.text.size() + 1);
      if (line.text.empty()) continue;
      try {
        read_record(line);
        visit(line);
      } catch (const InputError& error) {
        bad.push_back({file, number, error.what()});
      }
    }
    if (!in.is_open() || in.bad()) refuse(file);  // as a shard that has just ended
  }
  return bad;
}

void remove_left_over(const fs::path& directory) {
  std::error_code none;
  for (const auto& entry : fs::recursive_directory_iterator(directory / "trajectories", none)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".tmp") && name.find(".csv.") != std::string::npos) {
      fs::remove(entry.path(), none);
    }
  }
}

FileLock::FileLock(const fs::path& file, Kind kind) {
  constexpr mode_t kReadWrite = 0644;
  file_ = Descriptor(open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kReadWrite));
  if (file_.number() < 0) {
    throw InputError(
        fmt::format("{}: cannot write: {}", file.string(), std::generic_category().message(errno)));
  }
  struct flock lock {};
  lock.l_type = kind == Kind::kShared ? F_RDLCK : F_WRLCK;
  lock.l_whence = SEEK_SET;
  if (fcntl(file_.number(), F_SETLK, &lock) == 0) return;
  const int error = errno;
  if (error != EACCES && error != EAGAIN) {
    throw InputError(
        fmt::format("{}: cannot lock: {}", file.string(), std::generic_category().message(error)));
  }
  const int holder = FileLock::holder(file);
  throw InputError(fmt::format("{}: expected to be the only one here, but {} is at work",
                               file.string(),
                               holder > 0 ? fmt::format("process {}", holder) : "another process"));
}

int FileLock::holder(const fs::path& file) {
  const Descriptor opened(open(file.c_str(), O_RDONLY | O_CLOEXEC));
  struct flock lock {};
  lock.l_type = F_RDLCK;
  lock.l_whence = SEEK_SET;
  if (opened.number() < 0 || fcntl(opened.number(), F_GETLK, &lock) != 0) return 0;
  return lock.l_type == F_WRLCK ? std::max(static_cast<int>(lock.l_pid), 0) : 0;
}

CampaignLog::CampaignLog(const fs::path& directory, const Shard& shard)
    : directory_(directory),
      shard_(shard),
      locks_(locked(directory, shard)),
      store_(directory, opened(directory, shard), Durability::kMachine) {
  const fs::path ours = directory / (shard.is_whole() ? fs::path(kRunsFile) : partial_file(shard));
  bad_lines_ = for_each_record(directory, [&](const RecordLine& record) {
    Recorded& run = runs_[record.key];
    run.failed = record.applicable && !record.success;
    // `runs.jsonl` is read before all shards, the records of another process may be anywhere.
    run.elsewhere = run.elsewhere || (record.file != ours && record.file != runs_file(directory));
  });
  if (shard.is_whole()) remove_left_over(directory);
}

void CampaignLog::complete() {
  if (shard_.is_whole()) return;
  std::error_code error;
  fs::rename(directory_ / partial_file(shard_), directory_ / complete_file(shard_), error);
  if (error) {
    throw InputError(fmt::format("{}: cannot rename: {}",
                                 (directory_ / partial_file(shard_)).string(), error.message()));
  }
}

}  // namespace bqsa::harness
