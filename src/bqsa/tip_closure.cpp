#include "bqsa/tip_closure.hpp"

#include <algorithm>

namespace bqsa {
namespace {

/// Joint step of one correction beyond which it is cut back [rad].
constexpr double kLargestStep = 0.3;

}  // namespace

double close_tip(const SerialChain& chain, const Eigen::Vector3d& p_WT, double dt,
                 const BqsaSettings& settings, JointVector& q, ChainPose& pose,
                 WorkCounters& counters) {
  const int n = chain.joints();
  TaskJacobian J;
  HybridIkResult ik;
  HybridIkSettings accurate = settings.ik;
  accurate.residual_bound = std::min(accurate.residual_bound, settings.tip_tolerance / dt);
  double error = (p_WT - pose.tip()).norm();
  for (int k = 0; k < settings.corrections && error > settings.tip_tolerance; ++k) {
    chain.jacobian(pose, chain.points() - 1, J);
    const TaskVector x_dot = (p_WT - pose.tip()).head(chain.dimension()) / dt;
    solve_hybrid_ik(J, x_dot, JointVector::Ones(n), JointVector::Zero(n), accurate, ik);
    const double largest = dt * ik.q_dot.cwiseAbs().maxCoeff();
    q += std::min(1.0, kLargestStep / largest) * dt * ik.q_dot;
    chain.forward(q, pose);
    error = (p_WT - pose.tip()).norm();
    ++counters.jacobians;
    ++counters.linear_solves;
    ++counters.kinematics;
  }
  return error;
}

}  // namespace bqsa
