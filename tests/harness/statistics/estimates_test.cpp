#include "harness/statistics/estimates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "harness/generator/random_stream.hpp"

namespace bqsa::harness {
namespace {

TEST(Quantiles, AreTheSmallestValueThatTheShareDoesNotExceed) {
  std::vector<double> hundred(100);
  std::iota(hundred.begin(), hundred.end(), 1);
  EXPECT_EQ(quantile_of(hundred, 0.99), 99);
  EXPECT_EQ(quantile_of(hundred, 0.999), 100);
  EXPECT_EQ(quantile_of(hundred, 0.5), 50);
  EXPECT_EQ(quantile_of(hundred, 0), 1);
  EXPECT_EQ(quantile_of(std::vector{7.0}, 0.99), 7);
  EXPECT_EQ(median_of(hundred), 50.5);
  EXPECT_EQ(median_of(std::vector{1.0, 2.0, 9.0}), 2);
}

void expect_near(const Interval& found, double lower, double upper, double within = 1e-12) {
  EXPECT_NEAR(found.lower, lower, within);
  EXPECT_NEAR(found.upper, upper, within);
}

TEST(WilsonInterval, IsTheSetOfSharesThatTheScoreTestKeeps) {
  // Solutions of (p - k/n)^2 = z^2 p (1 - p) / n, computed apart from this program.
  expect_near(wilson_interval(8, 10), 0.4901624715366418, 0.9433178485456247);
  expect_near(wilson_interval(0, 10), 0, 0.2775327998628892);
  expect_near(wilson_interval(10, 10), 0.7224672001371114, 1);
  expect_near(wilson_interval(1712, 2000), 0.8399302416150263, 0.8707048207207215);
  expect_near(wilson_interval(0, 0), 0, 1);
  // The solutions of (p - 0.5)^2 = z^2 p (1 - p) / 5, by the formula for quadratic equations.
  expect_near(wilson_interval(2.5, 5), 0.17042358064358776, 0.8295764193564122);
}

TEST(ShiftedGeometricMean, CountsFailuresAsThePenalty) {
  // (1 + 1) (7 + 1) = 16, its square root 4, less the shift.
  EXPECT_NEAR(shifted_geometric_mean(std::vector{1.0, 7.0}, 0, 100, 1), 3, 1e-12);
  // 1 * 8 * 27 = 216, its cube root 6, less the shift.
  EXPECT_NEAR(shifted_geometric_mean(std::vector{0.0, 7.0}, 1, 26, 1), 5, 1e-12);
  EXPECT_NEAR(shifted_geometric_mean({}, 2, 60, 10), 60, 1e-9);
  EXPECT_NEAR(shifted_geometric_mean(std::vector{4.0, 9.0}, 0, 0, 1e-12), 6, 1e-9);
}

/// All 27 resamples of (1, 2, 3): the median is 1 or 3 in 7 of them each, 2 in 13.
TEST(BootstrapInterval, OfThreeValuesIsThatOfAllTheirResamples) {
  const std::vector<double> sample{3, 1, 2};
  const auto interval = [&](double confidence) {
    return bootstrap_interval(sample, median_of,
                              {.confidence = confidence, .resamples = 20000, .seed = 5});
  };
  expect_near(interval(0.95), 1, 3, 0);
  expect_near(interval(0.50), 1, 3, 0);  // 25 % lie below 7/27 = 25.9 %
  expect_near(interval(0.46), 2, 2, 0);  // 27 % do not
}

TEST(BootstrapInterval, HoldsTheMedianAsOftenAsItSays) {
  RandomStream random{17};
  constexpr int kSamples = 1000;
  int held = 0;
  for (int k = 0; k < kSamples; ++k) {
    std::vector<double> sample(41);
    for (double& value : sample) value = random.log_uniform(0.1, 10);  // its median is 1
    const Interval interval =
        bootstrap_interval(sample, median_of, {.resamples = 400, .seed = random.bits()});
    held += interval.contains(1);
  }
  // 95 % of 1000 within four standard deviations, and what the percentile method is known to lose.
  EXPECT_GT(held, 915);
  EXPECT_LT(held, 980);
}

TEST(BootstrapInterval, IsTheSameForTheSameSeed) {
  const std::vector<double> sample{1, 4, 9, 16, 25, 36};
  const auto mean = [](std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  };
  const Interval once = bootstrap_interval(sample, mean, {.seed = 3});
  expect_near(bootstrap_interval(sample, mean, {.seed = 3}), once.lower, once.upper, 0);
  EXPECT_NE(bootstrap_interval(sample, mean, {.seed = 4}).lower, once.lower);
}

}  // namespace
}  // namespace bqsa::harness
