#include "bqsa/joint_limit_clamp.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "bqsa/bqsa_planar.hpp"
#include "bqsa/bqsa_spatial.hpp"
#include "support/paper_problems.hpp"
#include "support/replay.hpp"
#include "support/warm_run.hpp"

namespace bqsa {
namespace {

using test_support::kDegree;
using test_support::replay;
using test_support::Replay;

JointVector joints(std::initializer_list<double> values) {
  JointVector q(static_cast<Eigen::Index>(values.size()));
  Eigen::Index i = 0;
  for (const double value : values) q(i++) = value;
  return q;
}

/// Three joints, the second without limits; they turn up to 1 rad/s.
Problem three_joints() {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  Problem problem{.name = "three joints",
                  .chain = SerialChain(planar_chain({1, 1, 1})),
                  .ticks = 10,
                  .dt = 0.01};
  problem.limits.lower = joints({-1, -kNone, -2});
  problem.limits.upper = joints({1, kNone, 2});
  problem.limits.max_velocity = joints({1, 1, 1});
  return problem;
}

TEST(JointLimitClamp, IsTheWayIntoTheBandTimesTheGain) {
  const Problem problem = three_joints();
  JointVector phi;
  // Bands of a tenth: 0.2 rad wide at joint 1, 0.4 rad at joint 3.
  EXPECT_TRUE(clamp_at_limits(problem, {.band = 0.1, .gain = 3}, joints({0.95, 100, -1.7}), phi));
  EXPECT_NEAR(phi(0), -3 * 0.15, 1e-14);
  EXPECT_EQ(phi(1), 0);
  EXPECT_NEAR(phi(2), 3 * 0.1, 1e-14);
  // Beyond a limit it goes on growing.
  EXPECT_TRUE(clamp_at_limits(problem, {.band = 0.1, .gain = 3}, joints({1.1, 0, 0}), phi));
  EXPECT_NEAR(phi(0), -3 * 0.3, 1e-14);
}

TEST(JointLimitClamp, LeavesTheBandInATickAtMost) {
  const Problem problem = three_joints();
  JointVector phi;
  ASSERT_TRUE(clamp_at_limits(problem, {.band = 0.1, .gain = 1000}, joints({0.95, 0, 0}), phi));
  EXPECT_NEAR(0.95 + problem.dt * phi(0), 0.8, 1e-14);
}

TEST(JointLimitClamp, IsZeroOutsideTheBandsAndWhereThereAreNone) {
  Problem problem = three_joints();
  JointVector phi;
  EXPECT_FALSE(clamp_at_limits(problem, {.band = 0.1}, joints({0.79, 0, 1.59}), phi));
  EXPECT_EQ(phi, joints({0, 0, 0}));
  EXPECT_FALSE(clamp_at_limits(problem, {.band = 0}, joints({1, 0, 2}), phi));
  EXPECT_EQ(phi, joints({0, 0, 0}));
  problem.limits = {};
  EXPECT_FALSE(clamp_at_limits(problem, {.band = 0.1}, joints({1, 0, 2}), phi));
  EXPECT_EQ(phi, joints({0, 0, 0}));
}

TEST(PartWithinSteps, KeepsEveryJointsLargestStepAndNoMoreThanThat) {
  const Problem problem = three_joints();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> speed(-0.9, 0.9);
  std::uniform_real_distribution<double> faster(-5, 5);
  int held_back = 0;
  for (int i = 0; i < 1000; ++i) {
    const JointVector q_dot = joints({speed(random), speed(random), speed(random)});
    const JointVector self_motion = joints({faster(random), 0, faster(random)});
    const double part = part_within_steps(problem, q_dot, self_motion);
    ASSERT_GE(part, 0);
    ASSERT_LE(part, 1);
    const JointVector sum = q_dot + part * self_motion;
    EXPECT_LE(sum.cwiseAbs().maxCoeff(), 1);
    if (part == 1) continue;
    ++held_back;
    EXPECT_NEAR(std::max(std::abs(sum(0)), std::abs(sum(2))), 0.95, 1e-12);
  }
  EXPECT_GT(held_back, 500);
  EXPECT_EQ(part_within_steps(problem, joints({2, 0, 0}), joints({1, 0, 0})), 0);
}

std::unique_ptr<ReactiveMethod> make_planar(const BqsaSettings& settings) {
  return std::make_unique<BqsaPlanar>(PlanarVariant::kExact, settings);
}

std::unique_ptr<ReactiveMethod> make_spatial(const BqsaSettings& settings) {
  return std::make_unique<BqsaSpatial>(settings);
}

using Make = std::unique_ptr<ReactiveMethod> (*)(const BqsaSettings& settings);

/// The problem without its obstacles, and with limits of which one is exceeded by plain tracking: of
/// the joints from `first` on, that of the one that turns farthest, at 0.8 of its way.
Problem limited(Problem problem, int first, Make make) {
  problem.obstacles.clear();
  const Replay tracked = replay(*make({}), problem);
  EXPECT_EQ(tracked.q.size(), static_cast<std::size_t>(problem.ticks) + 1);
  int joint = first;
  double farthest = 0;  // way of that joint [rad]
  for (const JointVector& q : tracked.q) {
    const JointVector way = q - problem.start;
    for (int j = first; j < way.size(); ++j) {
      if (std::abs(way(j)) <= std::abs(farthest)) continue;
      joint = j;
      farthest = way(j);
    }
  }
  problem.limits.lower = JointVector::Constant(problem.start.size(), -2.9);
  problem.limits.upper = JointVector::Constant(problem.start.size(), 2.9);
  (farthest < 0 ? problem.limits.lower : problem.limits.upper)(joint) =
      problem.start(joint) + 0.8 * farthest;
  return problem;
}

void expect_kept_limits(const Problem& problem, Make make) {
  BqsaSettings settings;
  settings.release = Release::kNever;  // no other way to keep limits
  const Replay without = replay(*make(settings), problem);
  EXPECT_EQ(without.last.state, TickState::kInfeasible);
  EXPECT_EQ(without.last.reason, Infeasible::kJointLimit);

  settings.joint_limits.band = 0.1;
  const Replay with = replay(*make(settings), problem);
  ASSERT_EQ(with.q.size(), static_cast<std::size_t>(problem.ticks) + 1);
  EXPECT_LE(with.tip_error, 1e-9);
  for (const JointVector& q : with.q) EXPECT_TRUE(problem.within_limits(q));
  EXPECT_LE(with.largest_step, kDefaultMaxStep);
}

TEST(JointLimitAvoidance, KeepsLimitsThatPlainTrackingExceeds) {
  constexpr int kWrist = 3;  // the PUMA's arm has little choice where the tip has to be
  expect_kept_limits(limited(test_support::planar_7r(), 0, make_planar), make_planar);
  expect_kept_limits(limited(test_support::puma560_ellipsoid(), kWrist, make_spatial),
                     make_spatial);
}

TEST(JointLimitAvoidance, WorksBesideObstacles) {
  Problem problem = test_support::planar_7r();
  problem.limits.lower = JointVector::Constant(7, -80 * kDegree);
  problem.limits.upper = JointVector::Constant(7, 80 * kDegree);
  BqsaSettings settings;
  settings.joint_limits.band = 0.2;
  BqsaPlanar method(PlanarVariant::kExact, settings);
  const Replay run = replay(method, problem);
  ASSERT_EQ(run.q.size(), static_cast<std::size_t>(problem.ticks) + 1);
  EXPECT_LE(run.tip_error, 1e-9);
  EXPECT_GT(run.clamped_ticks, 0);
  EXPECT_TRUE(test_support::sampled_hits(problem, run.q, 4).empty());
}

TEST(JointLimitAvoidance, DoesNotAllocate) {
  const Problem problem = limited(test_support::planar_7r(), 0, make_planar);
  BqsaSettings settings;
  settings.joint_limits.band = 0.2;
  const test_support::WarmRun warm = test_support::warm_run(*make_planar(settings), problem);
  EXPECT_EQ(warm.allocations, 0U);
  EXPECT_EQ(warm.free, problem.ticks);
}

}  // namespace
}  // namespace bqsa
