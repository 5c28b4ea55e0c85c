#include "baselines/qp/dual_network.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

#include "baselines/qp/active_set.hpp"
#include "random_programs.hpp"

namespace bqsa::baselines {
namespace {

using test_support::feasible_program;
using test_support::Generator;
using test_support::infeasible_program;

/// The network of a program written out anew, in the scaled units of its neurons.
struct Neurons {
  Eigen::MatrixXd M;
  Eigen::VectorXd scale, shift, lower, upper;

  explicit Neurons(const QuadraticProgram& program) {
    const Eigen::MatrixXd E = program.E, inverse = Eigen::MatrixXd(program.G).inverse();
    M = E * inverse * E.transpose();
    scale = M.cwiseAbs().rowwise().sum().cwiseSqrt().cwiseInverse();
    for (double& s : scale) s = std::isfinite(s) ? s : 1;
    M = scale.asDiagonal() * M * scale.asDiagonal();
    shift = scale.asDiagonal() * (E * inverse * program.c);
    lower = scale.cwiseProduct(program.lower);
    upper = scale.cwiseProduct(program.upper);
  }

  Eigen::VectorXd state(const QpSolution& solution) const {
    return solution.u.cwiseQuotient(scale);
  }
  Eigen::VectorXd residual(const Eigen::VectorXd& u) const {
    const Eigen::VectorXd F = M * u - shift;
    return (F - u).cwiseMax(lower).cwiseMin(upper) - F;
  }
};

/// With r the residual at u, z = E x + r is within its bounds and -(u + r) normal to them at z; so is
/// -u* at z* = E x*. The normal cones being monotone, (z - z*)ᵀ(u* - u - r) >= 0, and with Gx + c = Eᵀu,
/// e = |x - x*|_G, |E (x - x*)| <= e because the eigenvalues of M are at most 1:
/// e² <= |r| |u - u*| + e |r|.
double largest_error(double r, double du) { return 0.5 * r + std::sqrt(0.25 * r * r + r * du); }

TEST(DualNetwork, AgreesWithTheActiveSet) {
  Generator generator(1);
  ActiveSet active_set;
  DualNetwork network({.tolerance = 1e-10, .max_iterations = 20000});
  QpSolution expected, found;
  int solved = 0, constrained = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    QpVector x0;
    const QuadraticProgram program = feasible_program(
        generator, {.largest_variables = 8, .well_scaled = true, .least_angle = 1e-2}, x0);
    if (program.rows() == 0) continue;
    active_set.solve(program, expected);
    ASSERT_EQ(expected.status, QpStatus::kSolved) << trial;
    found.u.resize(0);
    network.solve(program, found);
    ASSERT_NE(found.status, QpStatus::kInfeasible) << trial;
    const Neurons neurons(program);
    const double r = neurons.residual(neurons.state(found)).norm();
    const double du = (neurons.state(found) - neurons.state(expected)).norm();
    EXPECT_LE((found.x - expected.x).norm(),
              1.001 * largest_error(r, du) + 1e-9 * (1 + expected.x.norm()))
        << trial;
    solved += found.status == QpStatus::kSolved;
    constrained += (expected.u.array() != 0).any();
    if (found.status == QpStatus::kSolved) {
      const Eigen::VectorXd missing =
          neurons.residual(neurons.state(found)).cwiseQuotient(neurons.scale);
      EXPECT_LE(missing.cwiseAbs().maxCoeff(), 1.1e-10) << trial;
      EXPECT_LT((found.x - expected.x).norm(), 1e-4) << trial;
    }
  }
  EXPECT_GT(solved, 2000);  // the others are degenerate, and need more than 20,000 steps
  EXPECT_GT(constrained, 2500);
}

/// Neither the residual nor the distance from any solution grows, from one step to the next; that is
/// what the bound on the step promises.
TEST(DualNetwork, ComesCloserWithEveryStep) {
  Generator generator(2);
  ActiveSet active_set;
  DualNetwork network({.tolerance = 1e-12, .max_iterations = 1});
  QpSolution expected, found;
  int steps = 0;
  for (int trial = 0; trial < 500; ++trial) {
    QpVector x0;
    const QuadraticProgram program =
        feasible_program(generator, {.largest_variables = 8, .well_scaled = trial % 2 == 0}, x0);
    if (program.rows() == 0) continue;
    active_set.solve(program, expected);
    const Neurons neurons(program);
    EXPECT_LE(neurons.M.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff(), 1 + 1e-9);
    found.u = test_support::random_qp_vector(generator, program.rows());
    Eigen::VectorXd before = neurons.state(found);
    for (int step = 0; step < 200; ++step, ++steps) {
      network.solve(program, found);
      if (found.iterations == 0) break;
      const Eigen::VectorXd after = neurons.state(found);
      const double slack = 1e-9 * (1 + before.norm() + neurons.state(expected).norm());
      EXPECT_LE(neurons.residual(after).norm(), neurons.residual(before).norm() + slack) << trial;
      EXPECT_LE((after - neurons.state(expected)).norm(),
                (before - neurons.state(expected)).norm() + slack)
          << trial << " " << step;
      before = after;
    }
  }
  EXPECT_GT(steps, 50000);
}

TEST(DualNetwork, StartsWhereItIsTold) {
  Generator generator(3);
  DualNetwork network({.tolerance = 1e-8, .max_iterations = 20000});
  QpSolution solution;
  int cold = 0, again = 0;
  for (int trial = 0; trial < 200; ++trial) {
    QpVector x0;
    const QuadraticProgram program = feasible_program(
        generator, {.largest_variables = 8, .well_scaled = true, .least_angle = 1e-2}, x0);
    solution.u.resize(0);
    network.solve(program, solution);
    if (solution.status != QpStatus::kSolved) continue;
    cold += solution.iterations;
    network.solve(program, solution);
    again += solution.iterations;
  }
  EXPECT_GT(cold, 10000);
  EXPECT_LE(again, 200);
}

TEST(DualNetwork, FindsNoSolutionWhereThereIsNone) {
  Generator generator(4);
  DualNetwork network({.tolerance = 1e-8, .max_iterations = 20000});
  QpSolution solution;
  int found = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const QuadraticProgram program = infeasible_program(
        generator, {.largest_variables = 8, .well_scaled = true, .least_angle = 1e-2});
    solution.u.resize(0);
    network.solve(program, solution);
    EXPECT_NE(solution.status, QpStatus::kSolved) << trial;
    found += solution.status == QpStatus::kInfeasible;
  }
  EXPECT_GT(found, 800);
}

}  // namespace
}  // namespace bqsa::baselines
