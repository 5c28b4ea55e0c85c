// Witnesses against the formula they are drawn by and, for what refuses them, on both sides of the
// threshold.
#include "harness/generator/witness_motion.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <numbers>

#include "harness/generator/arm.hpp"
#include "harness/generator/scenario_draft.hpp"
#include "harness/judge/judge.hpp"
#include "harness/judge/judge_kinematics.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;

/// A planar or spatial arm that begins in the middle of its region and whose tip goes `way` metres
/// along x, back and forth, in a second.
Problem problem_of(const Arm& arm, double way, int ticks = 200) {
  Problem problem{.name = "drawn", .chain = SerialChain(arm.chain), .ticks = ticks};
  problem.dt = 1.0 / ticks;
  problem.start = rounded(JointVector(0.3 * arm.start_low + 0.7 * arm.start_high));
  ChainPose pose;
  problem.chain.forward(problem.start, pose);
  problem.desired_tip = [p = pose.tip(), way](double t) -> Vector3d {
    return p - Vector3d(way * std::sin(std::numbers::pi * t), 0, 0);
  };
  return problem;
}

std::vector<Arm> arms() {
  std::vector<Arm> arms = spatial_arms(BQSA_SOURCE_DIR "/robots");
  for (const int links : {5, 9}) arms.push_back(planar_arm(links));
  return arms;
}

Vector3d tip_of(const JudgeKinematics& kinematics, const JointVector& q) {
  PointPositions positions;
  kinematics.place(q, positions);
  return positions.tip();
}

/// By central differences.
Eigen::MatrixXd jacobian_of(const Problem& problem, const JointVector& q) {
  constexpr double kStep = 1e-5;
  const JudgeKinematics kinematics(problem.chain.description());
  Eigen::MatrixXd J(problem.dimension(), q.size());
  for (Eigen::Index j = 0; j < q.size(); ++j) {
    JointVector ahead = q, behind = q;
    ahead(j) += kStep;
    behind(j) -= kStep;
    J.col(j) = (tip_of(kinematics, ahead) - tip_of(kinematics, behind)).head(problem.dimension()) /
               (2 * kStep);
  }
  return J;
}

TEST(Witness, FollowsThePathFromTheStartWithoutJerks) {
  int drawn = 0;
  for (const Arm& arm : arms()) {
    const Problem problem = problem_of(arm, 0.1);
    const JudgeKinematics kinematics(problem.chain.description());
    RandomStream random{1};
    for (int i = 0; i < 20; ++i) {
      const std::optional<ArmMotion> witness = draw_witness(problem, random);
      ASSERT_TRUE(witness) << i;
      const Trajectory trajectory = witness->trajectory();
      ASSERT_EQ(trajectory.q.size(), 201U);
      EXPECT_EQ(trajectory.q.front(), problem.start);
      for (std::size_t k = 1; k <= 200; ++k) {
        const JointVector& q = trajectory.q[k];
        EXPECT_EQ(q, rounded(q));
        EXPECT_DOUBLE_EQ(trajectory.t[k], problem.time(static_cast<int>(k)));
        EXPECT_LT((tip_of(kinematics, q) - problem.desired_tip(trajectory.t[k])).norm(), 1e-5);
        if (k < 2) continue;
        const JointVector change = q - 2 * trajectory.q[k - 1] + trajectory.q[k - 2];
        EXPECT_LT(change.cwiseAbs().maxCoeff(), 5e-3) << i << ", tick " << k;
      }
      ++drawn;
    }
  }
  EXPECT_EQ(drawn, 80);
}

TEST(Witness, IsDrawnByItsFormula) {
  constexpr double kPi = std::numbers::pi;
  constexpr double kDuration = 1;  // [s]
  int compared = 0;
  for (Arm arm : arms()) {
    const Problem problem = problem_of(arm, 0, 400);
    const Eigen::Index n = problem.start.size();
    RandomStream random{2}, same{2};
    const double amplitude = same.uniform(0.3, 1.5);
    Eigen::VectorXd a(n), b(n);
    for (double& part : a) part = same.uniform(-1, 1);
    for (double& part : b) part = same.uniform(-1, 1);
    const std::optional<ArmMotion> witness = draw_witness(problem, random);
    ASSERT_TRUE(witness);
    const std::vector<JointVector> q = witness->trajectory().q;
    double fastest = 0;
    for (int tick = 1; tick <= problem.ticks; ++tick) {
      const JointVector& last = q[static_cast<std::size_t>(tick) - 1];
      const double s = (tick - 0.5) / problem.ticks;
      const Eigen::VectorXd phi =
          amplitude / kDuration * (kPi / 2 * std::sin(kPi * s) * a + std::sin(2 * kPi * s) * b);
      const Eigen::MatrixXd J = jacobian_of(problem, last);
      const Eigen::MatrixXd pseudo_inverse =
          J.bdcSvd(Eigen::ComputeThinU | Eigen::ComputeThinV)
              .solve(Eigen::MatrixXd::Identity(J.rows(), J.rows()));
      const Eigen::MatrixXd projector = Eigen::MatrixXd::Identity(n, n) - pseudo_inverse * J;
      const Eigen::VectorXd q_dot = (q[static_cast<std::size_t>(tick)] - last) / problem.dt;
      EXPECT_LT((projector * (q_dot - phi)).norm(), 2e-3) << tick;
      fastest = std::max(fastest, q_dot.norm());
      ++compared;
    }
    EXPECT_GT(fastest, 0.1);
  }
  EXPECT_EQ(compared, 1600);
}

TEST(Witness, KeepsLimitsStepsAndToleranceOrIsNone) {
  for (const Arm& arm : arms()) {
    Problem problem = problem_of(arm, 0.1);
    const Eigen::Index n = problem.start.size();
    const auto given = [&problem] {
      RandomStream random{3};
      return draw_witness(problem, random).has_value();
    };
    EXPECT_TRUE(given());
    problem.limits.max_velocity = JointVector::Constant(n, 0.01);
    EXPECT_FALSE(given());
    problem.limits = {};
    problem.limits.upper = problem.start.array() + 0.01;
    EXPECT_FALSE(given());
    problem.limits = {};
    problem.limits.lower = problem.start.array() - 0.01;
    EXPECT_FALSE(given());
    problem.limits = {};
    EXPECT_TRUE(given());
    problem.tolerance = 1e-9;  // less than the rounding of joint angles
    EXPECT_FALSE(given());
  }
}

TEST(Witness, IsDrawnAgainWhereOneGoesBeyondALimit) {
  // At this speed some of the motions are refused and some are not.
  const Problem free = problem_of(planar_arm(7), 0.1);
  Problem limited = free;
  limited.limits.max_velocity = JointVector::Constant(7, 1.2);
  int equal = 0, others = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    RandomStream first{seed}, second{seed};
    const std::optional<ArmMotion> any = draw_witness(free, first);
    const std::optional<ArmMotion> slow = draw_witness(limited, second);
    ASSERT_TRUE(any && slow) << seed;
    const std::vector<JointVector> q = slow->trajectory().q;
    for (std::size_t k = 1; k < q.size(); ++k) {
      ASSERT_LE((q[k] - q[k - 1]).cwiseAbs().maxCoeff(), 1.2 * limited.dt) << seed;
    }
    ++(any->trajectory().q == q ? equal : others);
  }
  EXPECT_GT(equal, 5);
  EXPECT_GT(others, 5);
}

/// One link of 2 m that turns by `step` a tick, 4 ticks; its tip may be anywhere.
ArmMotion turning_link(double step) {
  Problem problem{.name = "turning", .chain = SerialChain(planar_chain({2})), .ticks = 4};
  problem.dt = 0.025;
  problem.tolerance = 10;
  problem.start = JointVector::Zero(1);
  problem.desired_tip = [](double) -> Vector3d { return {2, 0, 0}; };
  std::vector<JointVector> q;
  for (int tick = 0; tick <= 4; ++tick) q.push_back(JointVector::Constant(1, step * tick));
  return {problem, q};
}

Obstacle disc(double x, double y, double radius) {
  return {"disc", embedded(rotated_ellipse({x, y}, {radius, radius}, 0))};
}

TEST(Witness, KeepsClearAtEveryTick) {
  constexpr double kStep = 0.0005;  // to either side of the threshold [m]
  const ArmMotion still = turning_link(0);
  EXPECT_TRUE(keeps_clear(still, disc(1, 0.1 + kWitnessClearance + kStep, 0.1)));
  EXPECT_FALSE(keeps_clear(still, disc(1, 0.1 + kWitnessClearance - kStep, 0.1)));
  for (int met = 0; met <= 4; ++met) {
    for (const double step : {-kStep, kStep}) {
      Obstacle visiting = disc(1, 2, 0.1);
      for (int tick = 0; tick <= 4; ++tick) {
        const double y = tick == met ? 0.1 + kWitnessClearance + step : 2;
        visiting.motion.push_back(embedded(rotated_ellipse({1, y}, {0.1, 0.1}, 0)));
      }
      EXPECT_EQ(keeps_clear(still, visiting), step > 0) << met;
    }
  }
}

bool solves(const ArmMotion& witness, const Problem& problem) {
  return Judge(problem).judge(witness.trajectory()).success();
}

TEST(Witness, IsJudgedBetweenTicksToo) {
  constexpr double kStep = 0.2;  // [rad]
  const ArmMotion turning = turning_link(kStep);
  const double between = 1.5 * kStep;
  Problem problem = turning.problem();
  problem.obstacles = {disc(1.8 * std::cos(between), 1.8 * std::sin(between), 0.03)};
  EXPECT_TRUE(keeps_clear(turning, problem.obstacles.front()));
  EXPECT_FALSE(solves(turning, problem));
  problem.obstacles = {disc(1.8 * std::cos(between), -1.8 * std::sin(between), 0.03)};
  EXPECT_TRUE(solves(turning, problem));
  problem.tolerance = 0.1;
  EXPECT_FALSE(solves(turning, problem));
}

}  // namespace
}  // namespace bqsa::harness
