#include "baselines/extended_jacobian.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "baselines/closest/exact_distance_search.hpp"

namespace bqsa::baselines {
namespace {

// The best of results/gain_sweep (tools/sweep_gains.py).
constexpr ExtendedJacobianSettings kDefaults{.influence = 0.093,
                                             .posture_weight = 58,
                                             .convergence = 0.083,
                                             .damping = 0.015,
                                             .exempt_length = 0.068};

using Transposed =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxJoints, kMaxTaskRows>;
using TransposedQr = Eigen::ColPivHouseholderQR<Transposed>;

constexpr double kDifference = 1e-6;  ///< half of the difference in joint space [rad]

ExtendedJacobianSettings read(const ParameterValues& values) {
  return {.influence = values.number("influence"),
          .posture_weight = values.number("posture_weight"),
          .convergence = values.number("convergence"),
          .damping = values.number("damping"),
          .exempt_length = values.number("exempt_length"),
          .correction =
              values.choice("correction") == "descent" ? Correction::kDescent : Correction::kNewton,
          .step_limit = read_step_limit(values)};
}

TransposedQr decomposed(const Transposed& J_transposed) {
  TransposedQr qr(J_transposed.rows(), J_transposed.cols());
  qr.setThreshold(1e-9);
  qr.compute(J_transposed);
  return qr;
}

}  // namespace

double barrier_slope(double clearance, double influence) {
  const double x = std::max(clearance / influence, 0.02);
  return x < 1 ? -(1 - x) * (1 - x) * (1 + 2 * x) / (x * x * influence) : 0;
}

void ExtendedJacobian::prepare(const Problem& problem) {
  problem_ = &problem;
  counters_ = {};
  obstacles_move_ = std::ranges::any_of(problem.obstacles, &Obstacle::moves);
  surroundings_.assign(problem,
                       {.influence = settings_.influence,
                        .exempt_length = settings_.exempt_length,
                        .all_pairs = true},
                       counters_);
}

void ExtendedJacobian::step(const StepInput& input, StepOutput& output) {
  output = {};
  surroundings_.look(input.tick, input.q);
  const TaskJacobian J = surroundings_.task_jacobian();
  const JointVector& tracking = surroundings_.track(input);
  for (const Escape& escape : surroundings_.escapes()) {
    surroundings_.record(escape, output);
  }
  const JointVector avoidance = self_motion(input, J, tracking);
  make_step(*problem_, input, tracking, avoidance, settings_.step_limit, output);
}

/// grad H at q, where the arm was last looked at.
JointVector ExtendedJacobian::gradient(const JointVector& q) const {
  JointVector sum = settings_.posture_weight * (q - problem_->start);
  for (const Escape& escape : surroundings_.escapes()) {
    sum += barrier_slope(escape.clearance, settings_.influence) * escape.j0;
  }
  return sum;
}

/// A z.
JointVector ExtendedJacobian::hessian_along(const JointVector& z, const TaskVector& lambda,
                                            const StepInput& input) {
  const auto gradient_of_lagrangian = [&](const JointVector& q) -> JointVector {
    surroundings_.look(input.tick, q);
    return gradient(q) - surroundings_.task_jacobian().transpose() * lambda;
  };
  const JointVector ahead = gradient_of_lagrangian(input.q + kDifference * z);
  const JointVector behind = gradient_of_lagrangian(input.q - kDifference * z);
  return (ahead - behind) / (2 * kDifference);
}

/// Z y, where the arm was last looked at.
JointVector ExtendedJacobian::self_motion(const StepInput& input, const TaskJacobian& J,
                                          const JointVector& tracking) {
  const TransposedQr qr = decomposed(J.transpose());
  ++counters_.linear_solves;
  const Eigen::Index motions = J.cols() - qr.rank();
  if (motions == 0) return JointVector::Zero(input.q.size());
  const Square Q = qr.householderQ() * Square::Identity(J.cols(), J.cols());
  const Square Z = Q.rightCols(motions);

  const JointVector grad_H = gradient(input.q);
  const TaskVector lambda = qr.solve(grad_H);
  Square ZAZ(motions, motions);
  JointVector forcing(motions);  // dG/dt + Zᵀ A J⁺ x_dot
  for (Eigen::Index k = 0; k < motions; ++k) {
    const JointVector along = hessian_along(Z.col(k), lambda, input);
    ZAZ.col(k) = Z.transpose() * along;
    forcing(k) = along.dot(tracking);
  }
  if (obstacles_move_) {
    surroundings_.look(input.tick + 1, input.q);
    forcing += Z.transpose() * (gradient(input.q) - grad_H) / problem_->dt;
  }
  const double k = settings_.convergence / problem_->dt;
  return Z * damped_solution(ZAZ, k * (Z.transpose() * grad_H), forcing);
}

/// y of (ZᵀAZ) y = -k G - forcing, direction by direction.
JointVector ExtendedJacobian::damped_solution(const Square& ZAZ, const JointVector& kG,
                                              const JointVector& forcing) {
  const Eigen::SelfAdjointEigenSolver<Square> eigen(0.5 * (ZAZ + ZAZ.transpose()));
  ++counters_.linear_solves;
  const Square& V = eigen.eigenvectors();
  const JointVector kG_V = V.transpose() * kG, forcing_V = V.transpose() * forcing;
  JointVector y = JointVector::Zero(kG.size());
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    const double mu = eigen.eigenvalues()(i);
    const double inverse = mu / (mu * mu + settings_.damping * settings_.damping);
    const bool down = settings_.correction == Correction::kDescent;
    y -= ((down ? std::abs(inverse) : inverse) * kG_V(i) + inverse * forcing_V(i)) * V.col(i);
  }
  return y;
}

MethodEntry extended_jacobian_method() {
  return {
      .name = "extended_jacobian",
      .summary = "self-motions spent on staying where barriers and posture balance",
      .source =
          "Baillieul: Kinematic Programming Alternatives for Redundant Manipulators, ICRA 1985; "
          "Avoiding Obstacles and Resolving Kinematic Redundancy, ICRA 1986",
      .capabilities =
          {.planar = true, .spatial = true, .link_radius = true, .margin = true, .moving = true},
      .parameters = {{"influence", "m", kDefaults.influence, 1e-6, 10,
                      "clearance below which an obstacle enters the criterion, d0"},
                     {"posture_weight", "1/rad^2", kDefaults.posture_weight, 1e-9, 1e9,
                      "weight of the posture against the barriers, c"},
                     {"convergence", "-", kDefaults.convergence, 0, 1,
                      "part of the remaining gradient that a tick removes, k dt"},
                     {"damping", "1/rad^2", kDefaults.damping, 1e-12, 1e9,
                      "damping near algorithmic singularities, delta"},
                     exempt_length_parameter(kDefaults.exempt_length),
                     choice_parameter("correction", {"descent", "newton"},
                                      "where the remaining gradient leads: to lower H, or to "
                                      "whatever stationary point is near"),
                     step_limit_parameter()},
      .make = [](const ParameterValues& values) -> std::unique_ptr<Method> {
        return std::make_unique<ExtendedJacobian>(read(values),
                                                  std::make_unique<ExactDistanceSearch>());
      }};
}

}  // namespace bqsa::baselines
