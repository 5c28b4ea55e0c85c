#include "harness/statistics/fits.hpp"

#include <boost/math/distributions/students_t.hpp>
#include <cassert>
#include <cmath>
#include <numeric>
#include <vector>

namespace bqsa::harness {
namespace {

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::vector<double> logarithms(std::span<const double> values) {
  std::vector<double> logs;
  for (const double value : values) {
    assert(value > 0);
    logs.push_back(std::log(value));
  }
  return logs;
}

}  // namespace

LineFit fit_line(std::span<const double> x, std::span<const double> y) {
  assert(x.size() == y.size() && x.size() >= 3);
  const auto n = static_cast<double>(x.size());
  const double x_mean = mean_of(x);
  const double y_mean = mean_of(y);
  double xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - x_mean) * (x[i] - x_mean);
    xy += (x[i] - x_mean) * (y[i] - y_mean);
    yy += (y[i] - y_mean) * (y[i] - y_mean);
  }
  assert(xx > 0);
  const double slope = xy / xx;
  const double intercept = y_mean - slope * x_mean;
  double rest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    rest += std::pow(y[i] - intercept - slope * x[i], 2);
  }
  const boost::math::students_t_distribution<> t(n - 2);
  const double width = quantile(t, (1 + kConfidence) / 2) * std::sqrt(rest / (n - 2));
  const double slope_width = width / std::sqrt(xx);
  const double intercept_width = width * std::sqrt(1 / n + x_mean * x_mean / xx);
  return {.intercept = intercept,
          .slope = slope,
          .intercept_interval = {intercept - intercept_width, intercept + intercept_width},
          .slope_interval = {slope - slope_width, slope + slope_width},
          .r_squared = yy > 0 ? 1 - rest / yy : 1};
}

PowerFit fit_power(std::span<const double> x, std::span<const double> y) {
  const LineFit line = fit_line(logarithms(x), logarithms(y));
  const Interval& factor = line.intercept_interval;
  return {.factor = std::exp(line.intercept),
          .exponent = line.slope,
          .factor_interval = {std::exp(factor.lower), std::exp(factor.upper)},
          .exponent_interval = line.slope_interval,
          .r_squared = line.r_squared};
}

}  // namespace bqsa::harness
