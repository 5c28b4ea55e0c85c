#include "bqsa/hybrid_ik.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

namespace bqsa {
namespace {

/// Lemma 2 (corrected): the damping factor squared for the smallest singular value s_m.
double damping_squared(double s_m, double speed, const HybridIkSettings& settings) {
  if (s_m >= settings.singular_threshold) return 0;
  const double ratio = s_m / settings.singular_threshold;
  const double ceiling = settings.lambda_max * settings.lambda_max * (1 - ratio * ratio);
  const double eps = settings.residual_bound;
  const double accurate =
      speed <= eps ? std::numeric_limits<double>::infinity() : eps * s_m * s_m / (speed - eps);
  return std::min(accurate, ceiling);
}

}  // namespace

void solve_hybrid_ik(const TaskJacobian& J, const TaskVector& x_dot, const JointVector& weights,
                     const JointVector& phi, const HybridIkSettings& settings,
                     HybridIkResult& result) {
  const JointVector root_w = weights.cwiseSqrt();
  const TaskJacobian J_w = J * root_w.cwiseInverse().asDiagonal();
  const Eigen::JacobiSVD<TaskJacobian> svd(J_w, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const TaskVector& s = svd.singularValues();
  const Eigen::Index m = s.size();

  Eigen::Index rank = 0;
  while (rank < m && s(rank) > settings.rank_threshold * s(0)) ++rank;
  const double lambda_squared = damping_squared(s(m - 1), x_dot.norm(), settings);

  // In the coordinates of the singular vectors: a_i = u_iᵀ x_dot and, for the self-motion, what
  // W^{1/2} phi has along v_i is taken away.
  JointVector weighted = root_w.cwiseProduct(phi);
  for (Eigen::Index i = 0; i < rank; ++i) {
    const double a = svd.matrixU().col(i).dot(x_dot);
    const double damped = s(i) * s(i) + lambda_squared;
    const double along = svd.matrixV().col(i).dot(weighted);
    weighted += (s(i) / damped * a - along) * svd.matrixV().col(i);
  }

  result.q_dot = weighted.cwiseQuotient(root_w);
  result.rank = static_cast<int>(rank);
  result.smallest_singular = s(m - 1);
  result.lambda = std::sqrt(lambda_squared);
  result.residual = (x_dot - J * result.q_dot).norm();
}

}  // namespace bqsa
