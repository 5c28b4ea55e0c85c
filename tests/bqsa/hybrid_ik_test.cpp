// The hybrid inverse kinematics against independent computations: the KKT system of the weighted
// least norm, the pseudo-inverse, and Lemma 2 evaluated on the actual residual.

#include "bqsa/hybrid_ik.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <memory>
#include <ostream>
#include <string>

#include "support/allocation_guard.hpp"
#include "support/sampling.hpp"

namespace bqsa {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using test_support::Generator;
using test_support::log_uniform;
using test_support::normal;
using test_support::uniform;

struct Size {
  int rows, joints;
};

void PrintTo(const Size& size, std::ostream* out) { *out << size.rows << "x" << size.joints; }

struct Case {
  TaskJacobian J;
  TaskVector x_dot;
  JointVector weights, phi;
};

VectorXd random_vector(Eigen::Index size, Generator& generator) {
  return VectorXd::NullaryExpr(size, [&](Eigen::Index) { return normal(generator); });
}

/// m x n with the singular values given.
MatrixXd with_singular_values(const VectorXd& s, Eigen::Index n, Generator& generator) {
  const auto orthogonal = [&generator](Eigen::Index size) -> MatrixXd {
    const MatrixXd random = MatrixXd::NullaryExpr(size, size, [&] { return normal(generator); });
    return random.householderQr().householderQ();
  };
  return orthogonal(s.size()) * s.asDiagonal() * orthogonal(n).topRows(s.size());
}

HybridIkResult solve(const Case& c, const HybridIkSettings& settings = {}) {
  HybridIkResult result;
  solve_hybrid_ik(c.J, c.x_dot, c.weights, c.phi, settings, result);
  return result;
}

class HybridIk : public testing::TestWithParam<Size> {
 protected:
  static constexpr int kCases = 300;

  /// Singular values between `low` and 2, weights between 1 and `heaviest`.
  Case random_case(double low, double heaviest) {
    const auto [m, n] = GetParam();
    const VectorXd s =
        VectorXd::NullaryExpr(m, [&](Eigen::Index) { return log_uniform(generator_, low, 2); });
    Case c;
    c.J = with_singular_values(s, n, generator_);
    c.x_dot = 0.3 * random_vector(m, generator_);
    c.weights = JointVector::NullaryExpr(
        n, [&](Eigen::Index) { return log_uniform(generator_, 1, heaviest); });
    c.phi = random_vector(n, generator_);
    return c;
  }

  Generator generator_{static_cast<std::uint64_t>(90 + 20 * GetParam().rows + GetParam().joints)};
};

INSTANTIATE_TEST_SUITE_P(Sizes, HybridIk,
                         testing::Values(Size{2, 3}, Size{2, 7}, Size{2, 16}, Size{3, 4},
                                         Size{3, 6}, Size{3, 7}, Size{3, 16}),
                         [](const auto& parameter) {
                           return std::to_string(parameter.param.rows) + "x" +
                                  std::to_string(parameter.param.joints);
                         });

HybridIkSettings undamped() {
  HybridIkSettings settings;
  settings.singular_threshold = 0;
  return settings;
}

TEST_P(HybridIk, UndampedFollowsTheTipVelocityExactly) {
  for (int i = 0; i < kCases; ++i) {
    const Case c = random_case(0.05, 1e4);
    const HybridIkResult result = solve(c, undamped());
    ASSERT_LT((c.J * result.q_dot - c.x_dot).norm(), 1e-10) << "case " << i;
    ASSERT_LT(result.residual, 1e-10) << "case " << i;
    ASSERT_EQ(result.rank, c.J.rows()) << "case " << i;
    ASSERT_EQ(result.lambda, 0) << "case " << i;
  }
}

TEST_P(HybridIk, MinimisesTheWeightedNormAroundPhi) {
  // min (q - phi)' W (q - phi) subject to J q = x_dot, by its Karush-Kuhn-Tucker system.
  for (int i = 0; i < kCases; ++i) {
    Case c = random_case(0.05, 1e3);
    if (i % 2 == 0) c.phi.setZero();  // the plain weighted least norm
    const Eigen::Index m = c.J.rows(), n = c.J.cols();
    MatrixXd K = MatrixXd::Zero(n + m, n + m);
    K.topLeftCorner(n, n) = MatrixXd(c.weights.asDiagonal());
    K.topRightCorner(n, m) = c.J.transpose();
    K.bottomLeftCorner(m, n) = c.J;
    VectorXd right(n + m);
    right << c.weights.cwiseProduct(c.phi), c.x_dot;
    const VectorXd expected = K.fullPivLu().solve(right).head(n);
    ASSERT_LT((solve(c, undamped()).q_dot - expected).norm(), 1e-8 * (1 + expected.norm()))
        << "case " << i;
  }
}

TEST_P(HybridIk, WithoutWeightsIsThePseudoInverse) {
  for (int i = 0; i < kCases; ++i) {
    Case c = random_case(0.05, 1);
    const MatrixXd J = c.J;
    const MatrixXd gram = J * J.transpose();
    const MatrixXd plus = J.transpose() * gram.fullPivLu().inverse();
    const VectorXd expected =
        plus * c.x_dot + (MatrixXd::Identity(J.cols(), J.cols()) - plus * J) * c.phi;
    ASSERT_LT((solve(c, undamped()).q_dot - expected).norm(), 1e-9) << "case " << i;
  }
}

TEST_P(HybridIk, IsTheWeightedDampedLeastSquaresOfItsLambda) {
  // min |J q - x_dot|² + lambda² q' W q, by its normal equations; without phi.
  int damped = 0;
  for (int i = 0; i < kCases; ++i) {
    Case c = random_case(1e-3, 100);
    c.phi.setZero();
    const HybridIkResult result = solve(c);
    if (result.lambda < 1e-4) continue;
    const MatrixXd J = c.J;
    const MatrixXd W = MatrixXd(c.weights.asDiagonal());
    const MatrixXd normal_matrix = J.transpose() * J + result.lambda * result.lambda * W;
    const VectorXd expected = normal_matrix.fullPivLu().solve(J.transpose() * c.x_dot);
    ASSERT_LT((result.q_dot - expected).norm(), 1e-5 * (1 + expected.norm())) << "case " << i;
    ++damped;
  }
  EXPECT_GT(damped, kCases / 10);
}

TEST_P(HybridIk, LetsAPhiFromTheKernelPassForEveryWeight) {
  // Also while damping: the projector is not damped.
  int damped = 0;
  for (int i = 0; i < kCases; ++i) {
    Case c = random_case(1e-3, 1e6);
    const MatrixXd J = c.J;
    const MatrixXd kernel = J.fullPivLu().kernel();
    c.phi = kernel * random_vector(kernel.cols(), generator_);
    Case still = c;
    still.phi.setZero();
    const HybridIkResult moving = solve(c);
    const VectorXd self_motion = moving.q_dot - solve(still).q_dot;
    ASSERT_LT((self_motion - c.phi).norm(), 1e-8 * (1 + moving.q_dot.norm())) << "case " << i;
    damped += moving.lambda > 0;
  }
  EXPECT_GT(damped, kCases / 10);
}

TEST_P(HybridIk, SelfMotionNeverMovesTheTip) {
  for (int i = 0; i < kCases; ++i) {
    Case c = random_case(1e-3, 1e3);
    c.x_dot.setZero();
    const HybridIkResult result = solve(c);
    ASSERT_LT((c.J * result.q_dot).norm(), 1e-9) << "case " << i;
    ASSERT_GT(result.q_dot.norm(), 1e-6) << "case " << i;
  }
}

TEST_P(HybridIk, AHeavyWeightHoldsAJoint) {
  int held = 0;
  for (int i = 0; i < kCases; ++i) {
    Case c = random_case(0.3, 1);
    c.phi.setZero();
    c.weights(0) = 1e8;
    const Eigen::Index m = c.J.rows();
    const VectorXd s = c.J.rightCols(c.J.cols() - 1).jacobiSvd().singularValues();
    if (s(m - 1) < 0.05) continue;  // the others cannot do without joint 0
    const HybridIkResult result = solve(c, undamped());
    ASSERT_LT(std::abs(result.q_dot(0)), 1e-4) << "case " << i;
    ASSERT_LT((c.J * result.q_dot - c.x_dot).norm(), 1e-9) << "case " << i;
    ++held;
  }
  EXPECT_GT(held, kCases / 3);
}

TEST_P(HybridIk, ReportsSmallestSingularValueAndResidual) {
  for (int i = 0; i < kCases; ++i) {
    const Case c = random_case(1e-4, 100);
    const HybridIkResult result = solve(c);
    const MatrixXd J_w = c.J * c.weights.cwiseSqrt().cwiseInverse().asDiagonal();
    const VectorXd s = J_w.jacobiSvd().singularValues();
    ASSERT_NEAR(result.smallest_singular, s(s.size() - 1), 1e-12) << "case " << i;
    ASSERT_NEAR(result.residual, (c.x_dot - c.J * result.q_dot).norm(), 1e-12) << "case " << i;
  }
}

TEST_P(HybridIk, Lemma2BoundsTheResidualOfEveryFullRankJacobian) {
  const HybridIkSettings settings;
  int accurate = 0, ceiling = 0;
  for (int i = 0; i < 10 * kCases; ++i) {
    const Case c = random_case(1e-4, 10);
    const HybridIkResult result = solve(c);
    if (result.smallest_singular >= settings.singular_threshold) {
      ASSERT_EQ(result.lambda, 0) << "case " << i;
      continue;
    }
    ASSERT_LE(result.residual, settings.residual_bound * (1 + 1e-6)) << "case " << i;
    const double ratio = result.smallest_singular / settings.singular_threshold;
    const bool at_ceiling =
        result.lambda > (1 - 1e-12) * settings.lambda_max * std::sqrt(1 - ratio * ratio);
    ++(at_ceiling ? ceiling : accurate);
  }
  EXPECT_GT(accurate, kCases);
  RecordProperty("accurate", accurate);
  RecordProperty("ceiling", ceiling);
}

TEST_P(HybridIk, Lemma2IsAttainedInTheWorstDirection) {
  const HybridIkSettings settings;
  for (int i = 0; i < kCases; ++i) {
    Case c = random_case(0.2, 1);
    const MatrixXd J = c.J;
    Eigen::JacobiSVD<MatrixXd> svd(J, Eigen::ComputeThinU | Eigen::ComputeThinV);
    VectorXd s = svd.singularValues();
    s(s.size() - 1) = log_uniform(generator_, 1e-3, 1e-2);
    c.J = svd.matrixU() * s.asDiagonal() * svd.matrixV().transpose();
    c.x_dot = uniform(generator_, 0.1, 1) * svd.matrixU().col(s.size() - 1);
    const HybridIkResult result = solve(c);
    ASSERT_NEAR(result.residual, settings.residual_bound, 1e-9) << "case " << i;
  }
}

TEST_P(HybridIk, ReportsLostRankAndTheResidualThatNoDampingAvoids) {
  for (int i = 0; i < kCases; ++i) {
    Case c = random_case(0.2, 10);
    const MatrixXd J = c.J;
    Eigen::JacobiSVD<MatrixXd> svd(J, Eigen::ComputeThinU | Eigen::ComputeThinV);
    VectorXd s = svd.singularValues();
    const Eigen::Index last = s.size() - 1;
    s(last) = 0;
    c.J = svd.matrixU() * s.asDiagonal() * svd.matrixV().transpose();
    const HybridIkResult result = solve(c);
    ASSERT_EQ(result.rank, last) << "case " << i;
    ASSERT_TRUE(result.q_dot.allFinite()) << "case " << i;
    ASSERT_NEAR(result.residual, (c.x_dot - c.J * result.q_dot).norm(), 1e-12) << "case " << i;
    ASSERT_GE(result.residual, std::abs(svd.matrixU().col(last).dot(c.x_dot)) - 1e-9)
        << "case " << i;
  }
}

TEST_P(HybridIk, BranchesMeetContinuously) {
  // The damping sets in at s_0 and reaches its ceiling, and the accurate branch sets in at
  // |x_dot| = eps, without a jump of lambda.
  const HybridIkSettings settings;
  const auto [m, n] = GetParam();
  VectorXd s = VectorXd::Ones(m);
  Case c{TaskJacobian(m, n), TaskVector::Zero(m), JointVector::Ones(n), JointVector::Zero(n)};
  const auto lambda = [&](double s_m, double speed) {
    s(m - 1) = s_m;
    c.J.setZero();
    c.J.leftCols(m) = s.asDiagonal();
    c.x_dot(m - 1) = speed;
    return solve(c).lambda;
  };
  const double s_0 = settings.singular_threshold, eps = settings.residual_bound;
  for (const double speed : {0.5 * eps, 0.1}) {
    EXPECT_EQ(lambda(s_0, speed), 0);
    EXPECT_LT(lambda(s_0 * (1 - 1e-12), speed), 1e-6) << "at s_0";
    EXPECT_GT(lambda(0.5 * s_0, speed), 1e-4);
  }
  for (const double s_m : {1e-3, 1e-2, 0.04}) {
    EXPECT_NEAR(lambda(s_m, eps * (1 + 1e-9)), lambda(s_m, eps), 1e-12) << "at |x_dot| = eps";
    double before = lambda(s_m, eps);
    for (double speed = eps; speed < 0.2; speed *= 1.001) {
      const double now = lambda(s_m, speed);
      ASSERT_LE(now, before + 1e-15) << "s_m " << s_m << " speed " << speed;
      ASSERT_GT(now, 0);
      before = now;
    }
    EXPECT_LT(before, lambda(s_m, eps)) << "the accurate branch never applied";
  }
}

TEST_P(HybridIk, TrackingIsTheFormulaWithoutWeights) {
  // Across the threshold of damping, where the inverse gives way to the decomposition.
  const HybridIkSettings settings;
  int regular = 0, damped = 0, deficient = 0;
  for (int i = 0; i < 3 * kCases; ++i) {
    Case c = random_case(i % 3 == 0 ? 0.05 : 1e-3, 1);
    c.weights.setOnes();
    if (i % 10 == 0) c.J.row(0) = c.J.row(1);
    const HybridIkResult expected = solve(c);
    TrackingIk ik;
    ik.assign(c.J, settings);
    JointVector q_dot, self_motion;
    ik.solve(c.x_dot, q_dot);
    ik.project(c.phi, self_motion);
    const double length = 1 + expected.q_dot.norm();
    ASSERT_LT((q_dot + self_motion - expected.q_dot).norm(), 1e-11 * length) << "case " << i;
    ASSERT_LT((c.J * self_motion).norm(), 1e-11 * c.phi.norm()) << "case " << i;
    ++(expected.rank < c.J.rows() ? deficient : expected.lambda > 0 ? damped : regular);
  }
  EXPECT_GT(regular, kCases / 2);
  EXPECT_GT(damped, kCases / 2);
  EXPECT_GT(deficient, kCases / 5);
}

TEST_P(HybridIk, TrackingTakesABoundOfItsOwn) {
  for (int i = 0; i < kCases; ++i) {
    Case c = random_case(1e-3, 1);
    c.weights.setOnes();
    c.phi.setZero();
    HybridIkSettings tight;
    tight.residual_bound = 1e-7;
    TrackingIk ik;
    ik.assign(c.J, {});
    JointVector q_dot;
    ik.solve(c.x_dot, tight.residual_bound, q_dot);
    const JointVector expected = solve(c, tight).q_dot;
    ASSERT_LT((q_dot - expected).norm(), 1e-11 * (1 + expected.norm())) << "case " << i;
  }
}

/// U, S and V of A, however badly its columns are scaled, against Eigen's two-sided Jacobi.
TEST_P(HybridIk, RowSvdHasTheDigitsOfASvd) {
  const auto [m, n] = GetParam();
  for (int i = 0; i < kCases; ++i) {
    MatrixXd A = random_case(i % 2 == 0 ? 1e-12 : 1e-3, 1).J;
    if (i % 3 == 0) {
      for (int j = 0; j < n; ++j) A.col(j) *= log_uniform(generator_, 1e-6, 1);
    }
    if (i % 7 == 0) A.row(0) = -2 * A.row(m - 1);
    RowSvd svd;
    svd.decompose(A);
    const VectorXd s = A.jacobiSvd().singularValues();
    MatrixXd product = MatrixXd::Zero(m, n), U(m, m);
    for (int k = 0; k < m; ++k) {
      ASSERT_NEAR(svd.s(k), s(k), 1e-14 * s(0)) << "case " << i;
      for (int row = 0; row < m; ++row) U(row, k) = svd.along_u(k, VectorXd::Unit(m, row));
      if (!(svd.s(k) > 1e-14 * svd.s(0))) continue;
      JointVector v = JointVector::Zero(n);
      svd.add_v(k, 1, v);
      ASSERT_NEAR(svd.along_v(k, v), 1, 1e-13) << "case " << i;
      for (int other = 0; other < k; ++other) {
        ASSERT_LT(std::abs(svd.along_v(other, v)), 1e-13) << "case " << i;
      }
      product += svd.s(k) * U.col(k) * v.transpose();
    }
    ASSERT_LT((product - A).norm(), 1e-14 * s(0)) << "case " << i;
    ASSERT_LT((U.transpose() * U - MatrixXd::Identity(m, m)).norm(), 1e-14) << "case " << i;
  }
}

TEST_P(HybridIk, DoesNotAllocate) {
  const Case c = random_case(1e-3, 1e4);
  HybridIkResult result;
  const test_support::AllocationGuard guard;
  solve_hybrid_ik(c.J, c.x_dot, c.weights, c.phi, {}, result);
  EXPECT_EQ(guard.allocations(), 0u);
}

TEST(HybridIkLimits, SixRowsAndSixteenJointsDoNotAllocate) {
  Generator generator(99);
  Case c;
  c.J = with_singular_values(VectorXd::LinSpaced(kMaxTaskRows, 1, 0.1), kMaxJoints, generator);
  c.x_dot = random_vector(kMaxTaskRows, generator);
  c.weights = JointVector::Ones(kMaxJoints);
  c.phi = random_vector(kMaxJoints, generator);
  HybridIkResult result;
  const test_support::AllocationGuard guard;
  solve_hybrid_ik(c.J, c.x_dot, c.weights, c.phi, {}, result);
  EXPECT_EQ(guard.allocations(), 0u);
  EXPECT_LT((c.J * result.q_dot - c.x_dot).norm(), 1e-12);
}

TEST(HybridIkLimits, FewerJointsThanRowsIsALossOfRank) {
  Case c{TaskJacobian(2, 1), TaskVector(2), JointVector::Ones(1), JointVector::Zero(1)};
  c.J << 0, 0.5;
  c.x_dot << 0.3, 0.4;
  const HybridIkResult result = solve(c);
  EXPECT_EQ(result.rank, 1);
  EXPECT_NEAR(result.q_dot(0), 0.8, 1e-15);
  EXPECT_NEAR(result.residual, 0.3, 1e-15);
}

TEST(HybridIkLimits, AJacobianOfZeroLeavesPhiAlone) {
  Case c{TaskJacobian::Zero(2, 3), TaskVector::Ones(2), JointVector::Ones(3), JointVector::Ones(3)};
  const HybridIkResult result = solve(c);
  EXPECT_EQ(result.rank, 0);
  EXPECT_EQ(result.q_dot, c.phi);
  EXPECT_NEAR(result.residual, std::sqrt(2.0), 1e-15);
}

TEST(AllocationGuard, SeesNewMallocAndEigen) {
  if (!test_support::kCountsAllocations) return;
  const test_support::AllocationGuard guard;
  const auto text = std::make_unique<std::string>(100, 'x');
  EXPECT_GE(guard.allocations(), 2u);
  const std::uint64_t before = guard.allocations();
  const VectorXd vector = VectorXd::Zero(50);
  EXPECT_EQ(guard.allocations(), before + 1) << vector.size() << text->size();
}

}  // namespace
}  // namespace bqsa
