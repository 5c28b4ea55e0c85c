#include "harness/judge/motion_quality.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "judge_scenes.hpp"

namespace bqsa::harness {
namespace {

using test_support::free_problem;
using test_support::Generator;
using test_support::uniform;

using Motion = std::function<JointVector(double)>;

Trajectory sampled(const Problem& problem, const Motion& motion) {
  Trajectory trajectory;
  for (int k = 0; k <= problem.ticks; ++k) {
    trajectory.t.push_back(problem.time(k));
    trajectory.q.push_back(motion(problem.time(k)));
  }
  return trajectory;
}

MotionQuality quality_of(const Problem& problem, const Motion& motion) {
  return motion_quality(problem, sampled(problem, motion), problem.ticks + 1);
}

JointVector joints(std::initializer_list<double> values) {
  JointVector q(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), q.data());
  return q;
}

/// A planar arm of three unit links whose tip stays where it is: the elbow of the first two goes
/// round a four-bar linkage.
JointVector self_motion_of_3r(double phase) {
  const Eigen::Vector2d tip(1.2, 0.3);
  const double q1 = 0.9 + phase;
  const Eigen::Vector2d elbow(std::cos(q1), std::sin(q1));
  const Eigen::Vector2d way = tip - elbow;
  const double bend = std::acos(way.squaredNorm() / 2 - 1);  // of two unit links over `way`
  const double second = std::atan2(way.y(), way.x()) - bend / 2;
  return joints({q1, second - q1, bend});
}

TEST(MotionQuality, ManipulabilityOfThePlanar2RIsThatOfYoshikawa) {
  Generator generator(1);
  for (int number = 0; number < 50; ++number) {
    const double l1 = uniform(generator, 0.2, 2), l2 = uniform(generator, 0.2, 2);
    const double from = uniform(generator, -3, 3), rate = uniform(generator, -3, 3);
    const Problem problem = free_problem(planar_chain({l1, l2}), 40);
    const auto motion = [&](double t) { return joints({5 * t, from + rate * t}); };
    double least = l1 * l2, sum = 0, least_value = l1 + l2;
    for (int k = 1; k <= problem.ticks; ++k) {
      const double q2 = from + rate * problem.time(k);
      const double manipulability = l1 * l2 * std::abs(std::sin(q2));
      least = std::min(least, manipulability);
      sum += manipulability;
      // Both squares of the singular values add up to |J|², and their product is known.
      const double squares = l1 * l1 + 2 * l1 * l2 * std::cos(q2) + 2 * l2 * l2;
      const double root =
          std::sqrt(std::max(0.0, squares * squares - 4 * manipulability * manipulability));
      least_value = std::min(least_value, manipulability / std::sqrt((squares + root) / 2));
    }
    const MotionQuality quality = quality_of(problem, motion);
    EXPECT_NEAR(quality.manipulability_min, least, 1e-12) << "case " << number;
    EXPECT_NEAR(quality.manipulability_mean, sum / problem.ticks, 1e-12) << "case " << number;
    EXPECT_NEAR(quality.singular_value_min, least_value, 1e-12) << "case " << number;
  }
}

/// Base turn, shoulder and elbow: det J = l1 l2 sin(q3) (l1 cos(q2) + l2 cos(q2 + q3)).
TEST(MotionQuality, ManipulabilityInSpaceIsTheDeterminantOfASquareJacobian) {
  const double l1 = 0.7, l2 = 0.4;
  ChainDescription chain;
  chain.rows = {{.alpha = std::numbers::pi / 2, .d = 0.5}, {.a = l1}, {.a = l2}};
  const Problem problem = free_problem(chain, 30);
  const auto motion = [](double t) { return joints({3 * t, 0.3 + t, 0.5 + 2 * t}); };
  double sum = 0;
  for (int k = 1; k <= problem.ticks; ++k) {
    const JointVector q = motion(problem.time(k));
    sum += std::abs(l1 * l2 * std::sin(q(2)) * (l1 * std::cos(q(1)) + l2 * std::cos(q(1) + q(2))));
  }
  EXPECT_NEAR(quality_of(problem, motion).manipulability_mean, sum / problem.ticks, 1e-12);
}

TEST(MotionQuality, AnArmOfFewerJointsThanTheTaskHasNoManipulability) {
  const Problem problem = free_problem(planar_chain({1}), 5);
  const MotionQuality quality = quality_of(problem, [](double t) { return joints({t}); });
  EXPECT_EQ(quality.manipulability_min, 0);
  EXPECT_EQ(quality.singular_value_min, 0);
  EXPECT_LE(quality.null_space_share, 1e-24);
}

TEST(MotionQuality, APureSelfMotionHasTheWholeShare) {
  const Problem problem = free_problem(planar_chain({1, 1, 1}), 200);
  const MotionQuality quality =
      quality_of(problem, [](double t) { return self_motion_of_3r(0.1 * t); });
  EXPECT_NEAR(quality.null_space_share, 1, 1e-6);
}

TEST(MotionQuality, AMotionWithoutRedundancyHasNoShare) {
  const Problem problem = free_problem(planar_chain({1, 0.8}), 50);
  const MotionQuality quality = quality_of(problem, [](double t) {
    return joints({t, 0.5 + 2 * t});
  });
  EXPECT_LE(quality.null_space_share, 1e-24);
}

/// A stretched arm moves its tip across its own direction by (3, 2, 1) dq, and that alone; the other
/// two dimensions of the joint space do not move it.
TEST(MotionQuality, AStretchedArmHasTwoDimensionsOfSelfMotion) {
  Problem problem = free_problem(planar_chain({1, 1, 1}), 2);
  const Eigen::Vector3d dq(1e-4, 2e-4, -5e-4);
  // The middle of the step from tick 1 to tick 2 is the stretched arm, but for very little.
  const auto motion = [&](double t) -> JointVector {
    return Eigen::Vector3d(0.7, 0, 1e-10) + (t / problem.dt - 1.5) * dq;
  };
  const Eigen::Vector3d row(3, 2, 1);
  const double moving = std::pow(row.dot(dq), 2) / row.squaredNorm();
  EXPECT_NEAR(quality_of(problem, motion).null_space_share, 1 - moving / dq.squaredNorm(), 1e-7);
}

TEST(MotionQuality, WhereNothingMovesThereIsNoShare) {
  const Problem problem = free_problem(planar_chain({1, 1}), 5);
  const MotionQuality quality = quality_of(problem, [](double) { return joints({1, 1}); });
  EXPECT_TRUE(std::isnan(quality.null_space_share));
  EXPECT_EQ(quality.jerk_rms, 0);
}

TEST(MotionQuality, TheJerkOfACubicIsItsThirdDerivative) {
  const Problem problem = free_problem(planar_chain({1, 1}), 60);
  const MotionQuality quality = quality_of(problem, [](double t) {
    return joints({2 * t * t * t - t * t + 1, 0.5 * t * t * t + 3 * t});
  });
  EXPECT_NEAR(quality.jerk_rms, std::sqrt((12.0 * 12.0 + 3.0 * 3.0) / 2), 1e-6);
}

/// Of +-a in turn each third difference is 8 a.
TEST(MotionQuality, ChatteringIsJerk) {
  const Problem problem = free_problem(planar_chain({1}), 20);
  int tick = 0;
  const MotionQuality quality =
      quality_of(problem, [&tick](double) { return joints({tick++ % 2 == 0 ? 1e-3 : -1e-3}); });
  EXPECT_NEAR(quality.jerk_rms, 8e-3 / std::pow(problem.dt, 3), 1e-6);
}

TEST(MotionQuality, TheMotionToTheFirstTickCountsInNothingButTheDrift) {
  const Problem problem = free_problem(planar_chain({1, 1, 1}), 30);
  const auto smooth = [](double t) { return joints({1 + t, 2 * t, 1 + t * t}); };
  const auto late = [&](double t) { return t == 0 ? joints({3, 0, 0}) : smooth(t); };
  const MotionQuality one = quality_of(problem, smooth), other = quality_of(problem, late);
  EXPECT_EQ(one.manipulability_min, other.manipulability_min);
  EXPECT_EQ(one.manipulability_mean, other.manipulability_mean);
  EXPECT_EQ(one.null_space_share, other.null_space_share);
  EXPECT_EQ(one.jerk_rms, other.jerk_rms);
}

/// The tip on a circle about the base, once around.
class ClosedPath : public ::testing::Test {
 protected:
  static constexpr double kReach = 1.5;

  ClosedPath() {
    problem_.tolerance = 1e-3;
    problem_.desired_tip = [this](double t) { return tip_at(turns_ * t / problem_.duration()); };
  }

  static Eigen::Vector3d tip_at(double turns) {
    const double angle = 2 * std::numbers::pi * turns;
    return {kReach * std::cos(angle), kReach * std::sin(angle), 0};
  }

  /// With the tip at tip_at(0); `second` is the other angle by which it can be.
  static JointVector posture(bool second) {
    const double bend = (second ? -2 : 2) * std::acos(kReach / 2);
    return joints({-bend / 2, bend});
  }

  Problem problem_ = free_problem(planar_chain({1, 1}), 100);
  double turns_ = 1;
};

TEST_F(ClosedPath, DriftIsTheDifferenceOfItsEnds) {
  const JointVector first = posture(false), second = posture(true);
  const MotionQuality repeated = quality_of(problem_, [&](double) { return first; });
  EXPECT_EQ(repeated.closed_path_drift, 0);
  EXPECT_EQ(repeated.closed_path_drift_joint, 0);
  const MotionQuality drifted =
      quality_of(problem_, [&](double t) { return t < 0.5 ? first : second; });
  EXPECT_DOUBLE_EQ(drifted.closed_path_drift, (second - first).norm());
  EXPECT_DOUBLE_EQ(drifted.closed_path_drift_joint, std::abs(second(1) - first(1)));
}

TEST_F(ClosedPath, ATurnCounts) {
  const double turn = 2 * std::numbers::pi;
  const MotionQuality quality = quality_of(problem_, [&](double t) -> JointVector {
    return posture(false) + joints({turn * t / problem_.duration(), 0});
  });
  EXPECT_NEAR(quality.closed_path_drift, turn, 1e-12);
}

TEST_F(ClosedPath, ThereIsNoDriftOfAnOpenPath) {
  const auto motion = [](double) { return posture(false); };
  turns_ = 1.5;
  EXPECT_TRUE(std::isnan(quality_of(problem_, motion).closed_path_drift));
  turns_ = 1 - 0.9 * problem_.tolerance / (2 * std::numbers::pi * kReach);
  EXPECT_EQ(quality_of(problem_, motion).closed_path_drift, 0) << "closed within the tolerance";
  turns_ = 1 - 1.1 * problem_.tolerance / (2 * std::numbers::pi * kReach);
  EXPECT_TRUE(std::isnan(quality_of(problem_, motion).closed_path_drift));
}

TEST_F(ClosedPath, ThereIsNoDriftOfAMotionThatStopsOrDoesNotStartOnIt) {
  const Trajectory whole = sampled(problem_, [](double) { return posture(false); });
  EXPECT_FALSE(std::isnan(motion_quality(problem_, whole, 101).closed_path_drift));
  EXPECT_TRUE(std::isnan(motion_quality(problem_, whole, 100).closed_path_drift));
  const MotionQuality beside = quality_of(problem_, [](double) -> JointVector {
    return posture(false) + joints({2e-3, 0});
  });
  EXPECT_TRUE(std::isnan(beside.closed_path_drift));
}

TEST(MotionQuality, ShortMotionsHaveFewFigures) {
  const Problem problem = free_problem(planar_chain({1, 1}), 10);
  const Trajectory trajectory = sampled(problem, [](double t) {
    return joints({1 + t * t * t, 1 + t});
  });
  for (int rows = 0; rows <= 5; ++rows) {
    const MotionQuality quality = motion_quality(problem, trajectory, rows);
    EXPECT_EQ(std::isfinite(quality.manipulability_min), rows >= 2) << rows;
    EXPECT_EQ(std::isfinite(quality.manipulability_mean), rows >= 2) << rows;
    EXPECT_EQ(std::isfinite(quality.singular_value_min), rows >= 2) << rows;
    EXPECT_EQ(std::isfinite(quality.null_space_share), rows >= 3) << rows;
    EXPECT_EQ(std::isfinite(quality.jerk_rms), rows >= 5) << rows;
  }
}

/// Nothing that a method answers may upset the harness.
TEST(MotionQuality, HugeAnglesHaveNumbersOrNone) {
  const Problem problem = free_problem(planar_chain({1, 1, 1}), 10);
  const MotionQuality quality = quality_of(problem, [](double t) {
    return joints({t < 0.05 ? -1e308 : 1.7e308, 1e308, 3});
  });
  EXPECT_GE(quality.manipulability_min, 0);
  EXPECT_FALSE(std::isfinite(quality.jerk_rms));
}

}  // namespace
}  // namespace bqsa::harness
