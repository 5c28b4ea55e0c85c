#include "bqsa/tip_closure.hpp"

#include <algorithm>

namespace bqsa {
namespace {

/// Part of an error that a correction may leave for the next one to go on with the same Jacobian.
constexpr double kContracts = 0.05;

/// Joint step of one correction beyond which it is cut back [rad].
constexpr double kLargestStep = 0.3;

/// @param known  with which corrections start; null if nothing is known
double close_from(const TrackingIk* known, const SerialChain& chain, const Eigen::Vector3d& p_WT,
                  double dt, const BqsaSettings& settings, JointVector& q, ChainPose& pose,
                  WorkCounters& counters) {
  const double residual_bound =
      std::min(settings.ik.residual_bound, settings.tip_tolerance / dt);
  TrackingIk fresh;
  const TrackingIk* ik = known;
  JointVector q_dot;
  double error = (p_WT - pose.tip()).norm();
  for (int k = 0; k < settings.corrections && error > settings.tip_tolerance; ++k) {
    if (ik == nullptr) {
      TaskJacobian J;
      chain.jacobian(pose, chain.points() - 1, J);
      fresh.assign(J, settings.ik);
      ++counters.jacobians;
      ++counters.linear_solves;
      ik = &fresh;
    }
    const TaskVector x_dot = (p_WT - pose.tip()).head(chain.dimension()) / dt;
    ik->solve(x_dot, residual_bound, q_dot);
    const double largest = dt * q_dot.cwiseAbs().maxCoeff();
    const JointVector q_before = q;
    q += std::min(1.0, kLargestStep / largest) * dt * q_dot;
    chain.forward_from(q_before, q, pose);
    ++counters.kinematics;
    const double error_before = error;
    error = (p_WT - pose.tip()).norm();
    if (!(error < kContracts * error_before)) ik = nullptr;
  }
  return error;
}

}  // namespace

double close_tip(const SerialChain& chain, const Eigen::Vector3d& p_WT, double dt,
                 const BqsaSettings& settings, const TrackingIk& ik, JointVector& q,
                 ChainPose& pose, WorkCounters& counters) {
  return close_from(&ik, chain, p_WT, dt, settings, q, pose, counters);
}

double close_tip(const SerialChain& chain, const Eigen::Vector3d& p_WT, double dt,
                 const BqsaSettings& settings, JointVector& q, ChainPose& pose,
                 WorkCounters& counters) {
  return close_from(nullptr, chain, p_WT, dt, settings, q, pose, counters);
}

}  // namespace bqsa
