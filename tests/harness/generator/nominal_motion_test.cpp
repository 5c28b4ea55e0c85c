// Each filter on scenes in which its distance is known by hand, on both sides of its threshold.
#include "harness/generator/nominal_motion.hpp"

#include <gtest/gtest.h>

namespace bqsa::harness {
namespace {

constexpr double kStep = 0.0005;  // to either side of a threshold [m]

/// Four links of 0.5 m: three along x, the last one up. The tip goes down from (1.5, 0.5) by
/// `way`.
Problem bent_arm(double way) {
  Problem problem{.name = "bent",
                  .chain = SerialChain(planar_chain({0.5, 0.5, 0.5, 0.5})),
                  .ticks = 20,
                  .dt = 0.025};
  problem.start = JointVector::Zero(4);
  problem.start(3) = std::numbers::pi / 2;
  problem.desired_tip = [way](double t) -> Eigen::Vector3d {
    return {1.5, 0.5 - way * t / 0.5, 0};
  };
  return problem;
}

Obstacle disc(double x, double y, double radius = 0.1) {
  return {"disc", embedded(rotated_ellipse({x, y}, {radius, radius}, 0))};
}

TEST(NominalMotion, AtTheStartEveryLinkIsClear) {
  const NominalMotion nominal(bent_arm(0));
  EXPECT_TRUE(nominal.start_is_clear(disc(0.75, 0.1 + kStartClearance + kStep)));
  EXPECT_FALSE(nominal.start_is_clear(disc(0.75, 0.1 + kStartClearance - kStep)));
  EXPECT_TRUE(nominal.start_is_clear(disc(1.6 + kStartClearance + kStep, 0.25)));
  EXPECT_FALSE(nominal.start_is_clear(disc(1.6 + kStartClearance - kStep, 0.25)));
}

TEST(NominalMotion, AnObstacleThatComesLaterLeavesTheStartClear) {
  const NominalMotion nominal(bent_arm(0));
  Obstacle coming = disc(0.75, 0.5);
  for (int tick = 0; tick <= 20; ++tick) {
    coming.motion.push_back(embedded(rotated_ellipse({0.75, 0.5 - 0.025 * tick}, {0.1, 0.1}, 0)));
  }
  EXPECT_TRUE(nominal.start_is_clear(coming));
  EXPECT_FALSE(nominal.inner_links_are_clear(coming));
}

TEST(NominalMotion, ThePathIsClearBetweenTicksToo) {
  // 20 ticks of 10 cm: the discs stand halfway between two desired tips.
  const NominalMotion nominal(bent_arm(2.0));
  const double y = 0.5 - 0.85;
  EXPECT_TRUE(nominal.path_is_clear(disc(1.51 + kTipClearance + kStep, y, 0.01)));
  EXPECT_FALSE(nominal.path_is_clear(disc(1.51 + kTipClearance - kStep, y, 0.01)));
}

TEST(NominalMotion, AMovingObstacleIsLookedAtWhereItIs) {
  // It crosses the path at y = 0, from tick 8 to 12, where the tip is not at that time; or is.
  for (const bool meets : {false, true}) {
    const NominalMotion nominal(bent_arm(1.0));
    Obstacle crossing = disc(2.5, 0);
    for (int tick = 0; tick <= 20; ++tick) {
      const double y = meets ? 0 : 0.45;
      crossing.motion.push_back(embedded(rotated_ellipse({2.5 - 0.1 * tick, y}, {0.05, 0.05}, 0)));
    }
    EXPECT_EQ(nominal.path_is_clear(crossing), !meets);
  }
}

TEST(NominalMotion, OnlyLinksOneAndTwoAreInner) {
  const NominalMotion nominal(bent_arm(0));
  EXPECT_TRUE(nominal.inner_links_are_clear(disc(0.25, 0.1 + kInnerClearance + kStep)));
  EXPECT_FALSE(nominal.inner_links_are_clear(disc(0.25, 0.1 + kInnerClearance - kStep)));
  EXPECT_FALSE(nominal.inner_links_are_clear(disc(0.75, 0.1 + kInnerClearance - kStep)));
  EXPECT_TRUE(nominal.inner_links_are_clear(disc(1.25, 0.05)));
}

TEST(NominalMotion, OnlyLinksFromThreeOnAreHit) {
  const NominalMotion nominal(bent_arm(0));
  EXPECT_TRUE(nominal.outer_link_hits(disc(1.25, 0.1 - kHitDepth - kStep)));
  EXPECT_FALSE(nominal.outer_link_hits(disc(1.25, 0.1 - kHitDepth + kStep)));
  EXPECT_TRUE(nominal.outer_link_hits(disc(1.6 - kHitDepth - kStep, 0.25)));
  EXPECT_FALSE(nominal.outer_link_hits(disc(0.25, 0)));
  EXPECT_FALSE(nominal.outer_link_hits(disc(0.75, 0)));
}

TEST(NominalMotion, ThePathStaysInAShell) {
  const NominalMotion nominal(bent_arm(0.5));  // from (1.5, 0.5) to (1.5, 0)
  const double farthest = std::hypot(1.5, 0.5);
  const Eigen::Vector3d base = Eigen::Vector3d::Zero();
  EXPECT_TRUE(nominal.path_within(base, 1.5 - 1e-9, farthest + 1e-9));
  EXPECT_FALSE(nominal.path_within(base, 1.5 + 1e-9, farthest + 1e-9));
  EXPECT_FALSE(nominal.path_within(base, 1.5 - 1e-9, farthest - 1e-9));
}

TEST(NominalMotion, TracksWithinToleranceAndSteps) {
  EXPECT_TRUE(NominalMotion(bent_arm(0.1)).tracks());

  Problem exacting = bent_arm(0.1);
  exacting.tolerance = 1e-9;
  EXPECT_FALSE(NominalMotion(exacting).tracks());

  Problem out_of_reach = bent_arm(0);
  out_of_reach.desired_tip = [](double t) -> Eigen::Vector3d { return {1.5 + 2 * t, 0.5, 0}; };
  EXPECT_FALSE(NominalMotion(out_of_reach).tracks());

  Problem slow_joints = bent_arm(0.1);
  slow_joints.limits.max_velocity = JointVector::Constant(4, 0.01);
  EXPECT_FALSE(NominalMotion(slow_joints).tracks());
}

TEST(NominalMotion, KeepsJointLimits) {
  Problem problem = bent_arm(0.3);
  EXPECT_TRUE(NominalMotion(problem).keeps_limits());
  problem.limits.upper = problem.start.array() + 1e-3;
  problem.limits.lower = problem.start.array() - 1e-3;
  EXPECT_FALSE(NominalMotion(problem).keeps_limits());
}

}  // namespace
}  // namespace bqsa::harness
