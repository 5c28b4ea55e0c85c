#include "baselines/test_point.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/allocation_guard.hpp"
#include "support/paper_problems.hpp"
#include "support/replay.hpp"

namespace bqsa::baselines {
namespace {

using test_support::planar_7r;
using test_support::Replay;
using ::testing::IsEmpty;

std::unique_ptr<Method> test_point(
    const std::vector<std::pair<std::string, std::string>>& settings = {}) {
  const MethodEntry entry = test_point_method();
  ParameterValues values(entry.parameters);
  for (const auto& [name, value] : settings) values.set(name, value);
  return entry.make(values);
}

Replay run_on(const Problem& problem, Method& method) {
  return test_support::replay(static_cast<ReactiveMethod&>(method), problem);
}

class PlanarScene : public ::testing::TestWithParam<int> {};

TEST_P(PlanarScene, IsFreeWithTheDefaultGains) {
  const Problem problem = planar_7r(GetParam());
  const auto method = test_point();
  const Replay run = run_on(problem, *method);
  ASSERT_EQ(run.q.size(), static_cast<std::size_t>(problem.ticks + 1));
  EXPECT_THAT(test_support::sampled_hits(problem, run.q, 4000 / problem.ticks), IsEmpty());
  EXPECT_LT(run.tip_error, problem.tolerance);
  EXPECT_EQ(run.last.state, TickState::kUnclaimed);
  EXPECT_GT(run.clamped_ticks, 0);
}

INSTANTIATE_TEST_SUITE_P(Ticks, PlanarScene, ::testing::Values(200, 400, 1000),
                         ::testing::PrintToStringParamName());

TEST(TestPoint, CountsEveryPairOfTestPoints) {
  const Problem problem = planar_7r(50);
  const auto method = test_point({{"n", "9"}, {"m", "20"}, {"exempt_length", "0"}});
  const Replay run = run_on(problem, *method);
  const std::size_t steps = run.q.size() - 1 + (run.last.state == TickState::kInfeasible ? 1 : 0);
  EXPECT_EQ(method->counters().point_pairs, steps * 9 * 20 * 7 * 2);
}

TEST(TestPoint, FarFromObstaclesItIsPlainTracking) {
  Problem problem = planar_7r(100);
  problem.obstacles = {{"far", embedded(rotated_ellipse({20, 20}, {0.1, 0.1}, 0))}};
  const auto method = test_point();
  const Replay run = run_on(problem, *method);
  EXPECT_EQ(run.q.size(), 101U);
  EXPECT_EQ(run.clamped_ticks, 0);
}

TEST(TestPoint, BothLawsPushTheLinkAwayAndLeaveTheTipToFirstOrder) {
  for (const char* law : {"maciejewski_klein", "gradient_projection"}) {
    // The tip rests; an obstacle stands close beside link 3.
    Problem problem = planar_7r(400);
    ChainPose pose;
    problem.chain.forward(problem.start, pose);
    const Eigen::Vector3d tip = pose.tip();
    problem.desired_tip = [tip](double) { return tip; };
    const Eigen::Vector2d a = pose.p_WO.col(2).head<2>(), b = pose.p_WO.col(3).head<2>();
    const Eigen::Vector2d along = (b - a).normalized();
    const Eigen::Vector2d across(-along.y(), along.x());
    problem.obstacles = {
        {"ball", embedded(rotated_ellipse(0.5 * (a + b) + 0.06 * across, {0.05, 0.05}, 0))}};
    const auto distance = [&](const JointVector& q) {
      problem.chain.forward(q, pose);
      return static_cast<double>(test_support::DistanceOracle(pose.p_WO.col(2), pose.p_WO.col(3),
                                                              problem.obstacles[0].shape)
                                     .distance());
    };
    const auto method = test_point({{"law", law}, {"n", "41"}, {"m", "720"}});
    method->prepare(problem);
    StepInput input{.tick = 1, .t = problem.dt, .p_WT_desired = tip, .q = problem.start};
    StepOutput output;
    static_cast<ReactiveMethod&>(*method).step(input, output);
    EXPECT_EQ(output.clamp_count, 1) << law;
    EXPECT_EQ(output.clamps[0].link, 3) << law;
    EXPECT_GT(distance(output.q), distance(problem.start) + 1e-6) << law;
    problem.chain.forward(output.q, pose);
    const double moved = (output.q - problem.start).norm();
    EXPECT_GT(moved, 1e-4) << law;
    EXPECT_LT((pose.tip() - tip).norm(), 3 * moved * moved) << law;
  }
}

TEST(TestPoint, AMotionOfEqualShapesIsRest) {
  const Problem resting = planar_7r(200);
  Problem moving = resting;
  for (Obstacle& obstacle : moving.obstacles) {
    obstacle.motion.assign(static_cast<std::size_t>(moving.ticks) + 1, obstacle.shape);
  }
  const auto method = test_point();
  const Replay expected = run_on(resting, *method);
  const Replay found = run_on(moving, *method);
  EXPECT_EQ(found.q, expected.q);
  EXPECT_GT(found.clamped_ticks, 10);
}

/// planar_7r with its second obstacle coming closer.
Problem approached_arm() {
  Problem problem = planar_7r(400);
  const Ellipsoid shape = problem.obstacles[1].shape;
  for (int tick = 0; tick <= problem.ticks; ++tick) {
    problem.obstacles[1].motion.emplace_back(
        shape.center() + tick * Eigen::Vector3d(-1e-4, -5e-5, 0), shape.semi_axes(),
        Eigen::AngleAxisd(tick * 1e-3, Eigen::Vector3d::UnitZ()).toRotationMatrix());
  }
  return problem;
}

TEST(TestPoint, MeetsAMovingObstacleWhereItIsAtTheStartOfTheStep) {
  const Problem moving = approached_arm();
  Problem resting = moving;
  resting.obstacles[1].motion.clear();
  const auto method_moving = test_point(), method_resting = test_point();
  method_moving->prepare(moving);
  StepInput input{.q = moving.start};
  StepOutput found, expected;
  int pushed = 0;
  for (input.tick = 1; input.tick <= moving.ticks; ++input.tick) {
    input.t = moving.time(input.tick);
    input.p_WT_desired = moving.desired_tip(input.t);
    resting.obstacles[1].shape = moving.obstacles[1].at(input.tick - 1);
    method_resting->prepare(resting);
    static_cast<ReactiveMethod&>(*method_moving).step(input, found);
    static_cast<ReactiveMethod&>(*method_resting).step(input, expected);
    ASSERT_EQ(found.q, expected.q) << "tick " << input.tick;
    ASSERT_EQ(found.state, TickState::kUnclaimed) << "tick " << input.tick;
    input.q = found.q;
    pushed += found.clamp_count > 0;
  }
  EXPECT_GT(pushed, 10);
}

TEST(TestPoint, WarmStepsDoNotAllocateWhileAnObstacleMoves) {
  const Problem problem = approached_arm();
  const auto method = test_point();
  method->prepare(problem);
  StepInput input{.q = problem.start};
  StepOutput output;
  const test_support::AllocationGuard guard;
  for (input.tick = 1; input.tick <= problem.ticks; ++input.tick) {
    input.t = problem.time(input.tick);
    input.p_WT_desired = problem.desired_tip(input.t);
    static_cast<ReactiveMethod&>(*method).step(input, output);
    input.q = output.q;
  }
  EXPECT_EQ(guard.allocations(), 0U);
  EXPECT_EQ(output.state, TickState::kUnclaimed);
}

TEST(TestPoint, RefusesAnInfluenceBelowTheFullDistance) {
  EXPECT_THROW(test_point({{"influence", "0.001"}, {"full_distance", "0.02"}}), ParameterError);
}

}  // namespace
}  // namespace bqsa::baselines
