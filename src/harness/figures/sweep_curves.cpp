#include "harness/figures/sweep_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/measuring/run_sweep.hpp"

namespace bqsa::harness {
namespace {

/// Whether there are at least two processes at some size.
bool has_intervals(const Sweep& sweep, const std::string& name) {
  const auto& seconds = sweep.find(name)->seconds;
  return std::any_of(seconds.begin(), seconds.end(),
                     [](const std::vector<double>& processes) { return processes.size() > 1; });
}

}  // namespace

const char* axis_name(const Sweep& sweep) {
  return sweep.axis == SweepAxis::kPointPairs ? "NM" : "nk";
}

const char* axis_label(const Sweep& sweep) {
  return sweep.axis == SweepAxis::kPointPairs
             ? "NM, test points of a link times those of an obstacle"
             : "nk, links times obstacles";
}

std::string fixed_text(const Sweep& sweep) {
  return sweep.axis == SweepAxis::kPointPairs
             ? fmt::format("nk = {}", sweep.sizes.front().pairs())
             : fmt::format("NM = {}", sweep.sizes.front().point_pairs());
}

std::string fixed_text(const Sweep& sweep, const MissRates& misses) {
  if (sweep.axis == SweepAxis::kPointPairs) return fixed_text(sweep);
  const std::string missed = miss_text(misses, sweep.sizes.front());
  return fixed_text(sweep) + (missed.empty() ? "" : ": " + missed);
}

std::string time_column(std::string_view series) { return fmt::format("{} [us]", series); }

CsvTable times_table(const Sweep& sweep, const std::vector<std::string>& names,
                     const MissRates& misses) {
  std::vector<std::string> columns = {axis_name(sweep)};
  for (const std::string& name : names) {
    columns.push_back(time_column(name));
    columns.push_back(fmt::format("{} lower [us]", name));
    columns.push_back(fmt::format("{} upper [us]", name));
  }
  if (!is_of_steps(sweep.name)) {
    columns.insert(columns.end(), kMissColumns.begin(), kMissColumns.end());
  }
  CsvTable table(columns);
  for (std::size_t size = 0; size < sweep.sizes.size(); ++size) {
    std::vector<CsvTable::Cell> cells = {sweep.at(size)};
    for (const std::string& name : names) {
      const double none = std::numeric_limits<double>::quiet_NaN();
      const bool measured = sweep.find(name)->measured(size);
      const Estimate time =
          measured ? time_of(sweep, name, size) : Estimate{none, Interval{none, none}};
      const bool bounded = std::isfinite(time.interval.upper);
      cells.emplace_back(time.value / kMicrosecond);
      cells.emplace_back(bounded ? time.interval.lower / kMicrosecond : none);
      cells.emplace_back(bounded ? time.interval.upper / kMicrosecond : none);
    }
    if (!is_of_steps(sweep.name)) {
      for (const double missed : missed_by_test_points(misses, sweep.sizes[size])) {
        cells.emplace_back(missed);
      }
    }
    table.add_row(cells);
  }
  return table;
}

std::string curve_with_bars(const Sweep& sweep, const std::string& name, const std::string& style,
                            const std::string& label) {
  std::string curve =
      fmt::format("name . \".csv\" using \"{}\":\"{} [us]\" with linespoints {} title \"{}\"",
                  axis_name(sweep), name, style, label);
  if (!has_intervals(sweep, name)) return curve;
  const std::string colour = style.substr(0, style.find(" linewidth"));
  return fmt::format(
      "name . \".csv\" using \"{0}\":\"{1} [us]\":\"{1} lower [us]\":\"{1} upper [us]\" with "
      "yerrorbars "
      "{2} linewidth 1.2 dashtype solid pointtype 0 notitle, \\\n  {3}",
      axis_name(sweep), name, colour, curve);
}

std::string upper_axis(const Sweep& sweep, const MissRates& misses) {
  return sweep.axis == SweepAxis::kPointPairs ? miss_axis(sweep, misses) : "";
}

}  // namespace bqsa::harness
