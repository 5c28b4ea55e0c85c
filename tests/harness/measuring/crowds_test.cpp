#include "harness/measuring/crowds.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "harness/judge/exact_distance.hpp"
#include "harness/measuring/bystanders.hpp"
#include "harness/methods.hpp"

namespace bqsa::harness {
namespace {

const MethodEntry& method_named(const std::string& name) {
  return *std::ranges::find(methods(), name, &MethodEntry::name);
}

class Crowds : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, Crowds, testing::Values(2, 3));

TEST_P(Crowds, LeaveTheArmACorridor) {
  const Problem wandering = wandering_problem(GetParam());
  const std::vector<Obstacle> crowd = draw_crowd(wandering, 3000);
  ASSERT_EQ(crowd.size(), 3000u);
  ControlLoop loop(with_defaults(methods().front()), wandering);  // `none`
  double nearest = 1e9;
  for (int tick = 0; tick < kBystanderPeriod; tick += 10, loop.run(10)) {
    ChainPose pose;
    wandering.chain.forward(loop.q(), pose);
    for (const Obstacle& obstacle : crowd) {
      for (const Link& link : wandering.chain.links()) {
        nearest = std::min(nearest, exact_distance(pose.p_WO.col(link.start),
                                                   pose.p_WO.col(link.end), obstacle.shape)
                                        .distance);
      }
    }
  }
  EXPECT_GT(nearest, kBystanderClearance - 1e-3);
  EXPECT_LT(nearest, kBystanderClearance + 0.2) << "no crowd";
}

TEST_P(Crowds, GrowOutwardsAtTheSameDensity) {
  const Problem wandering = wandering_problem(GetParam());
  const std::vector<Obstacle> few = draw_crowd(wandering, 5000);
  const std::vector<Obstacle> many = draw_crowd(wandering, 40000);
  for (std::size_t k = 0; k < few.size(); ++k) {
    ASSERT_EQ(few[k].shape.center(), many[k].shape.center());
  }
  // Eight times as many in the plane reach sqrt(8) times as far, in space twice.
  const auto reach = [](const std::vector<Obstacle>& crowd) {
    double furthest = 0;
    for (const Obstacle& one : crowd) furthest = std::max(furthest, one.shape.center().norm());
    return furthest;
  };
  EXPECT_NEAR(reach(many) / reach(few), std::pow(8, 1.0 / GetParam()), 0.1);
}

TEST_P(Crowds, CostAStepOfBqsaHardlyMoreWhenTheyAreManyMore) {
  const CrowdedSteps few = run_crowded(method_named("bqsa"), GetParam(), 3000, 2);
  const CrowdedSteps many = run_crowded(method_named("bqsa"), GetParam(), 100'000, 2);
  for (const CrowdedSteps& run : {few, many}) {
    EXPECT_EQ(run.infeasible, 0);
    EXPECT_LT(run.quadratics, 100);
    EXPECT_GT(run.first_bounds, 0);
    EXPECT_GT(run.bounds, 0) << "no list is made any more";
    EXPECT_LE(run.bounds, run.first_bounds);
    EXPECT_LT(run.index_bytes, 50);
  }
  EXPECT_LT(many.first_bounds, 2 * few.first_bounds);
  EXPECT_LE(many.quadratics, 1.01 * few.quadratics);
}

TEST(GrowthExponent, IsTheSlopeOfTheLogarithms) {
  std::vector<CrowdedSteps> runs;
  for (const int k : {100, 1000, 30'000}) {
    runs.push_back(
        {.obstacles = k, .mean_s = 1e-9 * std::pow(k, 0.4), .bounds = 5 * std::pow(k, 0.7)});
  }
  EXPECT_NEAR(growth_exponent(runs, &CrowdedSteps::mean_s), 0.4, 1e-12);
  EXPECT_NEAR(growth_exponent(runs, &CrowdedSteps::bounds), 0.7, 1e-12);
}

}  // namespace
}  // namespace bqsa::harness
