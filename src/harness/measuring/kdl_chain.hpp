/// @file
/// The same arm for Orocos KDL, an outside reference for kinematics.
#pragma once

#include <kdl/chain.hpp>
#include <kdl/chainiksolvervel_wdls.hpp>

#include "bqsa/kinematics/serial_chain.hpp"

namespace bqsa::harness {

inline KDL::Vector kdl_vector(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// Base and tool are segments without joint. Joint values are the chain's; KDL's frame at the end is
/// that of the tip.
inline KDL::Chain kdl_chain(const ChainDescription& arm) {
  KDL::Chain chain;
  const auto add = [&chain](KDL::Joint::JointType type, const KDL::Frame& frame) {
    chain.addSegment(KDL::Segment(KDL::Joint(type), frame));
  };
  const auto frame = [](const Eigen::Matrix3d& R, const Eigen::Vector3d& p) {
    return KDL::Frame(KDL::Rotation(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0),
                                    R(2, 1), R(2, 2)),
                      kdl_vector(p));
  };
  add(KDL::Joint::None, frame(arm.R_WB, arm.p_WB));
  for (const JointPlacement& placement : arm.placements) {
    add(KDL::Joint::None, frame(placement.R_PJ, placement.p_PJ));
    add(placement.type == JointType::kPrismatic ? KDL::Joint::TransZ : KDL::Joint::RotZ,
        KDL::Frame::Identity());
  }
  for (const DhRow& row : arm.rows) {
    if (arm.convention == DhConvention::kStandard) {
      add(KDL::Joint::RotZ, KDL::Frame::DH(row.a, row.alpha, row.d, row.offset));
    } else {
      add(KDL::Joint::None, KDL::Frame::DH_Craig1989(row.a, row.alpha, 0, 0));
      add(KDL::Joint::RotZ, KDL::Frame::DH_Craig1989(0, 0, row.d, row.offset));
    }
  }
  add(KDL::Joint::None, frame(arm.R_LT, arm.p_LT));
  return chain;
}

/// KDL's velocity step for the tip's position alone. Rows of weight zero have singular values of zero,
/// which it would divide by; the damping keeps it from that and acts on those below 1e-5 only.
inline KDL::ChainIkSolverVel_wdls kdl_velocity_solver(const KDL::Chain& chain, int dimension) {
  KDL::ChainIkSolverVel_wdls solver(chain);
  Eigen::MatrixXd position_only = Eigen::MatrixXd::Zero(6, 6);
  position_only.diagonal().head(dimension).setOnes();
  solver.setWeightTS(position_only);
  solver.setLambda(solver.getEps());
  return solver;
}

}  // namespace bqsa::harness
