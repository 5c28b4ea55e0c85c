#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "harness/campaign/coverage.hpp"
#include "harness/program/commands.hpp"

namespace bqsa::harness {
namespace fs = std::filesystem;
namespace {

std::string share_text(std::size_t part, std::size_t whole) {
  if (whole == 0) return "";
  return fmt::format(" ({:.1f} %)", 100 * static_cast<double>(part) / static_cast<double>(whole));
}

/// `runs.jsonl 120, shards/1-of-8.jsonl 40`, by the files that hold the counting records.
std::string files_text(const Coverage& coverage) {
  std::vector<std::pair<fs::path, int>> files;
  for (const RecordPlace& place : coverage.records) {
    if (place.is_missing()) continue;
    auto known = std::find_if(files.begin(), files.end(),
                              [&](const auto& file) { return file.first == place.file; });
    if (known == files.end()) known = files.insert(files.end(), {place.file, 0});
    ++known->second;
  }
  std::string text;
  for (const auto& [file, count] : files) {
    text += fmt::format("{}{} {}", text.empty() ? " in " : ", ", file.string(), count);
  }
  return text;
}

/// Who is adding records; empty if nobody is, as far as this machine knows.
std::string workers_text(const fs::path& directory) {
  std::string text;
  const auto add = [&](const fs::path& lock, const std::string& what) {
    const int process = FileLock::holder(lock);
    if (process > 0)
      text += fmt::format("{}process {} at {}", text.empty() ? "" : ", ", process, what);
  };
  add(directory / kLockFile, "all of it");
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(directory / "shards", none)) {
    if (entry.path().extension() == ".lock") add(entry.path(), entry.path().stem().string());
  }
  return text;
}

void report_bad_lines(const Coverage& coverage, const Console& console) {
  for (const BadLine& line : coverage.bad_lines) {
    console.error(text_of(line));
  }
}

}  // namespace

Status status_command(const fs::path& directory, const Console& console) {
  const Coverage coverage = coverage_of({directory});
  report_bad_lines(coverage, console);
  const std::size_t planned = coverage.records.size();
  const std::size_t missing = coverage.missing();
  const std::size_t recorded = planned - missing;
  const std::string workers = workers_text(directory);
  console.out
      << fmt::format("campaign   {}, by {}\n", coverage.plan.campaign, coverage.plan.program)
      << fmt::format("planned    {} runs\n", planned)
      << fmt::format("recorded   {}{}{}\n", recorded, share_text(recorded, planned),
                     files_text(coverage))
      << fmt::format("failed     {}{}\n", coverage.failed(),
                     share_text(coverage.failed(), recorded))
      << fmt::format("missing    {}\n", missing)
      << fmt::format("repeated   {} records of runs that have a later one\n", coverage.repeated)
      << fmt::format("stale      {} records of another program, scenario or method, not counted\n",
                     coverage.stale.size())
      << fmt::format("not whole  {} lines\n", coverage.bad_lines.size())
      << fmt::format("at work    {}\n", workers.empty() ? "nobody on this machine" : workers);
  return kOk;
}

Status missing_command(int shards, const fs::path& directory, const Console& console) {
  const Coverage coverage = coverage_of({directory});
  report_bad_lines(coverage, console);
  console.out << fmt::format("{}\n", fmt::join(incomplete_shards(coverage, shards), ","));
  return kOk;
}

Status merge_command(const std::vector<fs::path>& directories, const fs::path& out,
                     const Console& console) {
  const auto [merged, complaints] = merge(directories, out);
  for (const std::string& complaint : complaints) console.error(complaint);
  const std::size_t missing = merged.missing();
  console.out << fmt::format("{}: {} of {} runs, {} failed\n", out.string(),
                             merged.records.size() - missing, merged.records.size(),
                             merged.failed());
  if (missing == 0) return kOk;
  constexpr std::size_t kMostListed = 20;
  std::size_t listed = 0;
  for (std::size_t i = 0; i < merged.records.size() && listed < kMostListed; ++i) {
    if (!merged.records[i].is_missing()) continue;
    const ListedRun& run = merged.plan.runs[i];
    console.error(fmt::format("missing: {} {} repetition {} (run {})", run.scenario, run.variant,
                              run.repetition, run.key));
    ++listed;
  }
  if (missing > listed) console.error(fmt::format("and {} more", missing - listed));
  return kRunFailed;
}

}  // namespace bqsa::harness
