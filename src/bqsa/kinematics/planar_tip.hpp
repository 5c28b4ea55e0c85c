/// @file
/// The tip of a planar arm close to a pose, without the poses in between.
#pragma once

#include <Eigen/Core>

#include "bqsa/kinematics/serial_chain.hpp"

namespace bqsa {

/// The tip of a planar arm after a step Jᵀ y of its joints, J the tip's Jacobian at one pose. Link k turns
/// by the sum of what joints 1 .. k turn, which is linear in y too; so the tip is a sum over links of which
/// none waits for another, and its derivative by y another one.
class PlanarTip {
 public:
  /// @param chain  `in_plane`
  /// @param pose   of which steps are made; only its end-points are looked at
  void assign(const SerialChain& chain, const ChainPose& pose);

  /// J Jᵀ [m²/rad²]
  const Eigen::Matrix2d& gram() const { return gram_; }

  /// What a step does to the tip.
  struct Moved {
    Eigen::Vector2d way;        ///< of the tip, to 1e-11 of the arm's length [m]
    Eigen::Matrix2d way_per_y;  ///< its derivative, J' Jᵀ with J' after the step [m²/rad²]
    bool slight;  ///< whether no link turns by more than kSlightTurn; else nothing is known
  };
  /// @param y  of the step [rad²/m]
  Moved move(const Eigen::Vector2d& y) const;

  /// q += Jᵀ y
  void step(const Eigen::Vector2d& y, JointVector& q) const;

 private:
  struct Joint {
    double J[2];           ///< its column [m/rad]
    double turn_per_y[2];  ///< of the link behind it: sum of the columns up to its own [m/rad]
    double link[2];        ///< to the next joint, or to the tip [m]
  };

  int joints_ = 0;
  std::array<Joint, kMaxJoints> per_joint_;
  Eigen::Matrix2d gram_;
};

}  // namespace bqsa
