#include "baselines/qp/active_set.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <utility>

#include "random_programs.hpp"

namespace bqsa::baselines {
namespace {

using test_support::feasible_program;
using test_support::Generator;
using test_support::infeasible_program;
using test_support::infinity;

/// How far a solution is from the conditions of Karush, Kuhn and Tucker. Lengths are measured by G, as
/// |x|_G and |row|_{G^-1}; all relative to the largest |x|_G, |bound| or |gradient| involved.
struct KktErrors {
  double stationarity = 0, primal = 0, complementarity = 0;
  bool wrong_sign = false;
  int active = 0, equalities = 0;
};

using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

KktErrors kkt_errors(const QuadraticProgram& program, const QpSolution& solution) {
  KktErrors errors;
  const Matrix G = program.G.cast<long double>(), inverse = G.inverse();
  const Matrix E = program.E.cast<long double>();
  const Vector x = solution.x.cast<long double>(), c = program.c.cast<long double>();
  const auto dual_length = [&](const Vector& v) { return std::sqrt(v.dot(inverse * v)); };
  const long double size = std::sqrt(x.dot(G * x)) + dual_length(c);
  long double gradients = size;
  const auto relative = [](long double error, long double to) {
    return error > 0 ? static_cast<double>(error / to) : 0;
  };
  for (int i = 0; i < program.rows(); ++i) {
    const long double length = dual_length(E.row(i).transpose()), value = E.row(i).dot(x);
    const double lower = program.lower(i), upper = program.upper(i), u = solution.u(i);
    gradients += std::abs(u) * length;
    for (const auto& [bound, violation] :
         {std::pair{lower, lower - value}, std::pair{upper, value - upper}}) {
      errors.primal = std::max(errors.primal, relative(violation, length * size + std::abs(bound)));
    }
    errors.equalities += lower == upper;
    if (lower == upper || u == 0) continue;
    ++errors.active;
    const double at = u > 0 ? lower : upper;
    errors.wrong_sign = errors.wrong_sign || !std::isfinite(at);
    errors.complementarity = std::max(errors.complementarity,
                                      relative(std::abs(value - at), length * size + std::abs(at)));
  }
  const Vector left = G * x + c - E.transpose() * solution.u.cast<long double>();
  errors.stationarity = relative(dual_length(left), gradients);
  return errors;
}

/// What the factorization may change G by, seen from where G is the identity, and sums over rows:
/// (n + m) eps cond G.
double rounding_of_gradients(const QuadraticProgram& program) {
  const Eigen::VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(program.G, Eigen::EigenvaluesOnly)
          .eigenvalues();
  return (program.variables() + program.rows()) * std::numeric_limits<double>::epsilon() *
         eigenvalues.maxCoeff() / eigenvalues.minCoeff();
}

TEST(ActiveSet, KeepsTheConditionsOfKarushKuhnAndTucker) {
  Generator generator(1);
  ActiveSet solver;
  QpSolution solution;
  int with_active = 0, with_equalities = 0, doubtful = 0, at_vertex = 0;
  for (int trial = 0; trial < 100000; ++trial) {
    QpVector x0;
    const QuadraticProgram program =
        feasible_program(generator,
                         {.largest_variables = trial % 200 == 0 ? kMaxQpVariables : 10,
                          .well_scaled = trial % 2 == 0},
                         x0);
    solver.solve(program, solution);
    ASSERT_EQ(solution.status, QpStatus::kSolved) << trial;
    const KktErrors errors = kkt_errors(program, solution);
    EXPECT_LT(errors.stationarity, 10 * rounding_of_gradients(program)) << trial;
    EXPECT_LT(errors.complementarity, 1e-9) << trial;
    EXPECT_FALSE(errors.wrong_sign) << trial;
    EXPECT_LT(errors.primal, 1e-5) << trial;  // rows almost dependent, in chains
    doubtful += errors.primal > 1e-9;
    with_active += errors.active > 0;
    with_equalities += errors.equalities > 0;
    at_vertex += errors.active + errors.equalities >= program.variables();
  }
  EXPECT_LT(doubtful, 100);
  EXPECT_GT(with_active, 60000);
  EXPECT_GT(with_equalities, 80000);
  EXPECT_GT(at_vertex, 60000);
}

TEST(ActiveSet, FindsNoSolutionWhereThereIsNone) {
  Generator generator(2);
  ActiveSet solver;
  QpSolution solution;
  for (int trial = 0; trial < 50000; ++trial) {
    const QuadraticProgram program = infeasible_program(
        generator, {.largest_variables = 10, .well_scaled = trial % 2 == 0, .least_angle = 1e-3});
    solver.solve(program, solution);
    ASSERT_EQ(solution.status, QpStatus::kInfeasible) << trial;
  }
}

}  // namespace
}  // namespace bqsa::baselines
