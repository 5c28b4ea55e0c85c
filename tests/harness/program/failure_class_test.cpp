#include "harness/failure_class.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "test_methods.hpp"

namespace bqsa::harness {
namespace {

constexpr double kLength = 0.5;  ///< of each of the three links [m]
constexpr double kFar = 100;     ///< where obstacles wait at tick 0 [m]
constexpr double kRight = std::numbers::pi / 2;
const Eigen::Vector2d kTip(1, 0);

/// The arm stands as a trapezoid over the x axis, its links 1, 2, 3 at 60, 0 and -60 degrees.
const JointVector kTrapezoid = Eigen::Vector3d(2, -2, -2) * kRight / 3;

/// Three links whose tip is to stay where it is for one tick.
Problem arm_that_stays(double scale = 1) {
  Problem problem{"arm",
                  SerialChain(planar_chain({scale * kLength, scale * kLength, scale * kLength})),
                  {},
                  [scale](double) -> Eigen::Vector3d {
                    return {scale * kTip.x(), scale * kTip.y(), 0};
                  }};
  problem.ticks = 1;
  problem.dt = 0.05;
  problem.start = kTrapezoid;
  return problem;
}

/// An obstacle that comes from above within the tick.
Obstacle coming(const Eigen::Vector2d& center, const Eigen::Vector2d& semi_axes) {
  const Eigen::Vector2d far(center.x(), kFar);
  Obstacle obstacle{"comer", embedded(rotated_ellipse(far, semi_axes, 0))};
  obstacle.motion = {obstacle.shape, embedded(rotated_ellipse(center, semi_axes, 0))};
  return obstacle;
}

/// Nothing above y = 0.1 m is free: both middle joints have to come down below the x axis.
Problem with_ceiling() {
  Problem problem = arm_that_stays();
  problem.obstacles = {coming({0.5, 1.1}, {50, 1})};
  return problem;
}

/// A ball that comes down on the middle of link 2, by the overlap [m].
Problem with_ball(double overlap) {
  constexpr double kRadius = 0.05;
  const double height = kLength * std::sin(kTrapezoid(0));
  Problem problem = arm_that_stays();
  problem.obstacles = {coming({0.5, height + kRadius - overlap}, {kRadius, kRadius})};
  return problem;
}

/// Link 2 has to cross it, whatever the posture.
Problem with_wall() {
  Problem problem = arm_that_stays();
  problem.obstacles = {coming({0.6, 0}, {0.02, 50})};
  return problem;
}

bool samples_free(const std::vector<Eigen::Vector2d>& points, const Problem& problem) {
  constexpr int kSamples = 200;
  for (const Obstacle& obstacle : problem.obstacles) {
    const Ellipsoid& shape = obstacle.at(1);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      for (int k = 0; k <= kSamples; ++k) {
        const Eigen::Vector2d p =
            points[i] + k / static_cast<double>(kSamples) * (points[i + 1] - points[i]);
        const Eigen::Vector2d from_center = p - shape.center().head<2>();
        if (from_center.cwiseQuotient(shape.semi_axes().head<2>()).norm() <= 1) return false;
      }
    }
  }
  return true;
}

/// Largest joint difference from kTrapezoid to the nearest free posture at tick 1, over a dense grid
/// of all postures with the tip at kTip; infinite if none is free. Obstacles have axes along x and y.
double densely_nearest(const Problem& problem) {
  constexpr int kGrid = 20000;
  double nearest = std::numeric_limits<double>::infinity();
  const auto turned = [](double angle) -> Eigen::Vector2d {
    return kLength * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  };
  for (int k = 0; k < kGrid; ++k) {
    const double psi_1 = 4 * kRight * k / kGrid;
    const Eigen::Vector2d O_2 = turned(psi_1);
    const Eigen::Vector2d rest = kTip - O_2;
    if (rest.norm() > 2 * kLength) continue;
    for (const double side : {-1, 1}) {
      const double psi_2 =
          std::atan2(rest.y(), rest.x()) + side * std::acos(rest.norm() / (2 * kLength));
      const Eigen::Vector2d O_3 = O_2 + turned(psi_2);
      const Eigen::Vector2d last = kTip - O_3;
      const double psi_3 = std::atan2(last.y(), last.x());
      if (!samples_free({{0, 0}, O_2, O_3, kTip}, problem)) continue;
      const Eigen::Vector3d q(psi_1, psi_2 - psi_1, psi_3 - psi_2);
      double difference = 0;
      for (int j = 0; j < 3; ++j) {
        difference =
            std::max(difference, std::abs(std::remainder(q(j) - kTrapezoid(j), 4 * kRight)));
      }
      nearest = std::min(nearest, difference);
    }
  }
  return nearest;
}

FailureClass class_of(const Problem& problem, const JointVector& q = kTrapezoid) {
  return diagnose(problem, 1, Infeasible::kNoFreeConfiguration, q).failure;
}

TEST(FailureClassOf, AWayWithinTheTickIsMissed) {
  EXPECT_EQ(class_of(arm_that_stays()), FailureClass::kMissed);
  const Problem light = with_ball(0.005);
  EXPECT_GT(densely_nearest(light), 0);
  EXPECT_LT(densely_nearest(light), kDefaultMaxStep);
  EXPECT_EQ(class_of(light), FailureClass::kMissed);
}

TEST(FailureClassOf, AWayThatIsTooFarForOneTickIsLate) {
  const Problem heavy = with_ball(0.02);
  EXPECT_GT(densely_nearest(heavy), kDefaultMaxStep);
  EXPECT_LT(densely_nearest(heavy), 1);
  EXPECT_EQ(class_of(heavy), FailureClass::kLate);

  constexpr double kStep = 1e-3;  // moves no point of the arm by more than 4.5 mm
  Problem slow = with_ball(0.01);
  slow.limits.max_velocity = JointVector::Constant(3, kStep / slow.dt);
  EXPECT_GT(densely_nearest(slow), kStep);
  EXPECT_EQ(class_of(slow), FailureClass::kLate);
}

TEST(FailureClassOf, BehindAWallThereIsNoRoom) {
  EXPECT_EQ(densely_nearest(with_wall()), std::numeric_limits<double>::infinity());
  const Diagnosis diagnosis =
      diagnose(with_wall(), 1, Infeasible::kNoFreeConfiguration, kTrapezoid);
  EXPECT_EQ(diagnosis.failure, FailureClass::kNoRoom);
  EXPECT_TRUE(std::isnan(diagnosis.nearest_free));
}

TEST(FailureClassOf, BelowACeilingTheArmIsOnTheWrongBranch) {
  const double nearest = densely_nearest(with_ceiling());
  ASSERT_GT(nearest, 1) << "within reach of the search";
  ASSERT_LT(nearest, 2 * kRight);
  const Diagnosis diagnosis =
      diagnose(with_ceiling(), 1, Infeasible::kNoFreeConfiguration, kTrapezoid);
  EXPECT_EQ(diagnosis.failure, FailureClass::kBranch);
  EXPECT_GT(diagnosis.nearest_free, nearest - 0.01);
  EXPECT_LT(diagnosis.nearest_free, nearest + 0.1);
}

TEST(FailureClassOf, AFreePostureBeyondTheJointLimitsIsNoRoom) {
  Problem problem = with_ceiling();
  const double nearest = densely_nearest(problem);
  problem.limits.lower = kTrapezoid.array() - 0.9 * nearest;
  problem.limits.upper = kTrapezoid.array() + 0.9 * nearest;
  EXPECT_EQ(class_of(problem), FailureClass::kNoRoom);
  problem.limits.lower = kTrapezoid.array() - 4 * kRight;
  problem.limits.upper = kTrapezoid.array() + 4 * kRight;
  EXPECT_EQ(class_of(problem), FailureClass::kBranch);
}

TEST(FailureClassOf, LinkRadiusAndMarginTakeRoom) {
  Problem problem = arm_that_stays();
  problem.obstacles = {
      {"3 cm below the tip", embedded(rotated_ellipse({1, -0.08}, {0.05, 0.05}, 0))}};
  EXPECT_EQ(class_of(problem), FailureClass::kMissed);
  problem.link_radius = 0.016;
  EXPECT_EQ(class_of(problem), FailureClass::kMissed);
  problem.margin = 0.016;
  EXPECT_EQ(class_of(problem), FailureClass::kNoRoom);
  problem.link_radius = 0;
  EXPECT_EQ(class_of(problem), FailureClass::kMissed);
}

TEST(FailureClassOf, ADivergedCorrectionIsSingular) {
  EXPECT_EQ(diagnose(with_wall(), 1, Infeasible::kDiverged, kTrapezoid).failure,
            FailureClass::kSingular);
}

/// Smallest singular value of the tip's Jacobian of three links at 0, bend and 2 bend, from the
/// eigenvalues of the 2 x 2 matrix J Jᵀ [m].
double smallest_singular(double bend, double length) {
  Eigen::Matrix<double, 2, 3> J = Eigen::Matrix<double, 2, 3>::Zero();
  for (int joint = 0; joint < 3; ++joint) {
    for (int link = joint; link < 3; ++link) {
      J.col(joint) += length * Eigen::Vector2d(-std::sin(link * bend), std::cos(link * bend));
    }
  }
  const Eigen::Matrix2d M = J * J.transpose();
  const double half_trace = M.trace() / 2;
  return std::sqrt(half_trace - std::sqrt(half_trace * half_trace - M.determinant()));
}

TEST(FailureClassOf, AStretchedArmIsSingularInProportionToASmallReach) {
  struct Case {
    double length;     ///< of a link [m]
    double threshold;  ///< [m]
  };
  for (const Case& arm : {Case{0.5, 0.05}, Case{2, 0.05}, Case{0.1, 0.015}}) {
    double straight = 0;
    double bent = 1;
    for (int halving = 0; halving < 60; ++halving) {
      const double middle = 0.5 * (straight + bent);
      (smallest_singular(middle, arm.length) < arm.threshold ? straight : bent) = middle;
    }
    ASSERT_GT(bent, 0.005) << arm.length;
    Problem problem = arm_that_stays();
    problem.chain = SerialChain(planar_chain({arm.length, arm.length, arm.length}));
    for (const double share : {0.98, 1.02}) {
      const JointVector q = Eigen::Vector3d(0, share * bent, share * bent);
      ChainPose pose;
      problem.chain.forward(q, pose);
      problem.desired_tip = [tip = pose.tip()](double) { return tip; };
      EXPECT_EQ(class_of(problem, q), share < 1 ? FailureClass::kSingular : FailureClass::kMissed)
          << arm.length;
    }
  }
}

TEST(FailureClassOf, TheTickIsTheOneAtWhichTheMethodGaveUp) {
  Problem problem = with_wall();
  const std::vector<Ellipsoid> motion = problem.obstacles[0].motion;
  problem.obstacles[0].motion = {motion[0], motion[0], motion[1], motion[0]};
  problem.ticks = 3;
  const auto class_at = [&problem](int tick) {
    return diagnose(problem, tick, Infeasible::kNoFreeMotion, kTrapezoid).failure;
  };
  EXPECT_EQ(class_at(1), FailureClass::kMissed);
  EXPECT_EQ(class_at(2), FailureClass::kNoRoom);
}

TEST(FailureClassOf, TheTipGoesToWhereItShouldBeAtThatTick) {
  Problem problem = arm_that_stays();
  problem.obstacles = {coming({3, 0}, {1, 1})};
  problem.dt = 1;
  problem.ticks = 2;
  problem.obstacles[0].motion.push_back(problem.obstacles[0].motion.back());
  problem.limits.max_velocity = JointVector::Constant(3, 0.26);
  problem.desired_tip = [](double t) -> Eigen::Vector3d { return {t < 1.5 ? 1. : 9., 0, 0}; };
  const auto class_at = [&problem](int tick) {
    return diagnose(problem, tick, Infeasible::kStepTooLarge, kTrapezoid).failure;
  };
  EXPECT_EQ(class_at(1), FailureClass::kMissed);
  EXPECT_EQ(class_at(2), FailureClass::kNoRoom) << "out of reach";
}

TEST(FailureClassOf, TheAnswerIsAlwaysTheSame) {
  const auto once = [] {
    return diagnose(with_ceiling(), 1, Infeasible::kNoFreeConfiguration, kTrapezoid).nearest_free;
  };
  const double first = once();
  EXPECT_EQ(first, once());
}

TEST(FailureClassOf, SpatialArmsTheSame) {
  Problem problem = load_scenario(BQSA_SOURCE_DIR "/scenarios/puma560_wall.yaml").problem;
  problem.obstacles.clear();
  EXPECT_EQ(class_of(problem, problem.start), FailureClass::kMissed);
  // The base stands at x = 0, the tip at 0.644 m.
  problem.obstacles = {{"wall", Ellipsoid({0.3, 0, 0}, {0.02, 50, 50})}};
  EXPECT_EQ(class_of(problem, problem.start), FailureClass::kNoRoom);
}

TEST(FailureClassOf, AnArmThatTheSearchDoesNotTakeIsNeitherMissedNorLate) {
  Problem problem = arm_that_stays();
  ChainDescription chain = planar_chain({kLength, kLength});
  chain.p_LT << kLength, 0, 0;
  problem.chain = SerialChain(chain);
  problem.desired_tip = [](double) -> Eigen::Vector3d { return {1, 0, 0}; };
  // Link 2 and the tool are one: stretched to 1 m.
  const double elbow = std::acos(-0.125 / 0.5);
  const JointVector q = Eigen::Vector2d(std::acos(0.25), -elbow);
  const Diagnosis diagnosis = diagnose(problem, 1, Infeasible::kNoFreeConfiguration, q);
  EXPECT_EQ(diagnosis.failure, FailureClass::kBranch);
  EXPECT_LT(diagnosis.nearest_free, 1e-3) << "nothing is in its way";
}

}  // namespace
}  // namespace bqsa::harness
