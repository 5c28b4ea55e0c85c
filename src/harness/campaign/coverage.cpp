#include "harness/campaign/coverage.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <unordered_map>

#include "harness/results/record_value.hpp"
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

/// Copies the trajectory that a record names, if it has one and it is not there yet.
void copy_trajectory(const std::string& record, const fs::path& from, const fs::path& to) {
  const nlohmann::json json = nlohmann::json::parse(record);
  const RecordValue trajectory = RecordValue(json)["trajectory"];
  if (trajectory.is_null() || from == to) return;
  const fs::path name = json["trajectory"].get<std::string>();
  const bool inside =
      name.is_relative() &&
      std::none_of(name.begin(), name.end(), [](const fs::path& p) { return p == ".."; });
  if (!inside) trajectory.refuse("expected a file in the results directory");
  std::error_code error;
  if (!fs::exists(from / name, error) || fs::exists(to / name, error)) return;
  fs::create_directories((to / name).parent_path(), error);
  StagedTextFile(to / name, read_text_file(from / name, kMostTrajectoryBytes), Durability::kMachine)
      .commit();
}

/// Writes all records, in order, to a file that appears whole or not at all.
/// @param records  those that are missing are left out
void write_records(const std::vector<RecordPlace>& records, const fs::path& out) {
  const fs::path temporary = runs_file(out).string() + ".tmp";
  std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
  LineReader read;
  for (const RecordPlace& place : records) {
    if (place.is_missing()) continue;
    const std::string line = read(place);
    copy_trajectory(line, place.directory, out);
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

/// Shard files all of whose records are in `runs.jsonl` now, too.
void remove_merged_shards(const fs::path& out) {
  std::error_code error;
  for (const fs::path& file : record_files(out)) {
    if (file != runs_file(out)) fs::remove(file, error);
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

Coverage merge(std::vector<fs::path> directories, const fs::path& out) {
  std::error_code error;
  fs::create_directories(out, error);
  const FileLock lock(out / kLockFile, FileLock::Kind::kExclusive);
  const auto is_out = [&](const fs::path& d) { return fs::equivalent(d, out, error); };
  const bool in_place = std::any_of(directories.begin(), directories.end(), is_out);
  if (!in_place && has_plan(out)) directories.push_back(out);
  const Coverage before = coverage_of(directories);
  if (!has_plan(out)) {
    write_text_file(out / kPlanFile,
                    read_text_file(directories.front() / kPlanFile, kMostPlanBytes));
  }
  std::vector<RecordPlace> records = before.records;
  std::copy_if(before.stale.begin(), before.stale.end(), std::back_inserter(records),
               [&](const RecordPlace& place) { return is_out(place.directory); });
  write_records(records, out);
  remove_merged_shards(out);
  return coverage_of({out});
}

}  // namespace bqsa::harness
