#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/claims/estimator_lists.hpp"
#include "harness/claims/laboratory.hpp"

namespace bqsa::harness::claims {
namespace {

Figure figure_of(const char* name, const Estimate& estimate) {
  return {name, estimate.value, estimate.interval};
}

Findings nothing(std::string why) { return {.figures = {}, .remarks = {std::move(why)}}; }

/// The sweep if all the series were measured, else null and why not.
const Sweep* measured(const Arguments& arguments, Laboratory& laboratory,
                      std::initializer_list<const char*> series, std::string& why) {
  const Sweep* sweep = laboratory.sweep(arguments.text("sweep"));
  if (sweep == nullptr) {
    why = fmt::format("no sweep {} was measured", arguments.text("sweep"));
    return nullptr;
  }
  for (const char* name : series) {
    if (sweep->find(arguments.text(name)) != nullptr) continue;
    why = fmt::format("{} was not measured in sweep {}", arguments.text(name), sweep->name);
    return nullptr;
  }
  return sweep;
}

/// The sizes at which the series were measured, within the arguments `from` and `to`.
std::vector<std::size_t> sizes_of(const Sweep& sweep, const Arguments& arguments,
                                  std::initializer_list<const char*> series) {
  std::vector<std::size_t> sizes;
  for (std::size_t size = 0; size < sweep.sizes.size(); ++size) {
    const bool in_range =
        sweep.at(size) >= arguments.number("from") && sweep.at(size) <= arguments.number("to");
    const bool there = std::all_of(series.begin(), series.end(), [&](const char* name) {
      return sweep.find(arguments.text(name))->measured(size);
    });
    if (in_range && there) sizes.push_back(size);
  }
  return sizes;
}

/// Only the sizes named.
Sweep part_of(const Sweep& sweep, const std::vector<std::size_t>& sizes) {
  Sweep part{sweep.name, sweep.axis, {}, {}};
  for (const Series& series : sweep.series) part.series.push_back({series.name, {}, {}});
  for (const std::size_t size : sizes) {
    part.sizes.push_back(sweep.sizes[size]);
    for (std::size_t s = 0; s < sweep.series.size(); ++s) {
      part.series[s].seconds.push_back(sweep.series[s].seconds[size]);
    }
  }
  return part;
}

constexpr std::size_t kFewestSizes = 3;

Findings too_few() { return nothing("fewer than three sizes were measured in this range"); }

Findings time_growth(const Arguments& arguments, Laboratory& laboratory) {
  std::string why;
  const Sweep* sweep = measured(arguments, laboratory, {"series"}, why);
  if (sweep == nullptr) return nothing(why);
  const std::vector<std::size_t> sizes = sizes_of(*sweep, arguments, {"series"});
  if (sizes.size() < kFewestSizes) return too_few();
  const Sweep part = part_of(*sweep, sizes);
  const std::string& series = arguments.text("series");
  const LinearTime line = linear_time(part, series);
  const double range = part.at(sizes.size() - 1) - part.at(0);
  const double typical = line.intercept.value + line.slope.value * (part.at(0) + range / 2);
  const double scale = range / typical;
  return {
      .figures = {figure_of("exponent", time_exponent(part, series)),
                  {"r_squared", line.r_squared},
                  figure_of("slope", line.slope),
                  figure_of("intercept", line.intercept),
                  {"change", scale * line.slope.value,
                   Interval{scale * line.slope.interval.lower, scale * line.slope.interval.upper}}},
      .remarks = {}};
}

/// Of several sizes; the interval reaches as far down as that of any of them.
Estimate least_of(const std::vector<Estimate>& ratios) {
  Estimate least = ratios.front();
  for (const Estimate& one : ratios) {
    least.value = std::min(least.value, one.value);
    least.interval.lower = std::min(least.interval.lower, one.interval.lower);
    least.interval.upper = std::min(least.interval.upper, one.interval.upper);
  }
  return least;
}

/// As least_of(), the other way round.
Estimate most_of(const std::vector<Estimate>& ratios) {
  Estimate most = ratios.front();
  for (const Estimate& one : ratios) {
    most.value = std::max(most.value, one.value);
    most.interval.lower = std::max(most.interval.lower, one.interval.lower);
    most.interval.upper = std::max(most.interval.upper, one.interval.upper);
  }
  return most;
}

Findings time_ratios(const Arguments& arguments, Laboratory& laboratory) {
  std::string why;
  const Sweep* sweep = measured(arguments, laboratory, {"a", "b"}, why);
  if (sweep == nullptr) return nothing(why);
  const std::vector<std::size_t> sizes = sizes_of(*sweep, arguments, {"a", "b"});
  if (sizes.empty()) return nothing("no size was measured in this range");
  const std::string& a = arguments.text("a");
  const std::string& b = arguments.text("b");
  std::vector<Estimate> ratios;
  ratios.reserve(sizes.size());
  for (const std::size_t size : sizes) ratios.push_back(time_ratio(*sweep, a, b, size));
  return {.figures = {figure_of("first", ratios.front()), figure_of("last", ratios.back()),
                      figure_of("least", least_of(ratios)), figure_of("most", most_of(ratios))},
          .remarks = {fmt::format("at {} = {:.6g} to {:.6g}",
                                  sweep->axis == SweepAxis::kPointPairs ? "NM" : "nk",
                                  sweep->at(sizes.front()), sweep->at(sizes.back()))}};
}

/// Exponent of a ratio of times: the difference of two exponents from the same processes, each process
/// giving one of its own.
Findings ratio_growth(const Arguments& arguments, Laboratory& laboratory) {
  std::string why;
  const Sweep* sweep = measured(arguments, laboratory, {"a", "b"}, why);
  if (sweep == nullptr) return nothing(why);
  const std::vector<std::size_t> sizes = sizes_of(*sweep, arguments, {"a", "b"});
  if (sizes.size() < kFewestSizes) return too_few();
  Sweep part = part_of(*sweep, sizes);
  Series ratio{"ratio", part.find(arguments.text("a"))->seconds, {}};
  const Series& b = *part.find(arguments.text("b"));
  for (std::size_t size = 0; size < sizes.size(); ++size) {
    for (std::size_t p = 0; p < ratio.seconds[size].size(); ++p) {
      ratio.seconds[size][p] /= b.seconds[size][p];
    }
  }
  part.series.push_back(std::move(ratio));
  return {.figures = {figure_of("exponent", time_exponent(part, "ratio"))}, .remarks = {}};
}

Findings time_crossover(const Arguments& arguments, Laboratory& laboratory) {
  std::string why;
  const Sweep* sweep = measured(arguments, laboratory, {"a", "b"}, why);
  if (sweep == nullptr) return nothing(why);
  const std::optional<Estimate> found = crossover(*sweep, arguments.text("a"), arguments.text("b"));
  if (!found) return nothing("the times do not cross for good within the sizes measured");
  return {.figures = {figure_of("crossover", *found)}, .remarks = {}};
}

/// Ratio of two intervals of slopes, as wide as it can be; without bound where b's contains 0.
Findings slope_ratio(const Arguments& arguments, Laboratory& laboratory) {
  std::string why;
  const Sweep* sweep = measured(arguments, laboratory, {"a", "b"}, why);
  if (sweep == nullptr) return nothing(why);
  const std::vector<std::size_t> sizes = sizes_of(*sweep, arguments, {"a", "b"});
  if (sizes.size() < kFewestSizes) return too_few();
  const Sweep part = part_of(*sweep, sizes);
  const Estimate a = linear_time(part, arguments.text("a")).slope;
  const Estimate b = linear_time(part, arguments.text("b")).slope;
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  Interval interval{-kInfinite, kInfinite};
  if (a.interval.lower > 0 && b.interval.lower > 0) {
    interval = {a.interval.lower / b.interval.upper, a.interval.upper / b.interval.lower};
  }
  return {.figures = {{"ratio", a.value / b.value, interval}}, .remarks = {}};
}

}  // namespace

std::vector<Estimator> timing_estimators() {
  const ArgumentDeclaration sweep{"sweep", ArgumentKind::kText, {}, "name of a sweep"};
  const ArgumentDeclaration series{
      "series", ArgumentKind::kText, {}, "name of a detector or method"};
  const ArgumentDeclaration a{"a", ArgumentKind::kText, {}, "name of a detector or method"};
  const ArgumentDeclaration b{"b", ArgumentKind::kText, {}, "name of another"};
  const ArgumentDeclaration from{"from", ArgumentKind::kNumber, "0", "least NM or nk"};
  const ArgumentDeclaration to{"to", ArgumentKind::kNumber, "1e9", "largest NM or nk"};
  return {
      {.name = "time_growth",
       .what = "How the time of a series grows along the axis of a sweep",
       .timing = true,
       .arguments = {sweep, series, from, to},
       .figures = {{"exponent", "-", "slope of log(time) against log(axis)"},
                   {"r_squared", "-", "of the straight line through the times"},
                   {"slope", "s", "of that line, a unit of the axis", true},
                   {"intercept", "s", "of that line", true},
                   {"change", "-", "of the line over the range, as a part of its middle"}},
       .estimate = time_growth},
      {.name = "time_ratio",
       .what = "Time of a over time of b, both in the same process, at sizes in a range",
       .timing = true,
       .arguments = {sweep, a, b, from, to},
       .figures = {{"first", "-", "at the first size"},
                   {"last", "-", "at the last size"},
                   {"least", "-", "of all sizes, with the lowest limits of any"},
                   {"most", "-", "of all sizes, with the highest limits of any"}},
       .estimate = time_ratios},
      {.name = "ratio_growth",
       .what = "How the time of a over the time of b grows along the axis of a sweep",
       .timing = true,
       .arguments = {sweep, a, b, from, to},
       .figures = {{"exponent", "-", "slope of log(ratio) against log(axis)"}},
       .estimate = ratio_growth},
      {.name = "time_crossover",
       .what = "Where a starts to take longer than b and goes on to",
       .timing = true,
       .arguments = {sweep, a, b},
       .figures = {{"crossover", "-", "NM or nk; 0 if it does from the first size on"}},
       .estimate = time_crossover},
      {.name = "slope_ratio",
       .what = "Slope of the time of a over that of b along the axis of a sweep",
       .timing = true,
       .arguments = {sweep, a, b, from, to},
       .figures = {{"ratio", "-", "of the slopes"}},
       .estimate = slope_ratio},
  };
}

}  // namespace bqsa::harness::claims
