/// @file
/// Forward kinematics and the tip's Jacobian as textbooks have them, what a control step is compared with.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "bqsa/kinematics/serial_chain.hpp"

namespace bqsa::harness {

/// Joint by joint, with the sine and cosine of the C library and matrices of fixed size (Siciliano,
/// Sciavicco, Villani and Oriolo, Robotics, 2009, sections 2.8 and 3.1). In the plane sums of angles take the
/// place of rotation matrices, as nobody would write it otherwise. Shares no code with SerialChain.
class PlainKinematics {
 public:
  /// @param arm  in standard form; of dimension 2: without twist or offset along z
  explicit PlainKinematics(const ChainDescription& arm);

  /// Places the arm for q [rad].
  void update(const JointVector& q);

  const Eigen::Vector3d& tip() const { return tip_; }  ///< in W [m]

  /// Of the tip's position, one column a joint [m/rad]. In the plane the last row is not used.
  const Eigen::Matrix<double, 3, kMaxJoints>& jacobian() const { return jacobian_; }

 private:
  struct Joint {
    double a, d, offset, cos_alpha, sin_alpha;
  };

  void update_in_plane(const JointVector& q);
  void update_in_space(const JointVector& q);

  ChainDescription arm_;
  std::vector<Joint> joints_;
  double base_angle_;  ///< of the base about z [rad]
  Eigen::Matrix<double, 3, kMaxJoints> pivot_ = decltype(pivot_)::Zero();
  Eigen::Matrix<double, 3, kMaxJoints> axis_ = decltype(axis_)::Zero();
  Eigen::Matrix<double, 3, kMaxJoints> jacobian_ = decltype(jacobian_)::Zero();
  Eigen::Vector3d tip_ = Eigen::Vector3d::Zero();
};

}  // namespace bqsa::harness
