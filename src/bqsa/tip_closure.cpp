#include "bqsa/tip_closure.hpp"

#include <algorithm>
#include <limits>

namespace bqsa {
namespace {

/// Part of an error that a correction may leave for the next one to go on with the same Jacobian.
constexpr double kContracts = 0.05;

/// By how much better than the tolerance an error is expected to be for its pose to be taken in full.
constexpr double kSurely = 0.5;

/// Joint step of one correction beyond which it is cut back [rad].
constexpr double kLargestStep = 0.3;

/// @param known         with which corrections start; null if nothing is known
/// @param error_before  of the tip, before the last step [m]
double close_from(const TrackingIk* known, double error_before, const TipTask& task,
                  const Eigen::Vector3d& p_WT, double dt, const BqsaSettings& settings,
                  JointVector& q, ChainPose& pose, WorkCounters& counters) {
  const SerialChain& chain = task.chain();
  const double residual_bound = std::min(settings.ik.residual_bound, settings.tip_tolerance / dt);
  TrackingIk fresh;
  const TrackingIk* ik = known;
  JointVector q_dot;
  bool full = known == nullptr;  // whether the pose is that of `forward`, not made of one nearby
  double error = task.distance(pose, p_WT);
  const auto evaluate = [&](const JointVector& q_before, double expected) {
    full = expected < kSurely * settings.tip_tolerance;
    full ? chain.forward(q, pose) : chain.forward_from(q_before, q, pose);
    ++counters.kinematics;
    error_before = error;
    error = task.distance(pose, p_WT);
  };
  for (int k = 0; k < settings.corrections && error > settings.tip_tolerance; ++k) {
    if (ik == nullptr) {
      TaskJacobian J;
      task.jacobian(pose, J);
      fresh.assign(J, settings.ik);
      ++counters.jacobians;
      ++counters.linear_solves;
      ik = &fresh;
    }
    const TaskVector x_dot = task.error(pose, p_WT) / dt;
    ik->solve(x_dot, residual_bound, q_dot);
    const double largest = dt * q_dot.cwiseAbs().maxCoeff();
    const JointVector q_before = q;
    q += std::min(1.0, kLargestStep / largest) * dt * q_dot;
    // A first-order step along d leaves half of what a correction with the Jacobian before d leaves.
    evaluate(q_before, 2 * error * error / error_before);
    if (!(error < kContracts * error_before)) ik = nullptr;
  }
  if (!full) evaluate(q, 0);
  return error;
}

}  // namespace

double close_tip(const TipTask& task, const Eigen::Vector3d& p_WT, double dt,
                 const BqsaSettings& settings, const TrackingIk& ik, double error_before,
                 JointVector& q, ChainPose& pose, WorkCounters& counters) {
  return close_from(&ik, error_before, task, p_WT, dt, settings, q, pose, counters);
}

double close_tip(const TipTask& task, const Eigen::Vector3d& p_WT, double dt,
                 const BqsaSettings& settings, JointVector& q, ChainPose& pose,
                 WorkCounters& counters) {
  return close_from(nullptr, std::numeric_limits<double>::infinity(), task, p_WT, dt, settings, q,
                    pose, counters);
}

}  // namespace bqsa
