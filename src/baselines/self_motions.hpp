/// @file
/// The joint velocities that leave the tip where it is.
#pragma once

#include <array>

#include "bqsa/kinematics/serial_chain.hpp"

namespace bqsa::baselines {

/// Projects joint velocities on the self-motions of a task, P = I - J⁺J.
class SelfMotions {
 public:
  /// Orthonormal rows of J, by Gram-Schmidt with the largest remaining row first, done twice. Rows
  /// that fall below 1e-9 of the largest count as dependent. Does not allocate.
  void assign(const TaskJacobian& J);

  JointVector project(const JointVector& v) const;

 private:
  int rank_ = 0;
  std::array<JointVector, kMaxTaskRows> rows_;
};

}  // namespace bqsa::baselines
