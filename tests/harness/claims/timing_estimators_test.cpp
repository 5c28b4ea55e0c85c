// Estimators on sweeps whose times are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "harness/claims/estimator.hpp"
#include "harness/claims/laboratory.hpp"
#include "harness/methods.hpp"
#include "synthetic_sweeps.hpp"

namespace bqsa::harness::claims {
namespace {

constexpr double kNano = 1e-9;

/// Test points at 2 ns NM + 10 ns, BQSA at 100 ns.
Sweep plane() {
  return synthetic_sweep("plane_nm", SweepAxis::kPointPairs,
                         {{"points", [](double nm) { return 2 * kNano * nm + 10 * kNano; }},
                          {"bqsa", [](double) { return 100 * kNano; }},
                          {"linear", [](double nm) { return kNano * nm; }},
                          {"steep", [](double nm) { return kNano * nm * nm; }}});
}

Findings estimate(const char* estimator, const std::vector<Sweep>& sweeps,
                  const std::vector<std::pair<std::string, std::string>>& given) {
  const Estimator* found = find_estimator(estimator);
  Arguments arguments;
  for (const ArgumentDeclaration& one : found->arguments)
    arguments.set(one.name, one.fallback.value_or(""));
  for (const auto& [name, value] : given) arguments.set(name, value);
  Laboratory laboratory({}, methods(), sweeps);
  return found->estimate(arguments, laboratory);
}

const Figure& figure_named(const Findings& findings, const std::string& name) {
  for (const Figure& figure : findings.figures) {
    if (figure.name == name) return figure;
  }
  throw std::runtime_error("no figure " + name);
}

TEST(TimeGrowth, FindsSlopeInterceptAndExponent) {
  const Findings points =
      estimate("time_growth", {plane()}, {{"sweep", "plane_nm"}, {"series", "points"}});
  EXPECT_NEAR(figure_named(points, "slope").value, 2 * kNano, 0.01 * kNano);
  EXPECT_NEAR(figure_named(points, "intercept").value, 10 * kNano, 0.05 * kNano);
  EXPECT_NEAR(figure_named(points, "r_squared").value, 1, 1e-6);
  const Findings steep =
      estimate("time_growth", {plane()}, {{"sweep", "plane_nm"}, {"series", "steep"}});
  EXPECT_NEAR(figure_named(steep, "exponent").value, 2, 1e-6);
  EXPECT_GT(figure_named(steep, "r_squared").value, 0.99) << "which is why linearity needs both";
}

TEST(TimeGrowth, ChangeIsThePartOfTheTimeThatTheRangeMakes) {
  const Findings flat =
      estimate("time_growth", {plane()}, {{"sweep", "plane_nm"}, {"series", "bqsa"}});
  EXPECT_NEAR(figure_named(flat, "change").value, 0, 1e-9);
  const Sweep rising =
      synthetic_sweep("plane_nm", SweepAxis::kPointPairs,
                      {{"bqsa", [](double nm) { return kNano * (100 + 20 * (nm - 1) / 9999); }}});
  const Figure change = figure_named(
      estimate("time_growth", {rising}, {{"sweep", "plane_nm"}, {"series", "bqsa"}}), "change");
  EXPECT_NEAR(change.value, 20.0 / 110, 1e-6);
  EXPECT_LE(change.interval->lower, change.value);
  EXPECT_GE(change.interval->upper, change.value);
}

/// A noisy size among steady ones: whatever is least, its lower limit counts.
TEST(TimeRatio, LeastAndMostHaveTheLimitsOfAllSizes) {
  Sweep sweep = synthetic_sweep("plane_nm", SweepAxis::kPointPairs,
                                {{"a", [](double nm) { return kNano * (nm < 5 ? 2 : 2.1); }},
                                 {"b", [](double) { return kNano; }}});
  sweep.series[0].seconds[3] = {1 * kNano, 1 * kNano, 4.41 * kNano, 4.41 * kNano};
  const Findings ratios =
      estimate("time_ratio", {sweep}, {{"sweep", "plane_nm"}, {"a", "a"}, {"b", "b"}});
  const Figure& least = figure_named(ratios, "least");
  EXPECT_NEAR(least.value, 2, 0.01);
  EXPECT_LT(least.interval->lower, 1);
  EXPECT_NEAR(least.interval->upper, 2, 0.01);
  const Figure& most = figure_named(ratios, "most");
  EXPECT_NEAR(most.value, 2.1, 0.01);
  EXPECT_GT(most.interval->upper, 4);
}

TEST(TimeRatio, LooksAtTheRangeAlone) {
  const Findings all =
      estimate("time_ratio", {plane()}, {{"sweep", "plane_nm"}, {"a", "points"}, {"b", "bqsa"}});
  EXPECT_NEAR(figure_named(all, "least").value, 0.12, 1e-3);
  EXPECT_NEAR(figure_named(all, "most").value, 200.1, 0.1);
  const Findings part = estimate(
      "time_ratio", {plane()},
      {{"sweep", "plane_nm"}, {"a", "points"}, {"b", "bqsa"}, {"from", "100"}, {"to", "1000"}});
  EXPECT_NEAR(figure_named(part, "first").value, 2.1, 1e-3);
  EXPECT_NEAR(figure_named(part, "last").value, 20.1, 1e-2);
  const Figure& last = figure_named(part, "last");
  EXPECT_LT(last.interval->lower, 20.1);
  EXPECT_GT(last.interval->upper, 20.1);
}

TEST(RatioGrowth, IsTheDifferenceOfTheExponents) {
  const Findings growth =
      estimate("ratio_growth", {plane()}, {{"sweep", "plane_nm"}, {"a", "steep"}, {"b", "linear"}});
  EXPECT_NEAR(figure_named(growth, "exponent").value, 1, 1e-6);
}

TEST(TimeCrossover, LiesWhereTheTimesAreEqual) {
  // Between 10 (30 ns) and 100 (210 ns), straight in logarithms: 10^(1 + log(100/30)/log(7)).
  const Findings found = estimate("time_crossover", {plane()},
                                  {{"sweep", "plane_nm"}, {"a", "points"}, {"b", "bqsa"}});
  const double expected = std::pow(10, 1 + std::log(100.0 / 30) / std::log(7.0));
  EXPECT_NEAR(figure_named(found, "crossover").value, expected, 0.1);
  const Findings never = estimate("time_crossover", {plane()},
                                  {{"sweep", "plane_nm"}, {"a", "bqsa"}, {"b", "points"}});
  EXPECT_TRUE(never.figures.empty());
  EXPECT_EQ(never.remarks.size(), 1u);
}

TEST(SlopeRatio, IsWideWhereASlopeMayBeZero) {
  const Figure steep = figure_named(
      estimate("slope_ratio", {plane()}, {{"sweep", "plane_nm"}, {"a", "points"}, {"b", "points"}}),
      "ratio");
  EXPECT_NEAR(steep.value, 1, 1e-9);
  const Figure flat = figure_named(
      estimate("slope_ratio", {plane()}, {{"sweep", "plane_nm"}, {"a", "points"}, {"b", "bqsa"}}),
      "ratio");
  EXPECT_TRUE(std::isinf(flat.interval->upper));
}

TEST(TimingEstimators, FindNothingWhereNothingWasMeasured) {
  for (const Estimator& estimator : estimators()) {
    const bool takes_own_times = std::ranges::none_of(
        estimator.arguments, [](const auto& argument) { return argument.name == "sweep"; });
    if (!estimator.timing || (takes_own_times && estimator.name != "batch_model")) continue;
    SCOPED_TRACE(estimator.name);
    const std::vector<std::pair<std::string, std::string>> arguments = {
        {"sweep", "plane_nm"}, {"series", "x"}, {"a", "x"}, {"b", "bqsa"}};
    EXPECT_TRUE(estimate(estimator.name.c_str(), {}, arguments).figures.empty());
    EXPECT_TRUE(estimate(estimator.name.c_str(), {plane()}, arguments).figures.empty());
  }
}

}  // namespace
}  // namespace bqsa::harness::claims
