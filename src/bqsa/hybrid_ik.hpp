/// @file
/// The hybrid inverse kinematics: weighted least norm, damped least squares and gradient projection
/// with a clamping velocity in one formula (paper, section 2.2; Eqs. 5-18, Lemma 2).
#pragma once

#include <Eigen/Core>

#include "bqsa/kinematics/serial_chain.hpp"

namespace bqsa {

using TaskVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxTaskRows, 1>;

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

}  // namespace bqsa
