#include "baselines/qp/compact_program.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "baselines/qp/active_set.hpp"
#include "random_programs.hpp"

namespace bqsa::baselines {
namespace {

using test_support::Generator;
using test_support::normal;

TEST(KernelBasis, SpansTheKernelSingularMatricesIncluded) {
  Generator generator(1);
  KernelBasis basis;
  int singular = 0, square = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const int rows = 1 + trial % kMaxTaskRows;
    const int columns = 1 + trial % 13;
    TaskJacobian J = TaskJacobian::NullaryExpr(
        rows, columns, [&](Eigen::Index, Eigen::Index) { return normal(generator); });
    if (trial % 4 == 0 && rows > 1) J.row(rows - 1) = 3 * J.row(0);
    if (trial % 9 == 0) J.col(columns / 2).setZero();
    if (trial % 50 == 0) J.setZero();
    basis.assign(J);
    Eigen::JacobiSVD<Eigen::MatrixXd> svd(J);
    svd.setThreshold(1e-9);
    const Eigen::MatrixXd Z = basis.matrix();
    ASSERT_EQ(Z.rows(), columns);
    ASSERT_EQ(Z.cols(), columns - svd.rank()) << trial;
    square += Z.cols() == 0;
    singular += svd.rank() < std::min(rows, columns);
    if (Z.cols() == 0) continue;
    EXPECT_LT((J * Z).norm(), 1e-12 * (1 + Z.norm())) << trial;
    EXPECT_GE(Eigen::JacobiSVD<Eigen::MatrixXd>(Z).singularValues().minCoeff(), 1 - 1e-12) << trial;
  }
  EXPECT_GT(singular, 400);
  EXPECT_GT(square, 500);
}

/// Two routes to the same x: all rows to the solver, or the equalities eliminated first.
TEST(CompactProgram, HasTheSolutionOfTheWhole) {
  Generator generator(2);
  CompactProgram compact;
  ActiveSet solver;
  QpSolution whole, part;
  int eliminated = 0, constrained = 0, almost = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    QpVector x0;
    const QuadraticProgram program = test_support::feasible_program(
        generator, {.largest_variables = 12, .well_scaled = trial % 2 == 0, .least_angle = 1e-2},
        x0);
    int equalities = 0;
    while (equalities < std::min(program.rows(), kMaxTaskRows) &&
           program.lower(equalities) == program.upper(equalities)) {
      ++equalities;
    }
    if (equalities == 0) continue;
    compact.assign(program, equalities, x0);
    ASSERT_EQ(compact.reduced().rows(), program.rows() - equalities);
    if (compact.reduced().variables() == 0) continue;
    ++eliminated;
    solver.solve(program, whole);
    solver.solve(compact.reduced(), part);
    ASSERT_EQ(whole.status, QpStatus::kSolved) << trial;
    ASSERT_EQ(part.status, QpStatus::kSolved) << trial;
    constrained += (part.u.array() != 0).any();
    const QpVector x = compact.expand(part.x);
    const QpVector difference = x - whole.x;
    // |difference|²_G = (u - u')ᵀ E (x - x'): where a solver left a row violated, times its multiplier.
    double left = 0;
    for (int row = equalities; row < program.rows(); ++row) {
      const double value = program.E.row(row).dot(whole.x);
      left += std::abs(part.u(row - equalities)) *
              std::max({program.lower(row) - value, value - program.upper(row), 0.0});
    }
    const double size = 1 + std::sqrt(x.dot(program.G * x)) + program.c.norm();
    EXPECT_LT(std::sqrt(difference.dot(program.G * difference)), 1e-6 * size + std::sqrt(left))
        << trial;
    almost += left > 1e-9;
  }
  EXPECT_GT(eliminated, 10000);
  EXPECT_GT(constrained, 8000);
  EXPECT_LT(almost, 50);
}

}  // namespace
}  // namespace bqsa::baselines
