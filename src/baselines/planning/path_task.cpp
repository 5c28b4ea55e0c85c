#include "baselines/planning/path_task.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "bqsa/hybrid_ik.hpp"

namespace bqsa::baselines {
namespace {

constexpr int kMaxCorrections = 30;
constexpr double kLargestCorrection = 0.2;  ///< of a joint [rad]

using TaskMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxTaskRows, kMaxTaskRows>;

/// Jᵀ (J Jᵀ)⁻¹ x: the least-norm joint motion that moves the tip by x.
JointVector least_norm(const TaskJacobian& J, const TaskVector& x) {
  const TaskMatrix gram = J * J.transpose();
  const TaskVector multipliers = gram.ldlt().solve(x);
  return J.transpose() * multipliers;
}

}  // namespace

void PathTask::assign(const Problem& problem, WorkCounters& counters) {
  problem_ = &problem;
  counters_ = &counters;
}

void PathTask::look(const JointVector& q) {
  problem_->chain.forward(q, pose_);
  ++counters_->kinematics;
}

void PathTask::find_jacobian() {
  problem_->chain.jacobian(pose_, problem_->chain.points() - 1, J_);
  ++counters_->jacobians;
}

bool PathTask::close(double t, JointVector& q) {
  const Eigen::Vector3d desired = problem_->desired_tip(t);
  for (int k = 0; k <= kMaxCorrections; ++k) {
    look(q);
    const Eigen::Vector3d missing = desired - pose_.tip();
    if (missing.norm() <= kOnPath) return true;
    find_jacobian();
    ++counters_->linear_solves;
    const JointVector correction = least_norm(J_, missing.head(problem_->dimension()));
    const double largest = correction.cwiseAbs().maxCoeff();
    if (!std::isfinite(largest)) return false;
    q += std::min(1.0, kLargestCorrection / largest) * correction;
  }
  return false;
}

JointVector PathTask::self_motion(const JointVector& q, const JointVector& velocity) {
  look(q);
  find_jacobian();
  ++counters_->linear_solves;
  const TaskVector tip_velocity = J_ * velocity;
  return velocity - least_norm(J_, tip_velocity);
}

double PathTask::error(double t, const JointVector& q) {
  look(q);
  return (problem_->desired_tip(t) - pose_.tip()).norm();
}

}  // namespace bqsa::baselines
