#include <fmt/core.h>

#include <ostream>
#include <utility>

#include "harness/campaign/stored_rows.hpp"
#include "harness/measuring/compare_times.hpp"
#include "harness/program/commands.hpp"
#include "harness/results/compare_runs.hpp"

namespace bqsa::harness {
namespace {

/// Unlike `show` it does without no line: what is missing could be what got worse.
std::vector<TableRow> read_runs(const std::filesystem::path& directory) {
  StoredRows stored = stored_rows(directory);
  if (!stored.bad_lines.empty()) throw InputError(text_of(stored.bad_lines.front()));
  return std::move(stored.rows);
}

}  // namespace

Status compare_command(const CompareOptions& options, const Console& console) {
  const bool directories = std::filesystem::is_directory(options.before);
  if (directories != std::filesystem::is_directory(options.after)) {
    throw InputError(
        fmt::format("{} and {}: expected two results directories or two files of Google "
                    "Benchmark's JSON, got one of each",
                    options.before.string(), options.after.string()));
  }
  const ComparisonSettings settings{.time_threshold = options.threshold};
  const ComparisonReport report =
      directories ? compare_runs(read_runs(options.before), read_runs(options.after), settings)
                  : compare_times(read_benchmark_file(options.before),
                                  read_benchmark_file(options.after), settings);
  console.out << render_comparison(report, options.all);
  return report.count(ComparisonFinding::kWorse) > 0 ? kRunFailed : kOk;
}

}  // namespace bqsa::harness
