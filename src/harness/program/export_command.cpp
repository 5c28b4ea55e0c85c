#include <fmt/core.h>

#include <array>
#include <optional>
#include <ostream>
#include <string>
#include <system_error>
#include <vector>

#include "harness/campaign/plan_file.hpp"
#include "harness/exchange/ompl_log.hpp"
#include "harness/exchange/planner_arena.hpp"
#include "harness/exchange/runs_benchmark.hpp"
#include "harness/exchange/runs_csv.hpp"
#include "harness/program/commands.hpp"
#include "harness/results/record_files.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

namespace fs = std::filesystem;

/// Nothing is exported over the records, nor two formats over each other.
void check_targets(const ExportOptions& options) {
  const std::array targets{options.ompl_log, options.planner_arena, options.csv,
                           options.google_benchmark};
  bool any = false;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (targets[i].empty()) continue;
    any = true;
    std::error_code missing;
    std::vector<fs::path> ours = record_files(options.directory);
    ours.push_back(options.directory / kPlanFile);
    for (const fs::path& file : ours) {
      if (fs::equivalent(targets[i], file, missing)) {
        throw InputError(
            fmt::format("{}: expected a file to export to, got the records", file.string()));
      }
    }
    for (std::size_t other = 0; other < i; ++other) {
      if (targets[i].lexically_normal() == targets[other].lexically_normal()) {
        throw InputError(fmt::format("{}: expected a file for each format, got one for two",
                                     targets[i].string()));
      }
    }
  }
  if (!any) {
    throw InputError(
        "expected --ompl-log, --planner-arena, --csv or --google-benchmark, got none of them");
  }
}

std::string counted(std::size_t count, const char* thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

void print_counts(const ExportedRuns& runs, std::ostream& out) {
  out << fmt::format("{} of {}\n", counted(static_cast<std::size_t>(runs.runs), "run"),
                     counted(runs.experiments.size(), "scenario"));
  const auto print = [&out](int count, const char* what) {
    if (count > 0) out << fmt::format("left out: {} {}\n", count, what);
  };
  print(runs.not_applicable, "not applicable");
  print(runs.superseded, "repeated later");
  print(runs.stale, "stale, not of the campaign's plan");
}

void write_formats(const ExportedRuns& runs, const ExportOptions& options, std::ostream& out) {
  if (!options.ompl_log.empty()) {
    const std::vector<fs::path> logs = write_ompl_logs(runs, options.ompl_log);
    out << fmt::format("{}: {}\n", options.ompl_log.string(), counted(logs.size(), "log"));
  }
  const auto written = [&out](const fs::path& file) { out << file.string() << '\n'; };
  if (!options.planner_arena.empty()) {
    write_planner_arena(runs, options.planner_arena);
    written(options.planner_arena);
  }
  if (!options.csv.empty()) {
    write_text_file(options.csv, runs_csv(runs));
    written(options.csv);
  }
  if (!options.google_benchmark.empty()) {
    write_text_file(options.google_benchmark, runs_benchmark_json(runs));
    written(options.google_benchmark);
  }
}

}  // namespace

Status export_command(const ExportOptions& options, const Console& console) {
  check_targets(options);
  const ExportedRuns runs = read_exported_runs(options.directory, planned_keys(options.directory));
  for (const std::string& line : runs.bad_lines) console.error(line);
  if (runs.experiments.empty()) {
    throw InputError(
        fmt::format("{}: expected runs that were judged, got none", options.directory.string()));
  }
  print_counts(runs, console.out);
  write_formats(runs, options, console.out);
  return runs.bad_lines.empty() ? kOk : kBadInput;
}

}  // namespace bqsa::harness
