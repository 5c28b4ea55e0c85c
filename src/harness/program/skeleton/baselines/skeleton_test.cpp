#include "baselines/skeleton.hpp"

#include <gtest/gtest.h>

#include "support/paper_problems.hpp"
#include "support/replay.hpp"
#include "support/warm_run.hpp"

namespace bqsa::baselines {
namespace {

std::unique_ptr<Method> made() {
  const MethodEntry entry = skeleton_method();
  return entry.make(ParameterValues(entry.parameters));
}

double tip_error(Problem problem) {
  problem.obstacles.clear();
  const auto method = made();
  const test_support::Replay run =
      test_support::replay(static_cast<ReactiveMethod&>(*method), problem);
  EXPECT_EQ(run.q.size(), static_cast<std::size_t>(problem.ticks) + 1);
  return run.tip_error;
}

TEST(Skeleton, TracksToSecondOrderInTheControlPeriodWhereNothingIsNear) {
  const Problem coarse = test_support::puma560_ellipsoid();
  Problem fine = coarse;
  fine.ticks *= 4;
  fine.dt /= 4;
  const double ratio = tip_error(coarse) / tip_error(fine);
  EXPECT_GT(ratio, 12);
  EXPECT_LT(ratio, 20);
}

/// The arm of the planar scene, at rest, with an ellipse close to the middle of its fourth link.
struct NearMiss {
  Problem problem = test_support::planar_7r();
  StepInput input{.tick = 1, .t = problem.dt, .q = problem.start};
  ChainPose pose;

  NearMiss() {
    problem.chain.forward(problem.start, pose);
    input.p_WT_desired = pose.tip();
    const Eigen::Vector2d a = pose.p_WO.col(3).head<2>();
    const Eigen::Vector2d b = pose.p_WO.col(4).head<2>();
    const Eigen::Vector2d along = (b - a).normalized();
    const Eigen::Vector2d beside = (a + b) / 2 + 0.08 * Eigen::Vector2d(-along.y(), along.x());
    problem.obstacles = {{"post", embedded(rotated_ellipse(beside, {0.05, 0.05}, 0))}};
  }

  double distance(const JointVector& q) {
    problem.chain.forward(q, pose);
    const test_support::DistanceOracle oracle(pose.p_WO.col(3), pose.p_WO.col(4),
                                              problem.obstacles[0].shape);
    return static_cast<double>(oracle.distance());
  }
};

TEST(Skeleton, MovesALinkAwayFromAnObstacleAndLeavesTheTipWhereItIs) {
  NearMiss scene;
  const double before = scene.distance(scene.input.q);
  ASSERT_NEAR(before, 0.03, 1e-6);
  const auto method = made();
  method->prepare(scene.problem);
  StepOutput output;
  static_cast<ReactiveMethod&>(*method).step(scene.input, output);
  ASSERT_EQ(output.state, TickState::kUnclaimed);
  EXPECT_GT(scene.distance(output.q), before + 1e-4);
  const double step = (output.q - scene.input.q).norm();
  EXPECT_LT((scene.pose.tip() - scene.input.p_WT_desired).norm(), 4 * step * step);
  EXPECT_EQ(output.clamp_count, 1);
}

TEST(Skeleton, HoldsRatherThanExceedTheLargestStep) {
  NearMiss scene;
  scene.problem.limits.max_velocity = JointVector::Constant(7, 1e-4);
  const auto method = made();
  method->prepare(scene.problem);
  StepOutput output;
  static_cast<ReactiveMethod&>(*method).step(scene.input, output);
  EXPECT_EQ(output.state, TickState::kInfeasible);
  EXPECT_EQ(output.reason, Infeasible::kStepTooLarge);
  EXPECT_EQ(output.q, scene.input.q);
}

TEST(Skeleton, TakesNoMemoryInTheControlLoop) {
  if (!test_support::kCountsAllocations) GTEST_SKIP() << "the sanitizer brings its own malloc";
  const auto method = made();
  const test_support::WarmRun run =
      test_support::warm_run(static_cast<ReactiveMethod&>(*method), test_support::planar_7r());
  EXPECT_EQ(run.allocations, 0U);
}

}  // namespace
}  // namespace bqsa::baselines
