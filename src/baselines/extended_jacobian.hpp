/// @file
/// Extended Jacobian (Baillieul 1985): the self-motions are spent on staying where a criterion has no
/// gradient left in the null space.
#pragma once

#include <memory>
#include <utility>

#include "baselines/closest/arm_surroundings.hpp"
#include "baselines/limited_step.hpp"
#include "bqsa/hybrid_ik.hpp"
#include "bqsa/method.hpp"

namespace bqsa::baselines {

/// Where what remains of the gradient leads.
enum class Correction {
  kDescent,  ///< to lower H, in directions of negative curvature too
  kNewton,   ///< as the square system has it: to the stationary point near, be it a saddle
};

struct ExtendedJacobianSettings {
  double influence = 0.1;      ///< d0: clearance below which an obstacle enters the criterion [m]
  double posture_weight = 1;   ///< c, of the posture against the barriers [1/rad²]
  double convergence = 0.3;    ///< part of the remaining gradient that a tick removes, k dt [-]
  double damping = 0.1;        ///< delta, near algorithmic singularities [1/rad²]
  double exempt_length = 0.1;  ///< part of the last link, from the tip, that may be near [m]
  Correction correction = Correction::kDescent;
  StepLimit step_limit = StepLimit::kScale;
};

/// phi'(d) [1/m] of the barrier phi = (1 - x)³ / x, x = d / d0, for d < d0, else 0: infinite at
/// contact, twice continuously differentiable at d0. Below x = 0.02 it is as there, contact included.
double barrier_slope(double clearance, double influence);

/// The method. The criterion and its gradient are
///
///     H = sum over near pairs phi(d) + c |q - q_start|² / 2,   grad H = sum phi'(d) j0ᵀ + c (q - q_start),
///
/// the posture term making it well-posed where no obstacle is near. With Z an orthonormal basis of the
/// null space of J, the extended task is x = x_d and G = Zᵀ grad H = 0, its Jacobian [J; dG/dq]. With
/// lambda = J⁺ᵀ grad H, what the tip's constraint takes of the gradient, and the basis carried along
/// without turning in itself, the further rows are
///
///     dG/dq = Zᵀ A,   A = hess H - sum_r lambda_r hess x_r,
///
/// the Hessian of the Lagrangian H - lambdaᵀ x. A z is the central difference of grad H - Jᵀ lambda
/// along z: two configurations a self-motion, two searches and kinematics each. Because J Z = 0, the
/// square system [J; Zᵀ A] q_dot = [x_dot; -k G - dG/dt] is solved in two parts,
///
///     q_dot = J⁺ x_dot + Z y,   (Zᵀ A Z) y = -k G - dG/dt - Zᵀ A J⁺ x_dot,
///
/// so that the tip keeps to its path whatever becomes of y. It does not depend on the basis chosen.
/// dG/dt is that of moving obstacles.
///
/// Algorithmic singularities are where ZᵀAZ = V diag(mu) Vᵀ loses rank, as where a minimum of H ends in
/// a saddle: y would be infinite. There mu / (mu² + delta²) is taken for 1 / mu, the arm loses its
/// stationary point, and G leads it to another one. With Correction::kDescent |mu| stands before G, or
/// Newton's step would lead up to a maximum or saddle near by. Claims nothing.
class ExtendedJacobian final : public ReactiveMethod {
 public:
  ExtendedJacobian(const ExtendedJacobianSettings& settings,
                   std::unique_ptr<ClosestPointSearch> search)
      : settings_(settings), surroundings_(std::move(search)) {}

  void prepare(const Problem& problem) override;
  void step(const StepInput& input, StepOutput& output) override;

 private:
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxJoints, kMaxJoints>;

  JointVector gradient(const JointVector& q) const;
  JointVector hessian_along(const JointVector& z, const TaskVector& lambda, const StepInput& input);
  JointVector self_motion(const StepInput& input, const TaskJacobian& J,
                          const JointVector& tracking);
  JointVector damped_solution(const Square& ZAZ, const JointVector& kG, const JointVector& forcing);

  ExtendedJacobianSettings settings_;
  ArmSurroundings surroundings_;
  const Problem* problem_ = nullptr;
  bool obstacles_move_ = false;
};

/// `extended_jacobian`, on exact closest points. All pairs within influence enter the criterion: with
/// the closest ones only it would jump.
MethodEntry extended_jacobian_method();

}  // namespace bqsa::baselines
