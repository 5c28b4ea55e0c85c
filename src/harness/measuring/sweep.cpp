#include "harness/measuring/sweep.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace bqsa::harness {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

const Series& series_of(const Sweep& sweep, std::string_view name) {
  const Series* series = sweep.find(name);
  assert(series != nullptr);
  return *series;
}

/// Mean of the processes' estimates.
Estimate over_processes(const std::vector<double>& estimates) {
  assert(!estimates.empty());
  const auto n = static_cast<double>(estimates.size());
  const double mean = std::accumulate(estimates.begin(), estimates.end(), 0.0) / n;
  if (estimates.size() < 2) return {mean, {-kInfinity, kInfinity}};
  double squares = 0;
  for (const double estimate : estimates) squares += (estimate - mean) * (estimate - mean);
  const boost::math::students_t_distribution<> t(n - 1);
  const double width = quantile(t, (1 + kConfidence) / 2) * std::sqrt(squares / (n - 1) / n);
  return {mean, {mean - width, mean + width}};
}

/// Of an estimate of logarithms.
Estimate exponential(const Estimate& log) {
  return {std::exp(log.value), {std::exp(log.interval.lower), std::exp(log.interval.upper)}};
}

/// The sizes at which the series was measured, from one on.
std::vector<std::size_t> measured_sizes(const Series& series, std::size_t from = 0) {
  std::vector<std::size_t> sizes;
  for (std::size_t s = from; s < series.seconds.size(); ++s) {
    if (series.measured(s)) sizes.push_back(s);
  }
  return sizes;
}

std::size_t processes_of(const Series& series) {
  const std::vector<std::size_t> sizes = measured_sizes(series);
  return sizes.empty() ? 0 : series.seconds[sizes.front()].size();
}

struct Line {
  double intercept;
  double slope;
};

/// Least sum of ((y - intercept - slope x) / y)².
Line relative_line(const std::vector<double>& x, const std::vector<double>& y) {
  double w = 0, wx = 0, wy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double weight = 1 / (y[i] * y[i]);
    w += weight;
    wx += weight * x[i];
    wy += weight * y[i];
  }
  const double x_mean = wx / w;
  const double y_mean = wy / w;
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double weight = 1 / (y[i] * y[i]);
    xx += weight * (x[i] - x_mean) * (x[i] - x_mean);
    xy += weight * (x[i] - x_mean) * (y[i] - y_mean);
  }
  assert(xx > 0);
  const double slope = xy / xx;
  return {y_mean - slope * x_mean, slope};
}

/// Where a contestant starts to take longer for good.
struct Crossing {
  enum { kNowhere, kBelow, kAt } where;
  double at = 0;  ///< with kAt
};

/// @param x          the axis
/// @param log_ratio  log(time of a / time of b)
Crossing crossing(const std::vector<double>& x, const std::vector<double>& log_ratio) {
  std::size_t first = x.size();  // of the sizes from which on a takes longer
  while (first > 0 && log_ratio[first - 1] > 0) --first;
  if (first == x.size()) return {Crossing::kNowhere};
  if (first == 0) return {Crossing::kBelow};
  const double below = log_ratio[first - 1];
  const double above = log_ratio[first];
  const double share = -below / (above - below);
  const double step = std::log(x[first] / x[first - 1]);
  return {Crossing::kAt, x[first - 1] * std::exp(share * step)};
}

}  // namespace

SweepAxis axis_of(std::string_view sweep_name) {
  return sweep_name.ends_with("_nm") ? SweepAxis::kPointPairs : SweepAxis::kPairs;
}

double Series::median(std::size_t size) const {
  std::vector<double> times = seconds[size];
  std::sort(times.begin(), times.end());
  return median_of(times);
}

double Sweep::at(std::size_t size) const {
  return axis == SweepAxis::kPointPairs ? sizes[size].point_pairs() : sizes[size].pairs();
}

const Series* Sweep::find(std::string_view wanted) const {
  const auto found = std::find_if(series.begin(), series.end(),
                                  [&](const Series& one) { return one.name == wanted; });
  return found == series.end() ? nullptr : &*found;
}

Estimate time_of(const Sweep& sweep, std::string_view name, std::size_t size) {
  const Series& series = series_of(sweep, name);
  std::vector<double> logs;
  for (const double seconds : series.seconds[size]) logs.push_back(std::log(seconds));
  return exponential(over_processes(logs));
}

Estimate time_ratio(const Sweep& sweep, std::string_view a, std::string_view b, std::size_t size) {
  return time_ratio(series_of(sweep, a).seconds[size], series_of(sweep, b).seconds[size]);
}

Estimate time_ratio(const std::vector<double>& a, const std::vector<double>& b) {
  assert(a.size() == b.size());
  std::vector<double> logs;
  for (std::size_t p = 0; p < a.size(); ++p) logs.push_back(std::log(a[p] / b[p]));
  return exponential(over_processes(logs));
}

Estimate time_exponent(const Sweep& sweep, std::string_view name, std::size_t from) {
  const Series& series = series_of(sweep, name);
  const std::vector<std::size_t> sizes = measured_sizes(series, from);
  std::vector<double> exponents;
  for (std::size_t p = 0; p < processes_of(series); ++p) {
    std::vector<double> x, y;
    for (const std::size_t s : sizes) {
      x.push_back(sweep.at(s));
      y.push_back(series.seconds[s][p]);
    }
    exponents.push_back(fit_power(x, y).exponent);
  }
  return over_processes(exponents);
}

std::size_t exponents_from(const Sweep& sweep) { return (sweep.sizes.size() - 1) / 2; }

LinearTime linear_time(const Sweep& sweep, std::string_view name) {
  const Series& series = series_of(sweep, name);
  std::vector<double> x, medians;
  for (const std::size_t s : measured_sizes(series)) {
    x.push_back(sweep.at(s));
    medians.push_back(series.median(s));
  }
  std::vector<double> intercepts, slopes;
  for (std::size_t p = 0; p < processes_of(series); ++p) {
    std::vector<double> y;
    for (const std::size_t s : measured_sizes(series)) y.push_back(series.seconds[s][p]);
    const Line line = relative_line(x, y);
    intercepts.push_back(line.intercept);
    slopes.push_back(line.slope);
  }
  return {.intercept = over_processes(intercepts),
          .slope = over_processes(slopes),
          .r_squared = fit_line(x, medians).r_squared};
}

std::optional<Estimate> crossover(const Sweep& sweep, std::string_view a, std::string_view b) {
  const Series& a_series = series_of(sweep, a);
  const Series& b_series = series_of(sweep, b);
  std::vector<std::size_t> sizes;
  std::vector<double> x;
  for (const std::size_t s : measured_sizes(a_series)) {
    if (!b_series.measured(s)) continue;
    sizes.push_back(s);
    x.push_back(sweep.at(s));
  }
  if (sizes.empty()) return std::nullopt;
  std::vector<double> logs;
  bool below = false;
  for (std::size_t p = 0; p < processes_of(a_series); ++p) {
    std::vector<double> log_ratio;
    log_ratio.reserve(sizes.size());
    for (const std::size_t s : sizes) {
      log_ratio.push_back(std::log(a_series.seconds[s][p] / b_series.seconds[s][p]));
    }
    const Crossing found = crossing(x, log_ratio);
    if (found.where == Crossing::kNowhere) return std::nullopt;
    if (found.where == Crossing::kBelow) below = true;
    if (found.where == Crossing::kAt) logs.push_back(std::log(found.at));
  }
  if (!below) return exponential(over_processes(logs));
  double upper = x.front();
  for (const double log : logs) upper = std::max(upper, std::exp(log));
  return Estimate{0, {0, upper}};
}

}  // namespace bqsa::harness
