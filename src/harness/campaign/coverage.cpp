#include "harness/campaign/coverage.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <unordered_map>

#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostTrajectoryBytes = std::size_t{1} << 30U;

/// Whether two plans list the same runs.
bool are_same(const ListedPlan& a, const ListedPlan& b) {
  return a.campaign == b.campaign &&
         std::equal(a.runs.begin(), a.runs.end(), b.runs.begin(), b.runs.end(),
                    [](const ListedRun& x, const ListedRun& y) { return x.key == y.key; });
}

ListedPlan common_plan(const std::vector<fs::path>& directories) {
  ListedPlan plan = read_plan(directories.front());
  for (const fs::path& other : directories) {
    if (!are_same(plan, read_plan(other))) {
      throw InputError(
          fmt::format("{}: expected the same plan as in {}, got another one: of another campaign, "
                      "program or set of "
                      "scenarios",
                      other.string(), directories.front().string()));
    }
  }
  return plan;
}

/// Reads lines of files by their place, each file being opened once as long as lines come from it.
class LineReader {
 public:
  std::string operator()(const RecordPlace& place) {
    if (file_ != place.file) {
      stream_ = std::ifstream(place.file, std::ios::binary);
      file_ = place.file;
    }
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(place.offset));
    std::string line;
    if (!std::getline(stream_, line)) {
      throw InputError(fmt::format("{}: cannot read", place.file.string()));
    }
    return line;
  }

 private:
  fs::path file_;
  std::ifstream stream_;
};

/// Copies the trajectory that a record names, if it has one. Whatever else a record may name is left alone.
/// @return why it could not; empty if it could
std::string copy_trajectory(const std::string& record, const fs::path& from, const fs::path& to) {
  const nlohmann::json json = nlohmann::json::parse(record, nullptr, false);
  const auto trajectory = json.find("trajectory");
  if (trajectory == json.end() || !trajectory->is_string()) return "";
  const fs::path name = fs::path(trajectory->get<std::string>()).lexically_normal();
  std::error_code error;
  if (name.begin() == name.end() || *name.begin() != "trajectories" ||
      fs::symlink_status(from / name, error).type() != fs::file_type::regular) {
    return fmt::format("{}: expected a trajectory in {}, found none", excerpt(name.string()),
                       (from / "trajectories").string());
  }
  fs::create_directories((to / name).parent_path(), error);
  try {
    StagedTextFile(to / name, read_text_file(from / name, kMostTrajectoryBytes),
                   Durability::kMachine)
        .commit();
  } catch (const InputError& refusal) {
    return refusal.what();
  }
  return "";
}

/// Writes records, in order, to a file that appears whole or not at all.
/// @param records  those that are missing are left out
void write_records(const std::vector<RecordPlace>& records, const fs::path& out,
                   std::vector<std::string>& complaints) {
  const fs::path temporary = runs_file(out).string() + ".tmp";
  std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
  LineReader read;
  for (const RecordPlace& place : records) {
    if (place.is_missing()) continue;
    const std::string line = read(place);
    if (!fs::equivalent(place.directory, out)) {
      const std::string complaint = copy_trajectory(line, place.directory, out);
      if (!complaint.empty()) complaints.push_back(complaint);
    }
    file << line << '\n';
  }
  file.close();
  std::error_code error;
  if (file) {
    sync_file(temporary);
    fs::rename(temporary, runs_file(out), error);
    sync_file(out);
  }
  if (!file || error) {
    fs::remove(temporary, error);
    throw InputError(fmt::format("{}: cannot write", runs_file(out).string()));
  }
}

bool has_bad_lines(const fs::path& file, const Coverage& coverage) {
  return std::any_of(coverage.bad_lines.begin(), coverage.bad_lines.end(),
                     [&](const BadLine& line) { return line.file == file; });
}

/// Shard files in `out` all of whose records are in `runs.jsonl` now, too.
void remove_merged_shards(const Coverage& before, const fs::path& out) {
  std::error_code error;
  for (const fs::path& file : before.files) {
    const bool shard_of_out = file.parent_path().parent_path() == out;
    if (shard_of_out && !has_bad_lines(file, before)) fs::remove(file, error);
  }
}

/// Lines that a merge does not take along may be of use to somebody.
void keep_damaged_runs(const Coverage& before, const fs::path& out) {
  std::error_code error;
  if (has_bad_lines(runs_file(out), before)) {
    fs::copy_file(runs_file(out), out / "runs.damaged.jsonl", fs::copy_options::overwrite_existing,
                  error);
    if (error) throw InputError(fmt::format("{}: cannot be kept", runs_file(out).string()));
  }
}

}  // namespace

std::size_t Coverage::missing() const {
  return static_cast<std::size_t>(std::count_if(
      records.begin(), records.end(), [](const RecordPlace& p) { return p.is_missing(); }));
}

std::size_t Coverage::failed() const {
  return static_cast<std::size_t>(
      std::count_if(records.begin(), records.end(), [](const RecordPlace& p) { return p.failed; }));
}

Coverage coverage_of(const std::vector<fs::path>& directories) {
  Coverage coverage;
  coverage.plan = common_plan(directories);
  coverage.records.resize(coverage.plan.runs.size());
  std::unordered_map<std::string, std::size_t> index_of;
  for (std::size_t i = 0; i < coverage.plan.runs.size(); ++i) {
    index_of.emplace(coverage.plan.runs[i].key, i);
  }
  for (const fs::path& directory : directories) {
    const std::vector<BadLine> bad = for_each_record(directory, [&](const RecordLine& line) {
      const auto planned = index_of.find(line.key);
      if (planned == index_of.end()) {
        coverage.stale.push_back({directory, line.file, line.offset});
        return;
      }
      RecordPlace& place = coverage.records[planned->second];
      if (!place.is_missing()) ++coverage.repeated;
      place = {directory, line.file, line.offset, line.applicable && !line.success};
    });
    coverage.bad_lines.insert(coverage.bad_lines.end(), bad.begin(), bad.end());
    const std::vector<fs::path> files = record_files(directory);
    coverage.files.insert(coverage.files.end(), files.begin(), files.end());
  }
  return coverage;
}

std::vector<int> incomplete_shards(const Coverage& coverage, int shards) {
  std::set<int> numbers;
  for (std::size_t i = 0; i < coverage.records.size(); ++i) {
    if (coverage.records[i].is_missing()) numbers.insert(shard_of(i, shards));
  }
  return {numbers.begin(), numbers.end()};
}

Merged merge(const std::vector<fs::path>& directories, const fs::path& out) {
  std::error_code error;
  fs::create_directories(out, error);
  const FileLock lock(out / kLockFile, FileLock::Kind::kExclusive);
  const auto is_out = [&](const fs::path& d) { return fs::equivalent(d, out, error); };
  std::vector<fs::path> sources;  // of several records of a run the last counts
  if (has_plan(out)) sources.push_back(out);
  std::copy_if(directories.begin(), directories.end(), std::back_inserter(sources),
               [&](const fs::path& directory) { return !is_out(directory); });
  const Coverage before = coverage_of(sources);
  if (!has_plan(out)) {
    const std::string plan = read_text_file(directories.front() / kPlanFile, kMostPlanBytes);
    StagedTextFile(out / kPlanFile, plan, Durability::kMachine).commit();
  }
  Merged merged;
  for (const BadLine& line : before.bad_lines) merged.complaints.push_back(text_of(line));
  std::vector<RecordPlace> records = before.records;
  std::copy_if(before.stale.begin(), before.stale.end(), std::back_inserter(records),
               [&](const RecordPlace& place) { return is_out(place.directory); });
  keep_damaged_runs(before, out);
  write_records(records, out, merged.complaints);
  remove_merged_shards(before, out);
  remove_left_over(out);
  merged.coverage = coverage_of({out});
  return merged;
}

}  // namespace bqsa::harness
