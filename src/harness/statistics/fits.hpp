/// @file
/// Straight lines and powers fitted to measurements. Pure functions.
#pragma once

#include <span>

#include "harness/statistics/estimates.hpp"

namespace bqsa::harness {

/// y = intercept + slope x by ordinary least squares, with 95 % intervals by Student's t for errors
/// that are independent, normal and of equal variance.
struct LineFit {
  double intercept;
  double slope;
  Interval intercept_interval;
  Interval slope_interval;
  double r_squared;  ///< share of the variance of y explained; 1 if y does not vary
};

/// @param x, y  of equal length, at least 3; x not all equal
LineFit fit_line(std::span<const double> x, std::span<const double> y);

/// y = factor x^exponent, as a line through the logarithms.
struct PowerFit {
  double factor;
  double exponent;
  Interval factor_interval;
  Interval exponent_interval;
  double r_squared;  ///< of the logarithms
};

/// @param x, y  positive, of equal length, at least 3; x not all equal
PowerFit fit_power(std::span<const double> x, std::span<const double> y);

}  // namespace bqsa::harness
