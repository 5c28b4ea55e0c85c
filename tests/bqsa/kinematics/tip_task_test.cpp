// Rows and errors of the tip's task against rotations made by the exponential series, textbook products
// and central differences.

#include "bqsa/tip_task.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <ostream>

#include "support/allocation_guard.hpp"
#include "support/prismatic_arms.hpp"
#include "support/sampling.hpp"

namespace bqsa {

void PrintTo(TaskKind kind, std::ostream* out) {
  *out << (kind == TaskKind::kAxis ? "axis" : "pose");
}

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test_support::Generator;
using test_support::log_uniform;
using test_support::random_rotation;
using test_support::random_vector;
using test_support::uniform;

constexpr double kPi = std::numbers::pi;

/// exp of the skew matrix of v, by its power series with the squarings of v / 2^10 undone.
Matrix3d exponential(const Vector3d& v) {
  Matrix3d S;
  S << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  constexpr int kSquarings = 10;
  S /= std::exp2(kSquarings);
  Matrix3d sum = Matrix3d::Identity(), term = Matrix3d::Identity();
  for (int k = 1; k < 12; ++k) {
    term = term * S / k;
    sum += term;
  }
  for (int k = 0; k < kSquarings; ++k) sum = sum * sum;
  return sum;
}

TEST(RotationVector, IsTheLogarithm) {
  Generator generator(1);
  int cases = 0;
  for (int k = 0; k < 3000; ++k, ++cases) {
    const double angle = k % 3 == 0   ? log_uniform(generator, 1e-12, 1)
                         : k % 3 == 1 ? uniform(generator, 0, kPi)
                                      : kPi - log_uniform(generator, 1e-6, 1);
    const Vector3d v = angle * random_vector<3>(generator, 1).normalized();
    const Vector3d found = rotation_vector(exponential(v));
    EXPECT_LT((found - v).norm(), 1e-12 + 1e-9 * (k % 3 == 2)) << "case " << k;
  }
  EXPECT_EQ(cases, 3000);
}

/// Where differences of elements of R vanish beside 1, small turns keep their digits.
TEST(RotationVector, KeepsTheDigitsOfSmallTurns) {
  for (const double angle : {1e-3, 1e-6, 1e-9, 1e-12, 1e-100}) {
    const Vector3d v = angle * Vector3d(0.6, 0, -0.8);
    EXPECT_LT((rotation_vector(exponential(v)) - v).norm(), 1e-10 * angle) << angle;
  }
  EXPECT_EQ(rotation_vector(Matrix3d::Identity()), Vector3d::Zero());
}

TEST(RotationVector, OfHalfATurnHasOneOfTheTwoDirections) {
  Generator generator(2);
  for (int k = 0; k < 300; ++k) {
    const Vector3d axis =
        k < 3 ? Vector3d(Vector3d::Unit(k)) : random_vector<3>(generator, 1).normalized();
    const Matrix3d R = 2 * axis * axis.transpose() - Matrix3d::Identity();
    const Vector3d found = rotation_vector(R);
    EXPECT_NEAR(found.norm(), kPi, 1e-12) << k;
    EXPECT_LT(found.cross(axis).norm(), 1e-7) << k;
  }
}

/// Arms in all notations: rows, modified rows, placements with slides.
ChainDescription random_arm(Generator& generator, int kind) {
  ChainDescription arm;
  if (kind == 2) {
    arm = test_support::random_prismatic_arm(generator, 6);
  } else {
    arm.convention = kind == 0 ? DhConvention::kStandard : DhConvention::kModified;
    for (int j = 0; j < 7; ++j) {
      arm.rows.push_back({uniform(generator, -0.5, 0.5), uniform(generator, -3, 3),
                          uniform(generator, -0.5, 0.5), uniform(generator, -1, 1)});
    }
    arm.p_LT << 0.1, 0.2, 0.3;
  }
  arm.R_WB = random_rotation<3>(generator);
  arm.R_LT = random_rotation<3>(generator);
  return arm;
}

JointVector random_posture(Generator& generator, const SerialChain& chain) {
  JointVector q(chain.joints());
  for (int j = 0; j < chain.joints(); ++j) q(j) = uniform(generator, -kPi, kPi);
  return q;
}

/// The orientation of the tip by the textbook, one turn after the other.
Matrix3d textbook_rotation(const ChainDescription& arm, const JointVector& q) {
  const auto turn = [](const Vector3d& axis, double angle) { return exponential(angle * axis); };
  Matrix3d R = arm.R_WB;
  for (int j = 0; j < arm.joints(); ++j) {
    const auto i = static_cast<std::size_t>(j);
    if (arm.is_placed()) {
      R = R * arm.placements[i].R_PJ;
      if (!arm.is_prismatic(j)) R = R * turn(Vector3d::UnitZ(), q(j));
      continue;
    }
    const DhRow& row = arm.rows[i];
    const Matrix3d about_z = turn(Vector3d::UnitZ(), q(j) + row.offset);
    const Matrix3d about_x = turn(Vector3d::UnitX(), row.alpha);
    R = arm.convention == DhConvention::kStandard ? Matrix3d(R * about_z * about_x)
                                                  : Matrix3d(R * about_x * about_z);
  }
  return R * arm.R_LT;
}

TEST(TipTask, TheTipFrameIsThatOfTheTextbook) {
  Generator generator(3);
  for (int k = 0; k < 300; ++k) {
    const SerialChain chain(random_arm(generator, k % 3));
    const JointVector q = random_posture(generator, chain);
    ChainPose pose;
    chain.forward(q, pose);
    EXPECT_LT((chain.tip_rotation(pose) - textbook_rotation(chain.description(), q)).norm(), 1e-12)
        << "case " << k;
    const JointVector near = q + 1e-3 * JointVector::Ones(chain.joints());
    chain.forward_from(q, near, pose);
    EXPECT_LT((chain.tip_rotation(pose) - textbook_rotation(chain.description(), near)).norm(),
              1e-12)
        << "case " << k;
  }
}

class TipTaskOfKind : public ::testing::TestWithParam<TaskKind> {};

/// Where the tip is in place, the rows say how the error changes.
TEST_P(TipTaskOfKind, RowsAreTheDerivativesOfTheError) {
  constexpr double kStep = 1e-5;
  Generator generator(4);
  int columns = 0;
  for (int k = 0; k < 90; ++k) {
    const SerialChain chain(random_arm(generator, k % 3));
    const JointVector q = random_posture(generator, chain);
    ChainPose pose, before, after;
    chain.forward(q, pose);
    TipTask task(chain, GetParam());
    task.turn_to(chain.tip_rotation(pose));
    TaskJacobian J;
    task.jacobian(pose, J);
    ASSERT_LT(task.distance(pose, pose.tip()), 1e-15);
    for (int j = 0; j < chain.joints(); ++j, ++columns) {
      chain.forward(q - kStep * JointVector::Unit(chain.joints(), j), before);
      chain.forward(q + kStep * JointVector::Unit(chain.joints(), j), after);
      const TaskVector slope =
          (task.error(before, pose.tip()) - task.error(after, pose.tip())) / (2 * kStep);
      ASSERT_EQ(slope.size(), J.rows());
      EXPECT_LT((slope - J.col(j)).norm(), 1e-8) << "case " << k << ", joint " << j;
    }
  }
  EXPECT_GT(columns, 500);
}

/// Turning the tip by the whole error, wherever it is, does what the task wants.
TEST_P(TipTaskOfKind, TheErrorIsTheTurnToWhereTheTipBelongs) {
  Generator generator(5);
  for (int k = 0; k < 300; ++k) {
    const SerialChain chain(random_arm(generator, k % 3));
    const JointVector q = random_posture(generator, chain);
    ChainPose pose;
    chain.forward(q, pose);
    const Matrix3d R = textbook_rotation(chain.description(), q);
    const Matrix3d R_desired = random_rotation<3>(generator);
    TipTask task(chain, GetParam());
    task.turn_to(R_desired);
    const TaskVector error = task.error(pose, pose.tip());
    EXPECT_EQ(error.head<3>(), Vector3d::Zero());
    if (GetParam() == TaskKind::kPose) {
      const Vector3d turn = error.tail<3>() / kOrientationLength;
      EXPECT_LT((exponential(turn) * R - R_desired).norm(), 1e-9) << "case " << k;
      EXPECT_LE(turn.norm(), kPi + 1e-12);
    } else {
      const Eigen::Vector2d turn = error.tail<2>() / kOrientationLength;
      const Vector3d turn_W = R.leftCols<2>() * turn;
      EXPECT_LT((exponential(turn_W) * R.col(2) - R_desired.col(2)).norm(), 1e-9) << "case " << k;
      EXPECT_NEAR(turn.norm(), std::acos(R.col(2).dot(R_desired.col(2))), 1e-7) << "case " << k;
    }
  }
}

TEST_P(TipTaskOfKind, DoesNotAllocate) {
  Generator generator(6);
  const SerialChain chain(random_arm(generator, 1));
  const JointVector q = random_posture(generator, chain);
  ChainPose pose;
  TaskJacobian J;
  TipTask task(chain, GetParam());
  double sum = 0;
  const test_support::AllocationGuard guard;
  for (int k = 0; k < 10; ++k) {
    chain.forward(q, pose);
    task.jacobian(pose, J);
    sum += J.sum() + task.error(pose, {1, 2, 3}).sum() + task.distance(pose, {1, 2, 3});
  }
  EXPECT_EQ(guard.allocations(), 0U);
  EXPECT_TRUE(std::isfinite(sum));
}

INSTANTIATE_TEST_SUITE_P(OfBothKinds, TipTaskOfKind,
                         ::testing::Values(TaskKind::kAxis, TaskKind::kPose),
                         [](const ::testing::TestParamInfo<TaskKind>& tested) {
                           return tested.param == TaskKind::kAxis ? "axis" : "pose";
                         });

ChainDescription one_link() {
  ChainDescription arm;
  arm.rows.push_back({.a = 1});
  return arm;
}

TEST(TipTask, OppositeAxesAreHalfATurnAboutTheTipsX) {
  const SerialChain chain(one_link());
  ChainPose pose;
  chain.forward(JointVector::Constant(1, 0.3), pose);
  TipTask task(chain, TaskKind::kAxis);
  task.turn_to(Eigen::Vector3d(1, -1, -1).asDiagonal());
  const TaskVector error = task.error(pose, pose.tip());
  EXPECT_EQ(error(3), kOrientationLength * kPi);
  EXPECT_EQ(error(4), 0);
}

/// A last joint along the tip's axis spins it, and an axis task does not mind, wherever the axis points.
TEST(TipTask, TheSpinIsFreeInAnAxisTaskOnly) {
  Generator generator(7);
  ChainDescription arm = random_arm(generator, 1);
  arm.R_LT.setIdentity();
  arm.p_LT << 0, 0, 0.2;
  const SerialChain chain(arm);
  ChainPose pose;
  chain.forward(random_posture(generator, chain), pose);
  TaskJacobian J;
  TipTask(chain, TaskKind::kAxis).jacobian(pose, J);
  EXPECT_EQ(J.rows(), 5);
  EXPECT_LT(J.rightCols<1>().norm(), 1e-15);
  TipTask(chain, TaskKind::kPose).jacobian(pose, J);
  EXPECT_EQ(J.rows(), 6);
  EXPECT_NEAR(J.rightCols<1>().norm(), kOrientationLength, 1e-15);
}

TEST(TipTask, WithoutOrientationIsTheWayToThePoint) {
  Generator generator(8);
  const SerialChain chain(random_arm(generator, 0));
  ChainPose pose;
  chain.forward(random_posture(generator, chain), pose);
  TipTask task(chain);
  TaskJacobian J, J_tip;
  task.jacobian(pose, J);
  chain.jacobian(pose, chain.points() - 1, J_tip);
  EXPECT_EQ(J, J_tip);
  const Vector3d p(0.1, 0.2, 0.3);
  EXPECT_EQ(task.error(pose, p), p - pose.tip());
  EXPECT_EQ(task.distance(pose, p), (p - pose.tip()).norm());
}

TEST(TipTask, TheToleranceIsWithinBoth) {
  Problem problem{.name = "one", .chain = SerialChain(one_link())};
  problem.tolerance = 1e-3;
  problem.orientation_tolerance = 1e-4;
  EXPECT_EQ(TipTask::tolerance(problem), 1e-3);
  problem.task_kind = TaskKind::kPose;
  EXPECT_EQ(TipTask::tolerance(problem), kOrientationLength * 1e-4);
  problem.orientation_tolerance = 1;
  EXPECT_EQ(TipTask::tolerance(problem), 1e-3);
}

}  // namespace
}  // namespace bqsa
