#include "harness/results/comparison_report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "harness/results/text_table.hpp"

namespace bqsa::harness {
namespace {

const char* name_of(ComparisonFinding finding) {
  switch (finding) {
    case ComparisonFinding::kTie:
      return "tie";
    case ComparisonFinding::kBetter:
      return "better";
    case ComparisonFinding::kWorse:
      return "WORSE";
    case ComparisonFinding::kUndecided:
      return "not decided";
  }
  return "?";
}

bool is_shown(const ComparedRow& row) {
  return row.differs || row.finding == ComparisonFinding::kBetter ||
         row.finding == ComparisonFinding::kWorse;
}

}  // namespace

int ComparisonReport::count(ComparisonFinding finding) const {
  return static_cast<int>(
      std::count_if(rows.begin(), rows.end(),
                    [finding](const ComparedRow& row) { return row.finding == finding; }));
}

double confidence_of_each(std::size_t comparisons) {
  return 1 - (1 - kConfidence) / static_cast<double>(std::max<std::size_t>(comparisons, 1));
}

ComparisonFinding finding_of_ratio(double ratio, const Interval& interval,
                                   const ComparisonSettings& settings) {
  const double most = settings.time_threshold;
  if (ratio > most && interval.lower > most) return ComparisonFinding::kWorse;
  if (ratio < 1 / most && interval.upper < 1 / most) return ComparisonFinding::kBetter;
  return ComparisonFinding::kTie;
}

std::string render_comparison(const ComparisonReport& report, bool all) {
  TextTable table({{.head = "what", .unit = {}, .left = true},
                   {.head = "quantity", .unit = {}, .left = true},
                   {.head = "old", .unit = {}},
                   {.head = "new", .unit = {}},
                   {.head = "change", .unit = {}},
                   {.head = "interval", .unit = {}, .left = false, .optional = true},
                   {.head = "p", .unit = {}, .left = false, .optional = true},
                   {.head = "finding", .unit = {}, .left = true}});
  bool any = false;
  for (const ComparedRow& row : report.rows) {
    if (!all && !is_shown(row)) continue;
    any = true;
    table.add_row({row.subject, row.quantity, row.before, row.after, row.change, row.interval,
                   row.p, name_of(row.finding)});
  }
  std::string text = any ? table.text() + '\n' : "";
  for (const std::string& note : report.notes) text += note + '\n';
  const int undecided = report.count(ComparisonFinding::kUndecided);
  text +=
      fmt::format("{} compared: {} ties, {} better, {} worse{}\n", report.rows.size(),
                  report.count(ComparisonFinding::kTie), report.count(ComparisonFinding::kBetter),
                  report.count(ComparisonFinding::kWorse),
                  undecided > 0 ? fmt::format(", {} not decided", undecided) : "");
  return text;
}

std::string time_text(double seconds) {
  struct Unit {
    const char* name;
    double seconds;
  };
  static constexpr std::array<Unit, 4> kUnits{{{"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}}};
  for (const Unit& unit : kUnits) {
    if (seconds >= unit.seconds)
      return fmt::format("{} {}", figure(seconds / unit.seconds), unit.name);
  }
  return fmt::format("{} ns", figure(seconds / kUnits.back().seconds));
}

std::string ratio_text(double ratio) { return fmt::format("x {:.3f}", ratio); }

std::string interval_text(const Interval& interval) {
  return fmt::format("{:.3f} .. {:.3f}", interval.lower, interval.upper);
}

std::string p_text(double p) {
  return p < 1e-3 ? fmt::format("{:.0e}", p) : fmt::format("{:.3f}", p);
}

}  // namespace bqsa::harness
