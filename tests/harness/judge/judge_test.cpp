#include "harness/judge/judge.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "judge_scenes.hpp"
#include "support/prismatic_arms.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kDegree = std::numbers::pi / 180;

/// A planar arm of three links of 0.4 m that turns by a degree a tick about its base; the desired
/// path is where its tip goes, turned aside by `drift` metres.
class TurningArm {
 public:
  TurningArm() : problem(test_support::free_problem(planar_chain({0.4, 0.4, 0.4}), 20)) {
    problem.start << 0.2, 0.3, 0.4;
    problem.tolerance = 1e-3;
    follow_path(0);
    JointVector step(3);
    step << kDegree, 0, 0;
    trajectory = test_support::steady_motion(problem, step);
  }

  void follow_path(double drift) {
    problem.desired_tip = [drift, dt = problem.dt](double t) {
      return Vector3d(tip(t / dt) + Vector3d(0, 0, drift));
    };
  }

  /// Tip at a time in ticks, in closed form.
  static Vector3d tip(double tick) {
    const double q = 0.2 + tick * kDegree;
    return {0.4 * (std::cos(q) + std::cos(q + 0.3) + std::cos(q + 0.7)),
            0.4 * (std::sin(q) + std::sin(q + 0.3) + std::sin(q + 0.7)), 0};
  }

  void add_ball(const Vector3d& center, double radius) {
    problem.obstacles.push_back({"ball", Ellipsoid(center, Vector3d::Constant(radius))});
  }

  Judgement judge() const { return Judge(problem).judge(trajectory); }

  Problem problem;
  Trajectory trajectory;
};

TEST(Judge, ATrackedFreeRunSucceeds) {
  TurningArm run;
  run.add_ball({-1, 0, 0}, 0.3);
  const Judgement judgement = run.judge();
  EXPECT_TRUE(judgement.success());
  EXPECT_EQ(judgement.rows, 21);
  EXPECT_FALSE(judgement.touching);
  EXPECT_THAT(judgement.contacts, IsEmpty());
  EXPECT_LT(judgement.at_ticks.max, 1e-12);
  EXPECT_LT(judgement.start_error, 1e-12);
  EXPECT_NEAR(judgement.clearance_at_ticks, 0.7, 1e-12);  // of the base
  EXPECT_NEAR(judgement.max_joint_step, kDegree, 1e-12);
  EXPECT_EQ(judgement.disagreement, "");
}

TEST(Judge, WithoutObstaclesTheClearanceIsInfinite) {
  const Judgement judgement = TurningArm().judge();
  EXPECT_TRUE(judgement.success());
  EXPECT_EQ(judgement.clearance, kInfinity);
  EXPECT_EQ(judgement.clearance_at_ticks, kInfinity);
}

TEST(Judge, StandingStillIsFreeButDrifts) {
  TurningArm run;
  run.add_ball({-1, 0, 0}, 0.3);
  for (JointVector& q : run.trajectory.q) q = run.problem.start;
  const Judgement judgement = run.judge();
  EXPECT_THAT(judgement.failures, ElementsAre(Failure::kDrift));
  EXPECT_EQ(judgement.max_joint_step, 0);
  EXPECT_EQ(judgement.at_ticks.max_tick, 20);
}

TEST(Judge, DriftCountsFromTheToleranceOn) {
  TurningArm run;
  run.follow_path(1e-3 * (1 + 1e-9));
  const Judgement beyond = run.judge();
  EXPECT_THAT(beyond.failures, ElementsAre(Failure::kDrift));
  EXPECT_NEAR(beyond.at_ticks.max, 1e-3, 1e-9);
  EXPECT_NEAR(beyond.at_ticks.mean, 1e-3, 1e-9);
  EXPECT_NEAR(beyond.at_ticks.rms, 1e-3, 1e-9);
  EXPECT_NEAR(beyond.at_ticks.max_per_axis.z(), 1e-3, 1e-9);
  EXPECT_NEAR(beyond.at_ticks.max_per_axis.x(), 0, 1e-12);
  run.follow_path(1e-3 * (1 - 1e-9));
  EXPECT_TRUE(run.judge().success());
}

/// A joint about x that carries the tip on its axis, so that it turns in place, by 2 degrees a tick.
class TurningTip {
 public:
  TurningTip() : problem(test_support::free_problem(arm(), 10)) {
    problem.desired_tip = [](double) { return Vector3d(0.5, 0, 0); };
    problem.desired_rotation = [this](double t) { return desired(t / problem.dt); };
    problem.task_kind = TaskKind::kPose;
    trajectory = test_support::steady_motion(problem, JointVector::Constant(1, 2 * kDegree));
  }

  /// A placement whose z is x of the world.
  static ChainDescription arm() {
    ChainDescription arm;
    Eigen::Matrix3d along_x;
    along_x << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    arm.placements.push_back({.R_PJ = along_x});
    arm.p_LT << 0, 0, 0.5;
    arm.R_LT = along_x.transpose();  // the tip's frame is the world's at first
    return arm;
  }

  /// About x by 2 degrees a tick, and from then on `aside` about an axis of its own.
  Eigen::Matrix3d desired(double tick) const {
    return Eigen::AngleAxisd(aside, axis) *
           Eigen::AngleAxisd(2 * kDegree * tick, Vector3d::UnitX()).toRotationMatrix();
  }

  Judgement judge() const { return Judge(problem).judge(trajectory); }

  Problem problem;
  Trajectory trajectory;
  double aside = 0;
  Vector3d axis = Vector3d::UnitX();
};

TEST(Judge, AnOrientationThatIsFollowedSucceeds) {
  TurningTip run;
  for (const TaskKind kind : {TaskKind::kAxis, TaskKind::kPose}) {
    run.problem.task_kind = kind;
    const Judgement judgement = run.judge();
    EXPECT_TRUE(judgement.success());
    EXPECT_LT(judgement.orientation_at_ticks.max, 1e-12);
    EXPECT_LT(judgement.orientation_between_ticks.max, 1e-12);
  }
}

TEST(Judge, OrientationCountsFromTheToleranceOn) {
  TurningTip run;
  for (const double angle : {1e-7, 0.01, 1.0, 3.0, std::numbers::pi}) {
    run.axis = Vector3d(1, 2, -2) / 3;
    run.aside = angle;
    run.problem.orientation_tolerance = angle * (1 - 1e-6);
    const Judgement beyond = run.judge();
    EXPECT_THAT(beyond.failures, ElementsAre(Failure::kOrientation)) << angle;
    EXPECT_NEAR(beyond.orientation_at_ticks.max, angle, 1e-12) << angle;
    EXPECT_NEAR(beyond.orientation_at_ticks.mean, angle, 1e-12) << angle;
    EXPECT_NEAR(beyond.orientation_between_ticks.mean, angle, 1e-12) << angle;
    run.problem.orientation_tolerance = angle * (1 + 1e-6);
    EXPECT_TRUE(run.judge().success()) << angle;
    run.problem.task_kind = TaskKind::kPosition;  // nobody asked
    run.problem.orientation_tolerance = 0;
    EXPECT_TRUE(run.judge().success()) << angle;
    EXPECT_EQ(run.judge().orientation_at_ticks.max, 0);
    run.problem.task_kind = TaskKind::kPose;
  }
}

TEST(Judge, TheSpinOfAnAxisTaskDoesNotCount) {
  TurningTip run;
  run.axis = Vector3d::UnitX();
  run.aside = 0.5;
  run.problem.orientation_tolerance = 0.4;
  EXPECT_FALSE(run.judge().success());
  run.problem.task_kind = TaskKind::kAxis;
  EXPECT_FALSE(run.judge().success());
  EXPECT_NEAR(run.judge().orientation_at_ticks.max, 0.5, 1e-12);  // z is across x
  // Turned about its own z beforehand, the axis stays where it is.
  run.aside = 0;
  run.problem.desired_rotation = [&run](double t) {
    return Eigen::Matrix3d(run.desired(t / run.problem.dt) *
                           Eigen::AngleAxisd(0.5, Vector3d::UnitZ()).toRotationMatrix());
  };
  EXPECT_TRUE(run.judge().success());
  EXPECT_LT(run.judge().orientation_at_ticks.max, 1e-12);
  run.problem.task_kind = TaskKind::kPose;
  EXPECT_THAT(run.judge().failures, ElementsAre(Failure::kOrientation));
}

TEST(Judge, OrientationIsReportedBetweenTicksToo) {
  TurningTip run;
  run.problem.desired_rotation = [&run](double t) {  // 0 at ticks
    const double tick = t / run.problem.dt;
    const double aside = tick > 1 ? 0.2 * std::abs(std::sin(std::numbers::pi * tick)) : 0;
    return Eigen::Matrix3d(Eigen::AngleAxisd(aside, Vector3d::UnitY()) * run.desired(tick));
  };
  const Judgement judgement = run.judge();
  EXPECT_TRUE(judgement.success());  // as between ticks the tip's path does not count either
  EXPECT_LT(judgement.orientation_at_ticks.max, 1e-12);
  // Of ten samples evenly within a tick the middle two are nearest to its middle.
  EXPECT_NEAR(judgement.orientation_between_ticks.max, 0.2 * std::sin(std::numbers::pi * 5 / 11),
              1e-12);
  EXPECT_GE(judgement.orientation_between_ticks.max_tick, 2);
}

TEST(Judge, OneTickOffItsOrientationIsNamed) {
  TurningTip run;
  run.trajectory.q[7](0) += 3 * kDegree;
  const Judgement judgement = run.judge();
  EXPECT_THAT(judgement.failures, ElementsAre(Failure::kOrientation));
  EXPECT_NEAR(judgement.orientation_at_ticks.max, 3 * kDegree, 1e-12);
  EXPECT_NEAR(judgement.orientation_at_ticks.mean, 0.3 * kDegree, 1e-12);
  EXPECT_EQ(judgement.orientation_at_ticks.max_tick, 7);
}

TEST(Judge, DriftAtTheLastTickAloneCounts) {
  TurningArm run;
  run.trajectory.q.back()(2) += 0.01;
  const Judgement judgement = run.judge();
  EXPECT_THAT(judgement.failures, ElementsAre(Failure::kDrift));
  EXPECT_EQ(judgement.at_ticks.max_tick, 20);
}

TEST(Judge, ErrorsOfTheStartAndBetweenTicksAreReportedButNoFailure) {
  TurningArm run;
  run.problem.desired_tip = [](double t) {
    const double tick = t / 0.01;
    const bool at_tick = std::abs(tick - std::round(tick)) < 1e-6;
    return Vector3d(TurningArm::tip(tick) + Vector3d(0, at_tick && tick > 0.5 ? 0 : 0.01, 0));
  };
  const Judgement judgement = run.judge();
  EXPECT_TRUE(judgement.success());
  EXPECT_NEAR(judgement.start_error, 0.01, 1e-12);
  EXPECT_NEAR(judgement.between_ticks.max, 0.01, 1e-12);
  EXPECT_NEAR(judgement.between_ticks.mean, 0.01, 1e-12);
  EXPECT_LT(judgement.at_ticks.max, 1e-12);
}

TEST(Judge, TheMotionFromTheStartOntoThePathIsNoTrackingError) {
  TurningArm run;
  run.problem.desired_tip = [](double t) {
    const double tick = t / 0.01;
    return Vector3d(TurningArm::tip(tick) + Vector3d(0, tick < 1 - 1e-6 ? 0.01 : 0, 0));
  };
  const Judgement judgement = run.judge();
  EXPECT_NEAR(judgement.start_error, 0.01, 1e-12);
  EXPECT_LT(judgement.at_ticks.max, 1e-12);
  EXPECT_LT(judgement.between_ticks.max, 1e-3);
}

TEST(Judge, ALinkInAnObstacleIsNamed) {
  TurningArm run;
  run.add_ball({-1, 0, 0}, 0.3);
  run.add_ball(TurningArm::tip(10), 0.005);
  run.problem.obstacles[1].name = "other";
  const Judgement judgement = run.judge();
  EXPECT_THAT(judgement.failures, ElementsAre(Failure::kCollision));
  ASSERT_EQ(judgement.contacts.size(), 1U);
  const Contact& contact = judgement.contacts[0];
  EXPECT_EQ(contact.link, 3);
  EXPECT_EQ(contact.obstacle, "other");
  EXPECT_TRUE(contact.at_tick);
  // The tip, 1.15 m from the base, moves by 20 mm a tick: the ball is hit at tick 10 alone.
  EXPECT_EQ(contact.ticks, 1);
  EXPECT_EQ(contact.first_tick, 10);
  EXPECT_LT(judgement.clearance, 0);
}

TEST(Judge, ALinkWhollyInsideAnObstacleCollides) {
  TurningArm run;
  run.add_ball({0, 0, 0}, 5);
  const Judgement judgement = run.judge();
  EXPECT_THAT(judgement.failures, ElementsAre(Failure::kCollision));
  ASSERT_EQ(judgement.contacts.size(), 3U);
  for (const Contact& contact : judgement.contacts) EXPECT_EQ(contact.ticks, 21);
}

TEST(Judge, CatchesAMotionThatTunnelsThroughASheet) {
  TurningArm run;
  JointVector step(3);
  step << 14 * kDegree, 0, 0;
  run.trajectory = test_support::steady_motion(run.problem, step);
  run.problem.tolerance = kInfinity;
  // A sheet 0.2 mm thick across the path of the tip, halfway between ticks 2 and 3.
  const double reach = TurningArm::tip(0).norm();
  const Vector3d tip =
      Eigen::AngleAxisd(2.5 * 14 * kDegree, Vector3d::UnitZ()) * TurningArm::tip(0);
  const Eigen::AngleAxisd outward(std::atan2(tip.y(), tip.x()), Vector3d::UnitZ());
  run.problem.obstacles.push_back(
      {"sheet",
       Ellipsoid(tip * (reach + 0.04) / reach, {0.05, 1e-4, 10}, outward.toRotationMatrix())});
  const Judgement judgement = run.judge();
  EXPECT_THAT(judgement.failures, ElementsAre(Failure::kCollision));
  ASSERT_EQ(judgement.contacts.size(), 1U);
  EXPECT_FALSE(judgement.contacts[0].at_tick);
  EXPECT_EQ(judgement.contacts[0].ticks, 0);
  EXPECT_EQ(judgement.contacts[0].first_tick, 3);
  EXPECT_GT(judgement.clearance_at_ticks, 0.05);
  EXPECT_LT(judgement.clearance, 0);
}

TEST(Judge, TheClearanceBetweenTicksIsFoundThoughBothEndsAreFar) {
  constexpr double kTrue = 0.1;  // the outstretched arm of 1.8 m points at the ball halfway
  for (const double turn : {0.2, -0.2}) {
    Problem problem = test_support::free_problem(planar_chain({1, 0.8}), 1);
    problem.obstacles.push_back({"far", Ellipsoid({-1, 1, 0}, Vector3d::Constant(0.1))});
    problem.obstacles.push_back(
        {"near", Ellipsoid({1.9001 * std::cos(turn / 2), 1.9001 * std::sin(turn / 2), 0},
                           Vector3d::Constant(1e-4))});
    JointVector step(2);
    step << turn, 0;
    const Trajectory trajectory = test_support::steady_motion(problem, step);
    const Judgement judgement = Judge(problem).judge(trajectory);
    EXPECT_TRUE(judgement.success());
    EXPECT_GT(judgement.clearance_at_ticks, 0.21);
    EXPECT_GE(judgement.clearance, kTrue - 1e-12);
    EXPECT_LE(judgement.clearance, kTrue * 1.0011);
  }
}

TEST(Judge, TheClearanceOfARunIsTheLeastOfDenseSamples) {
  test_support::Generator generator(7);
  int nearer_than_ticks = 0, free = 0;
  for (int k = 0; k < 200; ++k) {
    Problem problem = test_support::free_problem(planar_chain({0.5, 0.4, 0.3}), 8);
    for (const char* name : {"one", "two", "three"}) {
      const double angle = test_support::uniform(generator, -3, 3);
      const double distance = test_support::uniform(generator, 0.3, 1.6);
      problem.obstacles.push_back(
          {name, Ellipsoid({distance * std::cos(angle), distance * std::sin(angle), 0},
                           {0.05, 0.02, test_support::log_uniform(generator, 1e-3, 1)})});
    }
    JointVector step(3);
    for (int j = 0; j < 3; ++j) step(j) = test_support::uniform(generator, -0.2, 0.2);
    const Judgement judgement = Judge(problem).judge(test_support::steady_motion(problem, step));
    if (!judgement.success()) continue;
    ++free;
    constexpr int kSamples = 100;
    Problem dense = problem;
    dense.ticks = problem.ticks * kSamples;
    const double sampled =
        Judge(dense).judge(test_support::steady_motion(dense, step / kSamples)).clearance_at_ticks;
    ASSERT_LE(judgement.clearance, sampled + std::max(1e-6, 1.01e-3 * sampled)) << "case " << k;
    ASSERT_GE(judgement.clearance, sampled - 5e-3) << "case " << k;  // half a sample's way
    if (sampled < 0.99 * judgement.clearance_at_ticks) ++nearer_than_ticks;
  }
  EXPECT_GT(free, 40);
  EXPECT_GE(nearer_than_ticks, 10);
}

TEST(Judge, TouchingIsFreeAndFlagged) {
  const double edge = TurningArm::tip(20).norm() + 0.1;
  for (const double gap : {0.5e-6, 0.0, -0.5e-6}) {
    TurningArm run;
    run.add_ball(TurningArm::tip(20).normalized() * (edge + gap), 0.1);
    const Judgement judgement = run.judge();
    EXPECT_THAT(judgement.failures, IsEmpty()) << gap;
    EXPECT_TRUE(judgement.touching) << gap;
    EXPECT_NEAR(judgement.clearance_at_ticks, gap, 1e-9);
  }
  TurningArm apart;
  apart.add_ball(TurningArm::tip(20).normalized() * (edge + 2e-6), 0.1);
  EXPECT_TRUE(apart.judge().success());
  EXPECT_FALSE(apart.judge().touching);
  TurningArm deep;
  deep.add_ball(TurningArm::tip(20).normalized() * (edge - 2e-6), 0.1);
  EXPECT_THAT(deep.judge().failures, ElementsAre(Failure::kCollision));
}

TEST(Judge, TouchingAtTheStartIsRememberedWhenOtherObstaclesComeNear) {
  TurningArm run;
  const double reach = TurningArm::tip(0).norm();
  run.add_ball(TurningArm::tip(0).normalized() * (reach + 0.1), 0.1);
  run.add_ball(TurningArm::tip(20).normalized() * (reach + 0.105), 0.1);
  const Judgement judgement = run.judge();
  EXPECT_TRUE(judgement.success());
  EXPECT_TRUE(judgement.touching);
}

TEST(Judge, LinkRadiusCountsAsMuchAsTheObstacle) {
  for (const double gap : {2e-6, -2e-6}) {
    TurningArm run;
    run.problem.link_radius = 0.03;
    run.add_ball(TurningArm::tip(20).normalized() * (TurningArm::tip(20).norm() + 0.13 + gap), 0.1);
    const Judgement judgement = run.judge();
    EXPECT_EQ(judgement.success(), gap > 0);
    EXPECT_NEAR(judgement.clearance_at_ticks, gap, 1e-9);
  }
}

TEST(Judge, JumpsCountFromTheLargestStepOn) {
  for (const double excess : {-1e-6, 1e-6}) {
    TurningArm run;
    run.problem.tolerance = kInfinity;
    run.trajectory.q[10](1) += kDefaultMaxStep * (1 + excess);
    for (std::size_t k = 11; k < 21; ++k) run.trajectory.q[k](1) = run.trajectory.q[10](1);
    const Judgement judgement = run.judge();
    EXPECT_EQ(judgement.success(), excess < 0);
    EXPECT_EQ(judgement.max_joint_step_tick, 10);
    if (excess > 0) {
      EXPECT_THAT(judgement.failures, ElementsAre(Failure::kJump));
    }
  }
}

TEST(Judge, AVelocityLimitReplacesTheDefaultStep) {
  TurningArm run;
  run.problem.limits.max_velocity = JointVector::Constant(3, 0.99 * kDegree / run.problem.dt);
  EXPECT_THAT(run.judge().failures, ElementsAre(Failure::kJump));
  run.problem.limits.max_velocity.setConstant(kDegree / run.problem.dt);
  EXPECT_TRUE(run.judge().success());
}

TEST(Judge, AFullTurnIsAJumpThoughThePoseIsTheSame) {
  TurningArm run;
  for (std::size_t k = 10; k < 21; ++k) run.trajectory.q[k](2) += 2 * std::numbers::pi;
  const Judgement judgement = run.judge();
  EXPECT_THAT(judgement.failures, ElementsAre(Failure::kJump));
  EXPECT_NEAR(judgement.max_joint_step, 2 * std::numbers::pi, 1e-9);
}

TEST(Judge, AStartThatDiffersByAFullTurnIsWrong) {
  TurningArm run;
  for (JointVector& q : run.trajectory.q) q(0) += 2 * std::numbers::pi;
  EXPECT_THAT(run.judge().failures, ElementsAre(Failure::kWrongStart));
}

TEST(Judge, TheStartMayDifferByRoundingAlone) {
  TurningArm run;
  run.trajectory.q[0](1) += 0.9e-9;
  EXPECT_TRUE(run.judge().success());
  run.trajectory.q[0](1) += 0.2e-9;
  EXPECT_THAT(run.judge().failures, ElementsAre(Failure::kWrongStart));
}

TEST(Judge, JointLimitsAreKept) {
  for (const double sign : {1.0, -1.0}) {
    TurningArm run;
    run.problem.limits.lower = JointVector::Constant(3, -10);
    run.problem.limits.upper = JointVector::Constant(3, 10);
    run.problem.limits.upper(0) = run.trajectory.q.back()(0) + sign * 1e-6;
    EXPECT_EQ(run.judge().success(), sign > 0);
    run.problem.limits.upper(0) = 10;
    run.problem.limits.lower(1) = 0.3 - sign * 1e-6;
    EXPECT_EQ(run.judge().success(), sign > 0);
    if (sign < 0) {
      EXPECT_THAT(run.judge().failures, ElementsAre(Failure::kJointLimit));
    }
  }
}

TEST(Judge, AnEmptyTrajectoryIsIncomplete) {
  TurningArm run;
  run.add_ball({0, 0, 0}, 5);
  run.trajectory = {};
  const Judgement judgement = run.judge();
  EXPECT_THAT(judgement.failures, ElementsAre(Failure::kIncomplete));
  EXPECT_EQ(judgement.rows, 0);
}

TEST(Judge, ARunThatStopsIsIncompleteAndItsRowsAreJudged) {
  TurningArm run;
  run.add_ball(TurningArm::tip(10), 0.02);
  run.trajectory.t.resize(13);
  run.trajectory.q.resize(13);
  const Judgement judgement = run.judge();
  EXPECT_THAT(judgement.failures, ElementsAre(Failure::kIncomplete, Failure::kCollision));
  EXPECT_EQ(judgement.rows, 13);
}

TEST(Judge, TooManyRowsAreIncomplete) {
  TurningArm run;
  run.trajectory.t.push_back(run.problem.time(21));
  run.trajectory.q.push_back(run.trajectory.q.back());
  EXPECT_THAT(run.judge().failures, ElementsAre(Failure::kIncomplete));
}

TEST(Judge, TimesAndRowsMustBeAsMany) {
  TurningArm fewer;
  fewer.trajectory.t.pop_back();
  EXPECT_THAT(fewer.judge().failures, ElementsAre(Failure::kIncomplete));
  TurningArm more;
  more.trajectory.t.push_back(1);
  EXPECT_THAT(more.judge().failures, ElementsAre(Failure::kIncomplete));
}

TEST(Judge, TimesMustBeThoseOfTheTicks) {
  TurningArm run;
  run.trajectory.t[7] *= 1 + 1e-6;
  EXPECT_THAT(run.judge().failures, ElementsAre(Failure::kIncomplete));
  run.trajectory.t[7] = run.problem.time(7) * (1 + 1e-12);
  EXPECT_TRUE(run.judge().success());
}

TEST(Judge, ARowOfTheWrongWidthEndsTheRun) {
  for (const int width : {0, 2, 4}) {
    TurningArm run;
    run.trajectory.q[8] = JointVector::Zero(width);
    const Judgement judgement = run.judge();
    EXPECT_THAT(judgement.failures, ElementsAre(Failure::kIncomplete)) << width;
    EXPECT_EQ(judgement.rows, 8) << width;
  }
}

TEST(Judge, NumbersThatAreNotFiniteEndTheRunAndThePrefixIsJudged) {
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    TurningArm joint;
    joint.add_ball(TurningArm::tip(10), 0.02);
    joint.trajectory.q[12](1) = bad;
    EXPECT_THAT(joint.judge().failures, ElementsAre(Failure::kNotFinite, Failure::kCollision));
    EXPECT_EQ(joint.judge().rows, 12);
    TurningArm time;
    time.trajectory.t[3] = bad;
    EXPECT_THAT(time.judge().failures, ElementsAre(Failure::kNotFinite));
    TurningArm first;
    first.trajectory.q[0](0) = bad;
    EXPECT_THAT(first.judge().failures, ElementsAre(Failure::kNotFinite));
    EXPECT_EQ(first.judge().rows, 0);
  }
}

TEST(Judge, HugeJumpsEndUndecidedInsteadOfStalling) {
  for (const double jump : {1e9, 1e300, std::numeric_limits<double>::max()}) {
    TurningArm run;
    run.problem.tolerance = kInfinity;
    run.add_ball({2, 0, 0}, 2 - TurningArm::tip(0).norm() - 0.01);
    for (std::size_t k = 1; k < 21; ++k) run.trajectory.q[k](0) = k % 2 == 0 ? jump : -jump;
    const Judgement judgement = run.judge();
    EXPECT_THAT(judgement.failures, Contains(Failure::kUndecided)) << jump;
    EXPECT_THAT(judgement.failures, Contains(Failure::kJump)) << jump;
    EXPECT_THAT(judgement.failures, Not(Contains(Failure::kCollision))) << jump;
  }
}

TEST(Judge, PairsAreShownByTheNameOfTheObstacle) {
  TurningArm run;
  run.problem.obstacles.push_back({"left", Ellipsoid({-1, 0, 0}, Vector3d::Constant(0.1))});
  run.problem.obstacles.push_back({"right", Ellipsoid({2, 0, 0}, Vector3d::Constant(0.1))});
  EXPECT_EQ(LinkScene(run.problem).show({.link = 2, .obstacle = 1}), "link 3, obstacle right");
}

TEST(Judge, EveryFailureHasAName) {
  for (const Failure failure :
       {Failure::kDisagreement, Failure::kNotFinite, Failure::kIncomplete, Failure::kWrongStart,
        Failure::kCollision, Failure::kUndecided, Failure::kJump, Failure::kJointLimit,
        Failure::kDrift, Failure::kOrientation}) {
    EXPECT_STRNE(name_of(failure), "unknown");
  }
}

/// Steps of joints that turn and of those that slide are measured and limited apart.
TEST(Judge, ASlideIsNoTurn) {
  const Problem problem = test_support::free_problem(test_support::swinging_slide(), 2);
  const auto judged = [&](double slide) {
    Trajectory trajectory;
    for (int k = 0; k <= 2; ++k) {
      trajectory.t.push_back(problem.time(k));
      trajectory.q.emplace_back(Eigen::Vector2d(0.1 * k, k == 2 ? 0.01 + slide : 0.01 * k));
    }
    return Judge(problem).judge(trajectory);
  };
  const Judgement free = judged(0.999 * kDefaultMaxSlide);
  EXPECT_TRUE(free.success());
  EXPECT_DOUBLE_EQ(free.max_joint_step, 0.1);
  EXPECT_NEAR(free.max_joint_slide, 0.999 * kDefaultMaxSlide, 1e-15);
  EXPECT_EQ(free.max_joint_slide_tick, 2);
  EXPECT_THAT(judged(1.001 * kDefaultMaxSlide).failures, ElementsAre(Failure::kJump));
}

}  // namespace
}  // namespace bqsa::harness
