/// @file
/// The hybrid inverse kinematics: weighted least norm, damped least squares and gradient projection
/// with a clamping velocity in one formula (paper, section 2.2; Eqs. 5-18, Lemma 2).
#pragma once

#include <Eigen/Core>

#include "bqsa/row_svd.hpp"

namespace bqsa {

struct HybridIkSettings {
  double singular_threshold = 0.05;  ///< s_0: smallest singular value without damping [m]
  double lambda_max = 0.05;          ///< largest damping factor [m]
  double residual_bound = 1e-3;      ///< eps: largest residual the damping may cause [m/s]
  double rank_threshold = 1e-9;      ///< part of the largest singular value that counts as zero [-]
};

struct HybridIkResult {
  JointVector q_dot;             ///< [rad/s]
  int rank = 0;                  ///< of the weighted Jacobian
  double smallest_singular = 0;  ///< s_m of the weighted Jacobian [m]
  double lambda = 0;             ///< damping factor used [m]
  double residual = 0;           ///< |x_dot - J q_dot| caused by damping and lost rank [m/s]
};

/// Joint velocity for the tip velocity x_dot, with J_w = J W^{-1/2} = U S Vᵀ of rank r:
///
///     q_dot = W^{-1/2} [ sum_{i<=r} s_i / (s_i² + lambda²) v_i u_iᵀ x_dot
///                        + (I - sum_{i<=r} v_i v_iᵀ) W^{1/2} phi ]
///
/// The projector is not damped, and W^{1/2} phi inside it lets a phi from the kernel of J pass
/// unchanged for every W. lambda follows the corrected Lemma 2: 0 while s_m >= s_0, else the
/// smaller of lambda_max² (1 - (s_m / s_0)²) and the largest value that keeps the residual below
/// eps, eps s_m² / (|x_dot| - eps). A rank-deficient J has a residual that no damping avoids; it is
/// reported.
///
/// @param J        task Jacobian, m x n [m/rad]
/// @param x_dot    task velocity, m [m/s]
/// @param weights  diagonal of W, n, all positive [-]; a large weight holds a joint still
/// @param phi      clamping velocity, n, projected on the self-motions [rad/s]
/// Does not allocate.
void solve_hybrid_ik(const TaskJacobian& J, const TaskVector& x_dot, const JointVector& weights,
                     const JointVector& phi, const HybridIkSettings& settings,
                     HybridIkResult& result);

/// The inverse of G = J Jᵀ, J of 2 or 3 rows, where no velocity can call for damping and the inverse is
/// accurate: where the smallest eigenvalue of G surely is s_0² or more, and not too small beside the
/// others. False elsewhere.
template <int Rows>
bool undamped_inverse(const Eigen::Matrix<double, Rows, Rows>& G, const HybridIkSettings& settings,
                      Eigen::Matrix<double, Rows, Rows>& inverse);

/// The same with W = I for one Jacobian, asked for any number of velocities.
///
/// Where no velocity can call for damping, because J Jᵀ - s_0² I is positive definite, q_dot is
/// phi + J⁺ (x_dot - J phi) by the inverse of J Jᵀ; it differs from the formula by rounding, at most
/// about 1e-12 of its length. Elsewhere it is the formula itself.
class TrackingIk {
 public:
  /// @param J  of up to kMaxTaskRows rows
  /// Does not allocate.
  void assign(const TaskJacobian& J, const HybridIkSettings& settings);

  /// q_dot [rad/s] for x_dot [m/s] and phi = 0.
  /// @param residual_bound  eps, in place of that of the settings [m/s]
  void solve(const TaskVector& x_dot, double residual_bound, JointVector& q_dot) const;
  void solve(const TaskVector& x_dot, JointVector& q_dot) const {
    solve(x_dot, settings_.residual_bound, q_dot);
  }

  /// What is left of phi in the self-motions, for x_dot = 0.
  void project(const JointVector& phi, JointVector& q_dot) const;

 private:
  template <int Rows>
  bool invert(const TaskJacobian& J);
  template <int Rows>
  void add_pseudo_inverse(const TaskVector& x_dot, JointVector& q_dot) const;

  HybridIkSettings settings_;
  int rows_ = 0;
  int joints_ = 0;
  bool regular_ = false;  ///< whether the inverse is used; then not the decomposition
  std::array<std::array<double, kMaxJoints>, 3> J_;  ///< by rows
  Eigen::Matrix3d inverse_;                          ///< of J Jᵀ, of the size of the task
  RowSvd svd_;
};

}  // namespace bqsa
