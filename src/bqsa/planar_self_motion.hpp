/// @file
/// The self-motion behind joint clamping in the plane: turn one link, leave everything beyond in
/// place.
#pragma once

#include "bqsa/kinematics/serial_chain.hpp"
#include "bqsa/work_counters.hpp"

namespace bqsa {

/// Turns link i by `turn` while the base and O_{a+1} stay: joints 1 .. a move by the least-norm
/// Newton steps on the three conditions {O_{a+1} fixed (2), psi_i shifted}, and joint a+1 undoes
/// the turn of link a, so that links a+1 .. n, the tip with them, do not move ("links with a larger
/// index are not deformed"; paper, section 3.3). The paper's geometric construction (Eqs. 25-28)
/// with its inner chain re-solved; three links are needed, so a >= 3.
class PlanarSelfMotion {
 public:
  /// The chain must be planar; chain and counters must outlive this.
  void assign(const SerialChain& chain, WorkCounters& counters) {
    chain_ = &chain;
    counters_ = &counters;
  }

  /// @param link    i, 1-based, i <= anchor
  /// @param anchor  a, 3 <= a <= n; for a = n the tip is the fixed point
  /// @param turn    change of the link's absolute angle psi_i [rad]
  /// @param q       joint angles, changed in place; unspecified after failure [rad]
  /// @param pose    of q, before and, after success, afterwards
  /// @return false if Newton does not converge: the links 1 .. a are stretched or aligned
  /// Does not allocate.
  bool turn_link(int link, int anchor, double turn, JointVector& q, ChainPose& pose);

 private:
  const SerialChain* chain_ = nullptr;
  WorkCounters* counters_ = nullptr;

  void forward(const JointVector& q, ChainPose& pose);

  TaskJacobian J_;
};

}  // namespace bqsa
