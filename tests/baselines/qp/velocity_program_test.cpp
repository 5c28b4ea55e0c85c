#include "baselines/qp/velocity_program.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "baselines/qp/active_set.hpp"
#include "bqsa/method.hpp"
#include "support/paper_problems.hpp"
#include "support/sampling.hpp"

namespace bqsa::baselines {
namespace {

using test_support::Generator;
using test_support::planar_7r;
using test_support::uniform;

JointVector random_joints(Generator& generator, double size) {
  return JointVector::NullaryExpr(7, [&](Eigen::Index) { return uniform(generator, -size, size); });
}

TaskJacobian tip_jacobian(const Problem& problem, const JointVector& q) {
  ChainPose pose;
  TaskJacobian J;
  problem.chain.forward(q, pose);
  problem.chain.jacobian(pose, problem.chain.points() - 1, J);
  return J;
}

std::vector<Escape> random_escapes(Generator& generator, int count) {
  std::vector<Escape> escapes;
  for (int k = 0; k < count; ++k) {
    escapes.push_back({.link = k % 7,
                       .obstacle = k / 7,
                       .clearance = uniform(generator, -0.01, 0.05),
                       .approach = uniform(generator, -0.1, 0.1),
                       .j0 = random_joints(generator, 1)});
  }
  return escapes;
}

TEST(VelocityProgram, HasTheRowsThatAreWrittenDown) {
  Generator generator(1);
  Problem problem = planar_7r();
  problem.limits = {.lower = JointVector::Constant(7, -1),
                    .upper = JointVector::Constant(7, 1.2),
                    .max_velocity = JointVector::Constant(7, 3)};
  const JointVector q = random_joints(generator, 1), tracking = random_joints(generator, 0.2);
  const TaskJacobian J = tip_jacobian(problem, q);
  const std::vector<Escape> escapes = random_escapes(generator, 3);
  VelocityProgram rows({.safe_distance = 0.01, .gain = 7, .max_velocity = 0.5, .drift_gain = 0.3});
  ASSERT_TRUE(rows.assign(problem, q, tracking, J, escapes));
  const QuadraticProgram& program = rows.program();
  ASSERT_EQ(program.rows(), 2 + 7 + 3);
  EXPECT_TRUE(program.G.isIdentity(0));
  EXPECT_LT((program.c - 0.3 * (q - problem.start)).norm(), 1e-15);
  EXPECT_EQ(program.E.topRows(2), J);
  EXPECT_LT((program.lower.head(2) - J * tracking).norm(), 1e-15);
  EXPECT_EQ(program.lower.head(2), program.upper.head(2));
  EXPECT_TRUE(program.E.middleRows(2, 7).isIdentity(0));
  for (int j = 0; j < 7; ++j) {
    EXPECT_NEAR(program.lower(2 + j), std::max(-0.5, (-1 - q(j)) / problem.dt), 1e-12);
    EXPECT_NEAR(program.upper(2 + j), std::min(0.5, (1.2 - q(j)) / problem.dt), 1e-12);
  }
  for (int k = 0; k < 3; ++k) {
    const Escape& escape = escapes[static_cast<std::size_t>(k)];
    EXPECT_EQ(program.E.row(9 + k), escape.j0.transpose());
    EXPECT_NEAR(program.lower(9 + k), -7 * (escape.clearance - 0.01) + escape.approach, 1e-15);
    EXPECT_EQ(program.upper(9 + k), std::numeric_limits<double>::infinity());
  }

  VelocityProgram hard({.approach = ApproachLimit::kNone});
  ASSERT_TRUE(hard.assign(problem, q, tracking, J, escapes));
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(hard.program().lower(9 + k), escapes[static_cast<std::size_t>(k)].approach);
  }
}

TEST(VelocityProgram, AsEqualitiesOnlyWhatIsTooCloseEscapes) {
  Generator generator(2);
  const Problem problem = planar_7r();
  std::vector<Escape> escapes = random_escapes(generator, 2);
  escapes[0].clearance = 0.0101;
  escapes[1].clearance = 0.0099;
  VelocityProgram rows({.safe_distance = 0.01, .gain = 7, .equalities = true});
  ASSERT_TRUE(rows.assign(problem, problem.start, random_joints(generator, 0.2),
                          tip_jacobian(problem, problem.start), escapes));
  ASSERT_EQ(rows.escape_count(), 1);
  EXPECT_EQ(rows.escape(0).link, escapes[1].link);
  EXPECT_NEAR(rows.program().lower(9), 7 * 0.0001 + escapes[1].approach, 1e-15);
  EXPECT_EQ(rows.program().lower(9), rows.program().upper(9));
}

TEST(VelocityProgram, KeepsTheNearestWhereRowsAreTooMany) {
  Generator generator(3);
  const Problem problem = planar_7r();
  const std::vector<Escape> escapes = random_escapes(generator, 3 * kMaxEscapeRows);
  VelocityProgram rows({});
  ASSERT_TRUE(rows.assign(problem, problem.start, random_joints(generator, 0.2),
                          tip_jacobian(problem, problem.start), escapes));
  ASSERT_EQ(rows.escape_count(), kMaxEscapeRows);
  std::vector<double> all, kept;
  for (const Escape& escape : escapes) all.push_back(escape.clearance);
  for (int k = 0; k < kMaxEscapeRows; ++k) kept.push_back(rows.escape(k).clearance);
  std::ranges::sort(all);
  std::ranges::sort(kept);
  all.resize(kMaxEscapeRows);
  EXPECT_EQ(kept, all);
}

TEST(VelocityProgram, NeverRefusesATrackingVelocityThatTheProblemPermits) {
  Generator generator(4);
  Problem problem = planar_7r();
  ActiveSet solver;
  QpSolution solution;
  int permitted = 0, forbidden = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    problem.limits = {.lower = JointVector::Constant(7, -1),
                      .upper = JointVector::Constant(7, 1),
                      .max_velocity = JointVector::Constant(7, 2)};
    const JointVector q = random_joints(generator, 1), tracking = random_joints(generator, 2.1);
    VelocityProgram rows({.max_velocity = 0.01});
    ASSERT_TRUE(rows.assign(problem, q, tracking, tip_jacobian(problem, q), {}));
    solver.solve(rows.program(), solution);
    const bool allowed = forbidden_step(problem, q, q + problem.dt * tracking) == Infeasible::kNot;
    EXPECT_TRUE(!allowed || solution.status == QpStatus::kSolved) << trial;
    permitted += allowed;
    forbidden += solution.status == QpStatus::kInfeasible;
    if (solution.status != QpStatus::kSolved) continue;
    EXPECT_EQ(forbidden_step(problem, q, q + problem.dt * (1 - 1e-9) * solution.x),
              Infeasible::kNot)
        << trial;
  }
  EXPECT_GT(permitted, 1000);
  EXPECT_GT(forbidden, 100);
}

/// Minimising w/2 s² + 1/2 |x|² over escape rows alone is least squares, for which there is a formula.
TEST(VelocityProgram, SlacksMakeContradictionsLeastSquares) {
  Generator generator(5);
  const Problem problem = planar_7r();
  ActiveSet solver;
  QpSolution solution;
  for (int trial = 0; trial < 500; ++trial) {
    std::vector<Escape> escapes = random_escapes(generator, 2);
    escapes[1].j0 = -escapes[0].j0;  // away from both, which cannot be
    escapes[0].clearance = escapes[1].clearance = 0;
    escapes[0].approach = uniform(generator, 0, 0.1);
    escapes[1].approach = uniform(generator, 0, 0.1);
    const double weight = 1e4;
    VelocityProgram rows({.slack_weight = weight});
    ASSERT_TRUE(rows.assign(problem, problem.start, JointVector::Zero(7), TaskJacobian::Zero(2, 7),
                            escapes));
    QuadraticProgram program = rows.program();
    solver.solve(program, solution);
    ASSERT_EQ(solution.status, QpStatus::kInfeasible);
    rows.soften(program);
    solver.solve(program, solution);
    ASSERT_EQ(solution.status, QpStatus::kSolved);
    Eigen::MatrixXd A(2, 7);
    A << escapes[0].j0.transpose(), escapes[1].j0.transpose();
    const Eigen::VectorXd b = rows.program().lower.tail(2);
    const Eigen::VectorXd expected = (Eigen::MatrixXd::Identity(7, 7) + weight * A.transpose() * A)
                                         .ldlt()
                                         .solve(weight * A.transpose() * b);
    EXPECT_LT((solution.x.head(7) - expected).norm(), 1e-9) << trial;
  }
}

}  // namespace
}  // namespace bqsa::baselines
