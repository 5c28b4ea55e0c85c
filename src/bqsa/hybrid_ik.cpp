#include "bqsa/hybrid_ik.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace bqsa {
namespace {

/// Smallest share of s_1² that s_m² must have for J Jᵀ to be inverted: it costs the square root of
/// its inverse in accuracy.
constexpr double kWellConditioned = 1e-4;

/// Part of s_0² within which rounding could decide; there it is left to the decomposition.
constexpr double kMargin = 1e-9;

/// Lemma 2 (corrected): the damping factor squared for the smallest singular value s_m.
double damping_squared(double s_m, double speed, double eps, const HybridIkSettings& settings) {
  if (s_m >= settings.singular_threshold) return 0;
  const double ratio = s_m / settings.singular_threshold;
  const double ceiling = settings.lambda_max * settings.lambda_max * (1 - ratio * ratio);
  const double accurate =
      speed <= eps ? std::numeric_limits<double>::infinity() : eps * s_m * s_m / (speed - eps);
  return std::min(accurate, ceiling);
}

int rank_of(const RowSvd& svd, double threshold) {
  int rank = 0;
  while (rank < svd.rows() && svd.s(rank) > threshold * svd.s(0)) ++rank;
  return rank;
}

/// The formula in the coordinates of the singular vectors: a_i = u_iᵀ x_dot along v_i, and what
/// W^{1/2} phi has along v_i is taken away.
/// @param weighted  W^{1/2} phi on entry, W^{1/2} q_dot after the call
void add_task_motion(const RowSvd& svd, int rank, double lambda_squared, const TaskVector& x_dot,
                     JointVector& weighted) {
  for (int i = 0; i < rank; ++i) {
    const double damped = svd.s(i) * svd.s(i) + lambda_squared;
    const double wanted = svd.s(i) / damped * svd.along_u(i, x_dot);
    svd.add_v(i, wanted - svd.along_v(i, weighted), weighted);
  }
}

/// Lemma 2: what damping and lost rank leave of x_dot.
double residual_of(const RowSvd& svd, int rank, double lambda_squared, const TaskVector& x_dot) {
  double squared = 0;
  for (int i = 0; i < svd.rows(); ++i) {
    const double left = i < rank ? lambda_squared / (svd.s(i) * svd.s(i) + lambda_squared) : 1;
    const double part = left * svd.along_u(i, x_dot);
    squared += part * part;
  }
  return std::sqrt(squared);
}

/// Determinants of the upper left corners of a symmetric matrix are all positive.
bool positive_definite(const Eigen::Matrix2d& G) {
  return G(0, 0) > 0 && G(0, 0) * G(1, 1) - G(1, 0) * G(1, 0) > 0;
}
bool positive_definite(const Eigen::Matrix3d& G) {
  const Eigen::Matrix2d corner = G.topLeftCorner<2, 2>();
  return positive_definite(corner) && G.determinant() > 0;
}

}  // namespace

void solve_hybrid_ik(const TaskJacobian& J, const TaskVector& x_dot, const JointVector& weights,
                     const JointVector& phi, const HybridIkSettings& settings,
                     HybridIkResult& result) {
  const JointVector root_w = weights.cwiseSqrt();
  RowSvd svd;
  svd.decompose(J * root_w.cwiseInverse().asDiagonal());
  const int rank = rank_of(svd, settings.rank_threshold);
  const double s_m = svd.s(svd.rows() - 1);
  const double lambda_squared =
      damping_squared(s_m, x_dot.norm(), settings.residual_bound, settings);

  JointVector weighted = root_w.cwiseProduct(phi);
  add_task_motion(svd, rank, lambda_squared, x_dot, weighted);
  result.q_dot = weighted.cwiseQuotient(root_w);
  result.rank = rank;
  result.smallest_singular = s_m;
  result.lambda = std::sqrt(lambda_squared);
  result.residual = residual_of(svd, rank, lambda_squared, x_dot);
}

template <int Rows>
bool undamped_inverse(const Eigen::Matrix<double, Rows, Rows>& G, const HybridIkSettings& settings,
                      Eigen::Matrix<double, Rows, Rows>& inverse) {
  const double threshold = settings.singular_threshold * settings.singular_threshold;
  const double least = std::max((1 + kMargin) * threshold, kWellConditioned * G.trace());
  Eigen::Matrix<double, Rows, Rows> beyond = G;
  beyond.diagonal().array() -= least;
  if (!positive_definite(beyond)) return false;
  inverse = G.inverse();
  return true;
}

template bool undamped_inverse<2>(const Eigen::Matrix2d&, const HybridIkSettings&,
                                  Eigen::Matrix2d&);
template bool undamped_inverse<3>(const Eigen::Matrix3d&, const HybridIkSettings&,
                                  Eigen::Matrix3d&);

void TrackingIk::assign(const TaskJacobian& J, const HybridIkSettings& settings) {
  settings_ = settings;
  rows_ = static_cast<int>(J.rows());
  joints_ = static_cast<int>(J.cols());
  regular_ = rows_ == 2 ? invert<2>(J) : rows_ == 3 && invert<3>(J);
  if (!regular_) svd_.decompose(J);
}

template <int Rows>
bool TrackingIk::invert(const TaskJacobian& J) {
  for (std::size_t i = 0; i < Rows; ++i) {
    for (int j = 0; j < joints_; ++j) {
      J_[i][static_cast<std::size_t>(j)] = J(static_cast<Eigen::Index>(i), j);
    }
  }
  Eigen::Matrix<double, Rows, Rows> G;
  for (int i = 0; i < Rows; ++i) {
    for (int k = 0; k <= i; ++k) {
      double sum = 0;
      for (int j = 0; j < joints_; ++j) sum += J(i, j) * J(k, j);
      G(i, k) = G(k, i) = sum;
    }
  }
  Eigen::Matrix<double, Rows, Rows> inverse;
  if (!undamped_inverse(G, settings_, inverse)) return false;
  inverse_.template topLeftCorner<Rows, Rows>() = inverse;
  return true;
}

template <int Rows>
void TrackingIk::add_pseudo_inverse(const TaskVector& x_dot, JointVector& q_dot) const {
  const Eigen::Matrix<double, Rows, 1> y =
      inverse_.template topLeftCorner<Rows, Rows>() * x_dot.template head<Rows>();
  for (int j = 0; j < joints_; ++j) {
    double sum = 0;
    for (std::size_t i = 0; i < Rows; ++i) {
      sum += J_[i][static_cast<std::size_t>(j)] * y(static_cast<Eigen::Index>(i));
    }
    q_dot(j) += sum;
  }
}

void TrackingIk::solve(const TaskVector& x_dot, double residual_bound, JointVector& q_dot) const {
  q_dot.setZero(joints_);
  if (regular_) {
    rows_ == 2 ? add_pseudo_inverse<2>(x_dot, q_dot) : add_pseudo_inverse<3>(x_dot, q_dot);
    return;
  }
  const double s_m = svd_.s(rows_ - 1);
  add_task_motion(svd_, rank_of(svd_, settings_.rank_threshold),
                  damping_squared(s_m, x_dot.norm(), residual_bound, settings_), x_dot, q_dot);
}

void TrackingIk::project(const JointVector& phi, JointVector& q_dot) const {
  q_dot = phi;
  if (!regular_) {
    add_task_motion(svd_, rank_of(svd_, settings_.rank_threshold), 0, TaskVector::Zero(rows_),
                    q_dot);
    return;
  }
  TaskVector against(rows_);
  for (int i = 0; i < rows_; ++i) {
    double sum = 0;
    for (int j = 0; j < joints_; ++j)
      sum += J_[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] * phi(j);
    against(i) = -sum;
  }
  rows_ == 2 ? add_pseudo_inverse<2>(against, q_dot) : add_pseudo_inverse<3>(against, q_dot);
}

}  // namespace bqsa
