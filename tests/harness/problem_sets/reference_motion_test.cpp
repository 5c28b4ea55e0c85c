// Reference motions of an arm whose free space is known in closed form.
#include "harness/problem_sets/reference_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace bqsa::harness {
namespace {

JointVector joints(double a, double b) {
  JointVector q(2);
  q << a, b;
  return q;
}

JointLimits limits() {
  return {.lower = joints(-3, -3), .upper = joints(3, 3), .max_velocity = joints(1, 2)};
}

/// Two joints, a wall at q1 = 0 up to q2 = 1: the way from one side to the other leads over it.
bool over_the_wall(const JointVector& from, const JointVector& to) {
  for (int k = 0; k <= 200; ++k) {
    const JointVector q = from + k / 200.0 * (to - from);
    if (std::abs(q(0)) < 0.1 && q(1) < 1) return false;
  }
  return true;
}

TEST(ReferenceMotion, GoesStraightWhereItCan) {
  const auto corners = plan_reference(joints(-1, 2), {joints(1, 2)}, limits(), over_the_wall, {});
  ASSERT_EQ(corners.size(), 2U);
  EXPECT_EQ(corners[1], joints(1, 2));
}

TEST(ReferenceMotion, FindsItsWayAndIsRepeatable) {
  const auto plan = [](std::uint64_t seed) {
    return plan_reference(joints(-1, 0), {joints(1, 0)}, limits(), over_the_wall, {.seed = seed});
  };
  const auto corners = plan(1);
  ASSERT_GE(corners.size(), 3U);
  EXPECT_EQ(corners.front(), joints(-1, 0));
  EXPECT_EQ(corners.back(), joints(1, 0));
  for (std::size_t k = 1; k < corners.size(); ++k) {
    EXPECT_TRUE(over_the_wall(corners[k - 1], corners[k]));
    EXPECT_LE(corners[k].cwiseAbs().maxCoeff(), 3);
  }
  EXPECT_EQ(plan(1), corners);
  EXPECT_NE(plan(2), corners);
}

TEST(ReferenceMotion, GivesUpWhereThereIsNone) {
  long asked = 0;
  const auto walled_in = [&asked](const JointVector& from, const JointVector& to) {
    ++asked;
    return (from(0) < 0) == (to(0) < 0);
  };
  EXPECT_TRUE(
      plan_reference(joints(-1, 0), {joints(1, 0)}, limits(), walled_in, {.most_checks = 500})
          .empty());
  EXPECT_LT(asked, 600);
}

TEST(ReferenceMotion, KeepsItsPartOfTheSpeedLimits) {
  const std::vector<JointVector> corners = {joints(0, 0), joints(1, 0.5), joints(1, -1),
                                            joints(0.2, -1)};
  const ReferenceSettings settings{.speed = 0.5, .tick = 0.01};
  const Trajectory motion = timed_reference(corners, limits(), settings);
  EXPECT_EQ(motion.q.front(), corners.front());
  EXPECT_EQ(motion.q.back(), corners.back());
  // Full speed takes 1 + 0.75 + 0.8 s; half of it and the quintic's peak 3.75 times that.
  EXPECT_NEAR(motion.t.back(), 2.55 * 3.75, 1e-12);
  double fastest = 0;
  for (std::size_t k = 1; k < motion.q.size(); ++k) {
    const double dt = motion.t[k] - motion.t[k - 1];
    EXPECT_LE(dt, settings.tick + 1e-12);
    const JointVector speed = (motion.q[k] - motion.q[k - 1]) / dt;
    fastest = std::max({fastest, std::abs(speed(0)) / 1, std::abs(speed(1)) / 2});
  }
  EXPECT_LE(fastest, settings.speed * (1 + 1e-9));
  EXPECT_GT(fastest, settings.speed * 0.99);
}

TEST(ReferenceMotion, PassesItsCorners) {
  const std::vector<JointVector> corners = {joints(0, 0), joints(1, 0.5), joints(1, -1)};
  const Trajectory motion = timed_reference(corners, limits(), {.tick = 0.001});
  double nearest = 1;
  for (const JointVector& q : motion.q) nearest = std::min(nearest, (q - corners[1]).norm());
  EXPECT_LT(nearest, 1e-3);
}

}  // namespace
}  // namespace bqsa::harness
