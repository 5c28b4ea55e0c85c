#include "harness/measuring/sweep.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "harness/generator/random_stream.hpp"

namespace bqsa::harness {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Sizes with these numbers of obstacles, one link: nk is k.
Sweep sweep_over(const std::vector<int>& pairs) {
  Sweep sweep{.name = "plane_nk", .axis = SweepAxis::kPairs, .sizes = {}, .series = {}};
  for (const int k : pairs) sweep.sizes.push_back({.dimension = 2, .links = 1, .obstacles = k});
  return sweep;
}

TEST(Sweeps, KnowTheirAxis) {
  Sweep sweep = sweep_over({7});
  sweep.sizes[0].links = 3;
  sweep.sizes[0].test_points = {.link = 4, .obstacle = 5};
  EXPECT_EQ(sweep.at(0), 21);
  sweep.axis = SweepAxis::kPointPairs;
  EXPECT_EQ(sweep.at(0), 20);
  EXPECT_EQ(sweep.find("a"), nullptr);
  sweep.series = {{.name = "a", .seconds = {{3, 1, 2}}, .paper_seconds = {}}};
  ASSERT_NE(sweep.find("a"), nullptr);
  EXPECT_EQ(sweep.find("a")->median(0), 2);
}

/// By hand: log2 of the ratios are 1, 2, 3; mean 2, standard error 1/sqrt(3), t of 2 degrees of freedom
/// 4.302653: 2 +- 2.484138 octaves.
TEST(Ratios, AreGeometricMeansWithStudentsIntervals) {
  Sweep sweep = sweep_over({1});
  sweep.series = {{.name = "a", .seconds = {{2e-6, 8e-6, 16e-6}}, .paper_seconds = {}},
                  {.name = "b", .seconds = {{1e-6, 2e-6, 2e-6}}, .paper_seconds = {}}};
  const Estimate ratio = time_ratio(sweep, "a", "b", 0);
  EXPECT_NEAR(ratio.value, 4, 1e-12);
  EXPECT_NEAR(std::log2(ratio.interval.lower), 2 - 2.484138, 1e-6);
  EXPECT_NEAR(std::log2(ratio.interval.upper), 2 + 2.484138, 1e-6);
}

TEST(Ratios, OfOneProcessMayBeAnything) {
  Sweep sweep = sweep_over({1});
  sweep.series = {{.name = "a", .seconds = {{2e-6}}, .paper_seconds = {}},
                  {.name = "b", .seconds = {{1e-6}}, .paper_seconds = {}}};
  const Estimate ratio = time_ratio(sweep, "a", "b", 0);
  EXPECT_NEAR(ratio.value, 2, 1e-12);
  EXPECT_EQ(ratio.interval.lower, 0);
  EXPECT_EQ(ratio.interval.upper, kInfinity);
}

/// Five processes, of which each sees another exponent: those of its own are what the interval is about.
TEST(Exponents, AreThoseOfTheProcesses) {
  const std::vector<double> exponents{0.9, 1.0, 1.1, 0.95, 1.05};
  Sweep sweep = sweep_over({1, 10, 100, 1000});
  sweep.series = {
      {.name = "a", .seconds = std::vector<std::vector<double>>(4), .paper_seconds = {}}};
  for (std::size_t s = 0; s < 4; ++s) {
    for (const double exponent : exponents) {
      // The first size is off the line: it is left out below.
      sweep.series[0].seconds[s].push_back(s == 0 ? 1.0 : 2e-9 * std::pow(sweep.at(s), exponent));
    }
  }
  const Estimate exponent = time_exponent(sweep, "a", 1);
  EXPECT_NEAR(exponent.value, 1.0, 1e-9);
  // Standard deviation 0.0790569, standard error 0.0353553, t of 4 degrees of freedom 2.776445.
  EXPECT_NEAR(exponent.interval.upper, 1 + 0.0353553 * 2.776445, 1e-6);
  EXPECT_NEAR(exponent.interval.lower, 1 - 0.0353553 * 2.776445, 1e-6);
  EXPECT_LT(time_exponent(sweep, "a").value, 0);
}

TEST(Exponents, LeaveOutSizesThatWereNotMeasured) {
  Sweep sweep = sweep_over({1, 2, 4, 8, 16});
  sweep.series = {{.name = "a", .seconds = {{1.0}, {4.0}, {}, {64.0}, {}}, .paper_seconds = {}}};
  EXPECT_FALSE(sweep.series[0].measured(2));
  EXPECT_NEAR(time_exponent(sweep, "a").value, 2, 1e-12);
  EXPECT_EQ(time_exponent(sweep, "a").interval.upper, kInfinity);
}

TEST(LinearTimes, OfALineAreTheLine) {
  Sweep sweep = sweep_over({1, 10, 100, 10'000});
  Series series{.name = "a", .seconds = {}, .paper_seconds = {}};
  for (std::size_t s = 0; s < 4; ++s) {
    const double x = sweep.at(s);
    series.seconds.push_back({3e-8 + 2e-9 * x, 5e-8 + 4e-9 * x});
  }
  sweep.series = {series};
  const LinearTime line = linear_time(sweep, "a");
  EXPECT_NEAR(line.intercept.value, 4e-8, 1e-15);
  EXPECT_NEAR(line.slope.value, 3e-9, 1e-16);
  EXPECT_NEAR(line.r_squared, 1, 1e-12);
  EXPECT_NEAR(line.slope.interval.upper, 3e-9 + 12.706205 * 1e-9, 1e-14);  // t of 1 degree
}

/// By hand, x = 1, 2, 4, y = 1, 2, 2, weights 1, 1/4, 1/4: means 5/3 and 4/3, sum of squares
/// 4/9 + 1/36 + 49/36 = 66/36, of products 2/9 + 2/36 + 14/36 = 24/36: slope 4/11, intercept 8/11.
TEST(LinearTimes, WeighRelativeErrors) {
  Sweep sweep = sweep_over({1, 2, 4});
  sweep.series = {{.name = "a", .seconds = {{1.0}, {2.0}, {2.0}}, .paper_seconds = {}}};
  const LinearTime line = linear_time(sweep, "a");
  EXPECT_NEAR(line.slope.value, 4.0 / 11, 1e-12);
  EXPECT_NEAR(line.intercept.value, 8.0 / 11, 1e-12);
  // Unweighted: means 7/3 and 5/3, xx 14/3, xy 4/3, yy 2/3.
  EXPECT_NEAR(line.r_squared, (16.0 / 9) / (14.0 / 3 * 2 / 3), 1e-12);
}

/// a costs 2 an nk, b always 25: they meet at 12.5. Powers of x make log-linear interpolation exact.
TEST(Crossovers, OfPowersAreWhereTheyMeet) {
  Sweep sweep = sweep_over({1, 10, 100, 1000});
  Series a{.name = "a", .seconds = {}, .paper_seconds = {}};
  Series b{.name = "b", .seconds = {}, .paper_seconds = {}};
  for (std::size_t s = 0; s < 4; ++s) {
    a.seconds.push_back({2 * sweep.at(s), 2 * sweep.at(s), 2 * sweep.at(s)});
    b.seconds.push_back({25, 25, 25});
  }
  sweep.series = {a, b};
  const std::optional<Estimate> found = crossover(sweep, "a", "b");
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->value, 12.5, 1e-9);
  EXPECT_NEAR(found->interval.lower, 12.5, 1e-9);
  EXPECT_FALSE(crossover(sweep, "b", "a"));
}

TEST(Crossovers, DifferBetweenProcesses) {
  Sweep sweep = sweep_over({1, 100});
  sweep.series = {{.name = "a", .seconds = {{1, 1}, {100, 100}}, .paper_seconds = {}},
                  {.name = "b", .seconds = {{4, 16}, {4, 16}}, .paper_seconds = {}}};
  const std::optional<Estimate> found = crossover(sweep, "a", "b");  // at 4 and at 16
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->value, 8, 1e-9);
  EXPECT_NEAR(std::log2(found->interval.upper), 3 + 12.706205, 1e-5);  // standard error 1 octave
}

TEST(Crossovers, BelowTheFirstSizeAreKnownByTheirBoundOnly) {
  Sweep sweep = sweep_over({5, 50});
  sweep.series = {{.name = "a", .seconds = {{8, 8}, {80, 80}}, .paper_seconds = {}},
                  {.name = "b", .seconds = {{4, 4}, {4, 4}}, .paper_seconds = {}},
                  {.name = "c", .seconds = {{4, 16}, {4, 16}}, .paper_seconds = {}}};
  const std::optional<Estimate> both = crossover(sweep, "a", "b");
  ASSERT_TRUE(both);
  EXPECT_EQ(both->value, 0);
  EXPECT_EQ(both->interval.lower, 0);
  EXPECT_EQ(both->interval.upper, 5);
  const std::optional<Estimate> one = crossover(sweep, "a", "c");  // at 10 in the second process
  ASSERT_TRUE(one);
  EXPECT_EQ(one->value, 0);
  EXPECT_NEAR(one->interval.upper, 10, 1e-9);
}

/// A block that was slow by accident does not make a crossover: a is cheaper again after it.
TEST(Crossovers, AreWhereItStaysSlower) {
  Sweep sweep = sweep_over({1, 10, 100, 1000});
  sweep.series = {{.name = "a", .seconds = {{2}, {1}, {1}, {10}}, .paper_seconds = {}},
                  {.name = "b", .seconds = {{1}, {2}, {2}, {2}}, .paper_seconds = {}}};
  const std::optional<Estimate> found = crossover(sweep, "a", "b");
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->value, 100 * std::pow(10, std::log(2) / std::log(10)), 1e-9);
  EXPECT_EQ(found->interval.upper, kInfinity);
  sweep.series[0].seconds.back() = {};
  EXPECT_FALSE(crossover(sweep, "a", "b"));
}

}  // namespace
}  // namespace bqsa::harness
