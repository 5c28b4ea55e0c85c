#include "harness/measuring/run_sweep.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "harness/input_error.hpp"
#include "harness/judge/exact_distance.hpp"
#include "harness/measuring/bystanders.hpp"
#include "harness/measuring/detector.hpp"
#include "harness/measuring/speed_of_pairs.hpp"
#include "harness/measuring/speed_of_steps.hpp"
#include "harness/methods.hpp"

namespace bqsa::harness {
namespace {

/// As little work as there can be: the times are worth nothing.
SweepSettings least() {
  return {.contest = {.rounds = 1, .block_s = 1e-9, .budget_s = 0, .fewest_rounds = 1},
          .verified_pairs = 1000};
}

void expect_complete(const Sweep& sweep, std::size_t sizes) {
  ASSERT_EQ(sweep.sizes.size(), sizes);
  for (std::size_t s = 1; s < sizes; ++s) EXPECT_GT(sweep.at(s), sweep.at(s - 1));
  for (const Series& series : sweep.series) {
    ASSERT_EQ(series.seconds.size(), sizes) << series.name;
    for (std::size_t s = 0; s < sizes; ++s) {
      ASSERT_EQ(series.seconds[s].size(), 1u) << series.name;
      EXPECT_GT(series.seconds[s][0], 0) << series.name;
    }
  }
}

TEST(RunSweep, MeasuresEveryDetectorAtEveryNm) {
  const Sweep sweep = run_sweep("plane_nm", least());
  expect_complete(sweep, 13);
  EXPECT_EQ(sweep.at(0), 1);
  EXPECT_EQ(sweep.at(12), 10'000);
  for (const WorkloadSize& size : sweep.sizes) EXPECT_EQ(size.pairs(), 27);
  for (const Detector& detector : detectors()) {
    EXPECT_EQ(sweep.find(detector.name) != nullptr, detector.in_plane) << detector.name;
  }
  for (const char* of_the_papers_figures : {"test_points", "bqsa_paper"}) {
    EXPECT_EQ(sweep.find(of_the_papers_figures)->paper_seconds.size(), 13u);
    EXPECT_THAT(sweep.find(of_the_papers_figures)->paper_passes, testing::Each(100));
  }
  EXPECT_TRUE(sweep.find("bqsa")->paper_seconds.empty());
}

TEST(RunSweep, MeasuresEveryReactiveMethodAmongBystanders) {
  std::vector<std::string> told;
  const Sweep sweep =
      run_sweep("space_step_nk", least(), [&](const std::string& what) { told.push_back(what); });
  expect_complete(sweep, 10);
  EXPECT_EQ(sweep.at(0), 4);
  EXPECT_EQ(sweep.at(9), 4000);
  EXPECT_EQ(told.front(), "space_step_nk");
  for (const MethodEntry& method : methods()) {
    const bool expected = method.capabilities.spatial && !method.capabilities.plans;
    EXPECT_EQ(sweep.find(method.name) != nullptr, expected) << method.name;
  }
  EXPECT_TRUE(sweep.series[0].paper_seconds.empty());
}

class SpeedSweep : public testing::TestWithParam<std::string_view> {};
INSTANTIATE_TEST_SUITE_P(Names, SpeedSweep, testing::Values(kSpeedOfPairs, kSpeedOfSteps));

TEST_P(SpeedSweep, MeasuresAllItsContestantsAtOneSize) {
  const Sweep sweep = run_sweep(GetParam(), least());
  expect_complete(sweep, 1);
  EXPECT_GE(sweep.series.size(), 10u);
  EXPECT_TRUE(is_at_one_size(sweep.name));
}

TEST(RunSweep, RefusesASweepThatThereIsNot) {
  EXPECT_THROW(run_sweep("plane", least()), InputError);
}

class Bystanders : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, Bystanders, testing::Values(2, 3));

/// By the distance at every tick of three periods, as the loop of the steps moves the arm.
TEST_P(Bystanders, StandNearTheMotionButOutOfReach) {
  const Problem lonely = lonely_problem(GetParam());
  const std::vector<Obstacle> bystanders = draw_bystanders(lonely, 60);
  ASSERT_EQ(bystanders.size(), 60u);
  std::vector<double> nearest(60, 1e9);
  ControlLoop loop(with_defaults(methods().front()), lonely);  // `none`
  for (int tick = 0; tick <= 3 * kBystanderPeriod; ++tick, loop.run(1)) {
    ChainPose pose;
    lonely.chain.forward(loop.q(), pose);
    EXPECT_NEAR((pose.tip() - lonely.desired_tip(lonely.time(tick))).norm(), 0, 1e-3) << tick;
    for (std::size_t k = 0; k < 60; ++k) {
      for (const Link& link : lonely.chain.links()) {
        const double distance =
            exact_distance(pose.p_WO.col(link.start), pose.p_WO.col(link.end), bystanders[k].shape)
                .distance;
        nearest[k] = std::min(nearest[k], distance);
      }
    }
  }
  for (const double distance : nearest) {
    EXPECT_GT(distance, kBystanderClearance - 1e-3);
    EXPECT_LT(distance, 1.6);
  }
}

/// Else it would drift, in the hundreds of thousands of steps of a measurement, until it is near one.
TEST_P(Bystanders, SeeTheArmComeHome) {
  const Problem lonely = lonely_problem(GetParam());
  int seen = 0;
  for (const MethodEntry& entry : methods()) {
    if (entry.capabilities.plans || !why_not_applicable(entry.capabilities, lonely).empty())
      continue;
    ++seen;
    ControlLoop loop(with_defaults(entry), lonely);
    for (int homecoming = 0; homecoming < 3; ++homecoming) {
      loop.run(kHomecoming - 1);
      EXPECT_LT((loop.q() - lonely.start).cwiseAbs().maxCoeff(), 0.01) << entry.name;
      loop.run(1);
      EXPECT_EQ(loop.q(), lonely.start) << entry.name;
    }
  }
  EXPECT_GT(seen, 8);
}

TEST_P(Bystanders, AreTheFirstOfALongerList) {
  const Problem lonely = lonely_problem(GetParam());
  const std::vector<Obstacle> few = draw_bystanders(lonely, 3);
  const std::vector<Obstacle> many = draw_bystanders(lonely, 30);
  for (std::size_t k = 0; k < few.size(); ++k) {
    EXPECT_EQ(few[k].name, many[k].name);
    EXPECT_EQ(few[k].shape.center(), many[k].shape.center());
  }
}

TEST(BystanderClearance, IsBeyondWhatAnyMethodReactsTo) {
  int declared = 0;
  for (const MethodEntry& method : methods()) {
    for (const ParameterDeclaration& parameter : method.parameters) {
      if (parameter.name != "influence") continue;
      ++declared;
      EXPECT_LT(parameter.default_value, kBystanderClearance) << method.name;
    }
  }
  EXPECT_GT(declared, 5);
}

/// Test points look at every pair, every tick; BQSA leaves out those that are proven to be far away.
/// (Searches by distance dismiss most pairs by a sphere around the obstacle, which is not counted.)
TEST_P(Bystanders, AreLookedAtByWhoeverHasNoBetterWay) {
  const Problem lonely = lonely_problem(GetParam());
  Problem crowded = lonely;
  crowded.obstacles = draw_bystanders(lonely, 40);
  for (const MethodEntry& entry : methods()) {
    if (entry.name != "bqsa" && entry.name != "test_point") continue;
    ControlLoop loop(with_defaults(entry), crowded);
    loop.run(10);
    const WorkCounters& work = loop.counters();
    const auto pairs = static_cast<std::uint64_t>(40 * std::ssize(lonely.chain.links()));
    if (entry.name == "test_point") {
      EXPECT_GE(work.point_pairs, 10 * pairs);
    } else {
      EXPECT_LT(work.quadratics, 2 * pairs);
    }
    EXPECT_EQ(loop.infeasible(), 0);
  }
}

}  // namespace
}  // namespace bqsa::harness
