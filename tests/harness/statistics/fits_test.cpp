#include "harness/statistics/fits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "harness/generator/random_stream.hpp"

namespace bqsa::harness {
namespace {

/// Anscombe (1973): Graphs in Statistical Analysis; figures as published, standard error of the slope
/// 0.118, of the intercept 1.125, R² 0.667; the t quantile of 9 degrees of freedom is 2.262.
TEST(LineFits, HasTheFiguresPublishedForAnscombesFirstSet) {
  const std::vector<double> x{10, 8, 13, 9, 11, 14, 6, 4, 12, 7, 5};
  const std::vector<double> y{8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68};
  const LineFit fit = fit_line(x, y);
  EXPECT_NEAR(fit.slope, 0.5001, 5e-5);
  EXPECT_NEAR(fit.intercept, 3.0001, 5e-5);
  EXPECT_NEAR(fit.r_squared, 0.6665, 5e-5);
  EXPECT_NEAR((fit.slope_interval.upper - fit.slope) / 2.262157, 0.1179, 5e-5);
  EXPECT_NEAR((fit.slope - fit.slope_interval.lower) / 2.262157, 0.1179, 5e-5);
  EXPECT_NEAR((fit.intercept_interval.upper - fit.intercept) / 2.262157, 1.1247, 5e-5);
}

TEST(LineFits, OfAStraightLineIsTheLine) {
  const LineFit fit = fit_line(std::vector{1.0, 2.0, 4.0, 8.0}, std::vector{5.0, 7.0, 11.0, 19.0});
  EXPECT_NEAR(fit.slope, 2, 1e-12);
  EXPECT_NEAR(fit.intercept, 3, 1e-12);
  EXPECT_NEAR(fit.slope_interval.upper - fit.slope_interval.lower, 0, 1e-12);
  EXPECT_NEAR(fit.r_squared, 1, 1e-12);
  EXPECT_EQ(fit_line(std::vector{1.0, 2.0, 3.0}, std::vector{4.0, 4.0, 4.0}).r_squared, 1);
}

TEST(LineFits, IntervalsHoldTheTruthAsOftenAsTheySay) {
  RandomStream random{3};
  constexpr int kTrials = 4000;
  int slope_held = 0, intercept_held = 0;
  const auto noise = [&random] {
    double sum = -6;  // of twelve: normal for our purpose, variance 1
    for (int k = 0; k < 12; ++k) sum += random.uniform(0, 1);
    return sum;
  };
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> x, y;
    for (int i = 0; i < 6; ++i) {
      x.push_back(i * i);
      y.push_back(7 - 0.3 * i * i + noise());
    }
    const LineFit fit = fit_line(x, y);
    slope_held += fit.slope_interval.contains(-0.3);
    intercept_held += fit.intercept_interval.contains(7);
  }
  const double tolerance = 4 * std::sqrt(0.05 * 0.95 * kTrials);
  EXPECT_NEAR(slope_held, 0.95 * kTrials, tolerance);
  EXPECT_NEAR(intercept_held, 0.95 * kTrials, tolerance);
}

TEST(PowerFits, FindExponentAndFactor) {
  std::vector<double> x, y;
  for (int k = 1; k <= 10; ++k) {
    x.push_back(k);
    y.push_back(3 * std::pow(k, 1.5) * (k % 2 == 0 ? 1.02 : 1 / 1.02));
  }
  const PowerFit fit = fit_power(x, y);
  EXPECT_NEAR(fit.exponent, 1.5, 0.02);
  EXPECT_NEAR(fit.factor, 3, 0.1);
  EXPECT_TRUE(fit.exponent_interval.contains(1.5));
  EXPECT_TRUE(fit.factor_interval.contains(3));
  EXPECT_FALSE(fit.exponent_interval.contains(1.6));
  EXPECT_GT(fit.r_squared, 0.99);
  // The same fit by hand: least squares through the logarithms.
  std::vector<double> log_x, log_y;
  for (std::size_t i = 0; i < x.size(); ++i) {
    log_x.push_back(std::log10(x[i]));
    log_y.push_back(std::log10(y[i]));
  }
  const LineFit line = fit_line(log_x, log_y);
  EXPECT_NEAR(fit.exponent, line.slope, 1e-12);
  EXPECT_NEAR(fit.factor, std::pow(10, line.intercept), 1e-12);
}

}  // namespace
}  // namespace bqsa::harness
