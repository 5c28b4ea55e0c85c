#include "harness/report/warnings.hpp"

#include <fmt/format.h>

#include <map>
#include <set>

namespace bqsa::harness::report {
namespace {

std::string counted(std::size_t count, std::string_view thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

/// The texts of one column of the origins of the runs.
std::set<std::string> texts_of(const std::vector<Origin>& origins, std::string_view column) {
  std::set<std::string> texts;
  for (const Origin& origin : origins) texts.insert(origin.text(column));
  return texts;
}

void warn_of_mixture(const std::vector<Origin>& origins, const char* column, const char* what,
                     std::vector<std::string>& warnings) {
  const std::set<std::string> texts = texts_of(origins, column);
  if (texts.size() < 2) return;
  warnings.push_back(fmt::format("runs of {} {}: {}", texts.size(), what, fmt::join(texts, "; ")));
}

bool is_modified(const Origin& origin) {
  const bool* const modified = std::get_if<bool>(&origin["modified"]);
  return modified != nullptr && *modified;
}

/// Runs by each reason why their times are only indicative.
std::map<std::string, std::size_t> reasons_against(const std::vector<IndexedRun>& runs) {
  std::map<std::string, std::size_t> reasons;
  for (const IndexedRun& run : runs) {
    for (const std::string& reason : run.row().against_times) ++reasons[reason];
  }
  return reasons;
}

void warn_of_what_is_missing(const ExportedRuns& runs, int planned,
                             std::vector<std::string>& warnings) {
  const int recorded = runs.runs + runs.not_applicable;
  if (recorded < planned) {
    warnings.push_back(
        fmt::format("the campaign is not complete: {} of {} runs are recorded", recorded, planned));
  }
  if (runs.stale > 0) {
    warnings.push_back(fmt::format(
        "left out: {} of another program, scenario or set of parameters than the campaign's plan",
        counted(static_cast<std::size_t>(runs.stale), "record")));
  }
  if (!runs.bad_lines.empty()) {
    warnings.push_back(fmt::format("left out: {} that {} no record",
                                   counted(runs.bad_lines.size(), "line"),
                                   runs.bad_lines.size() == 1 ? "is" : "are"));
  }
}

}  // namespace

std::vector<std::string> warnings(const ExportedRuns& runs, const RunIndex& index, int planned) {
  std::vector<std::string> warnings;
  for (const auto& [reason, count] : reasons_against(index.runs)) {
    warnings.push_back(
        fmt::format("times of {} are only indicative: {}", counted(count, "run"), reason));
  }
  for (const Origin& origin : runs.origins) {
    if (!is_modified(origin)) continue;
    warnings.emplace_back("the program was built from sources that differ from their commit");
    break;
  }
  warn_of_mixture(runs.origins, "processor", "processor models", warnings);
  warn_of_mixture(runs.origins, "source_commit", "commits of the program", warnings);
  warn_of_mixture(runs.origins, "compiler", "compilers", warnings);
  warn_of_mixture(runs.origins, "build_type", "build types", warnings);
  warn_of_what_is_missing(runs, planned, warnings);
  return warnings;
}

}  // namespace bqsa::harness::report
