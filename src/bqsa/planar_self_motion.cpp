#include "bqsa/planar_self_motion.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

namespace bqsa {
namespace {

constexpr int kMaxIterations = 25;
constexpr double kConverged = 1e-12;  // largest residual [rad], and part of the arm's length [-]
constexpr double kLargestStep = 0.3;  // joint step beyond which Newton is cut back [rad]
constexpr double kAbsurdStep = 1e6;  // a Newton step like this means that C has lost its rank [rad]
constexpr double kSingular = 1e-12;  // smallest pivot of C Cᵀ relative to its largest

}  // namespace

void PlanarSelfMotion::forward(const JointVector& q, ChainPose& pose) {
  chain_->forward(q, pose);
  ++counters_->kinematics;
}

bool PlanarSelfMotion::turn_link(int link, int anchor, double turn, JointVector& q,
                                 ChainPose& pose) {
  const Eigen::Vector2d p_anchor = pose.p_WO.col(anchor).head<2>();
  const double psi_anchor = q.head(anchor).sum();
  const double psi_target = q.head(link).sum() + turn;

  // Positions count in lengths of the arm, so that they weigh like angles for an arm of any size.
  const double length = chain_->reach(0, anchor);
  const double converged = kConverged * std::max(1.0, pose.p_WO.cwiseAbs().maxCoeff() / length);
  for (int iteration = 0;; ++iteration) {
    Eigen::Vector3d residual;
    residual << (p_anchor - pose.p_WO.col(anchor).head<2>()) / length,
        psi_target - q.head(link).sum();
    if (residual.cwiseAbs().maxCoeff() < converged) break;
    if (iteration == kMaxIterations) return false;

    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, kMaxJoints> C(3, anchor);
    chain_->jacobian(pose, anchor, J_);
    ++counters_->jacobians;
    C.topRows<2>() = J_.leftCols(anchor) / length;
    C.row(2).setZero();
    C.row(2).head(link).setOnes();
    const Eigen::LDLT<Eigen::Matrix3d> CCt(C * C.transpose());
    ++counters_->linear_solves;
    const Eigen::Vector3d pivots = CCt.vectorD();
    if (!(pivots.minCoeff() > kSingular * pivots.maxCoeff())) return false;
    const JointVector dq = C.transpose() * CCt.solve(residual);
    const double largest = dq.cwiseAbs().maxCoeff();
    if (!(largest < kAbsurdStep)) return false;
    q.head(anchor) += std::min(1.0, kLargestStep / largest) * dq;
    forward(q, pose);
  }
  if (anchor < chain_->joints()) {
    q(anchor) -= q.head(anchor).sum() - psi_anchor;
    forward(q, pose);
  }
  return true;
}

}  // namespace bqsa
