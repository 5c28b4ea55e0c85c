/// @file
/// Estimates from one sample: quantiles, means and intervals. Pure functions.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace bqsa::harness {

struct Interval {
  double lower;
  double upper;

  bool contains(double value) const { return lower <= value && value <= upper; }
};

/// Of a sample that is independent draws, unless said otherwise.
inline constexpr double kConfidence = 0.95;

/// The smallest of these values that at least this share of them does not exceed.
/// @param sorted  ascending, not empty
double quantile_of(std::span<const double> sorted, double share);

/// The middle value, or the mean of the two in the middle.
/// @param sorted  ascending, not empty
double median_of(std::span<const double> sorted);

/// Wilson's score interval of 95 % for the probability of success.
/// The whole range if there were no runs. Neither number has to be whole: runs that repeat each other in
/// part are worth fewer independent ones.
Interval wilson_interval(double successes, double runs);

/// exp(mean(log(x + shift))) - shift, in which small values count little and large ones do not drown
/// the rest; a failure counts as `penalty`, so that a method gains nothing by giving up.
/// @param values    not negative
/// @param failures  how many values there are not; with values at least one
/// @param shift     positive, in the unit of the values
double shifted_geometric_mean(std::span<const double> values, int failures, double penalty,
                              double shift);

struct Bootstrap {
  double confidence = kConfidence;
  int resamples = 2000;
  std::uint64_t seed = 1;
};

/// Percentile bootstrap interval of a statistic (Efron 1979): the quantiles of the statistic over
/// samples of the same size, drawn with replacement.
/// @param sample     not empty
/// @param statistic  gets a resample in ascending order
Interval bootstrap_interval(std::span<const double> sample,
                            const std::function<double(std::span<const double>)>& statistic,
                            const Bootstrap& bootstrap = {});

}  // namespace bqsa::harness
