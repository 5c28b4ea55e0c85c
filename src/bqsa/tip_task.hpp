/// @file
/// What the tip has to do at one time, as rows: its position, and where the task has it the direction of
/// its axis or its orientation.
#pragma once

#include <Eigen/Core>

#include "bqsa/problem.hpp"
#include "bqsa/row_svd.hpp"

namespace bqsa {

/// What a radian counts for in tasks with an orientation, so that one norm says how far the tip is off and
/// one threshold how near to singular the arm is [m/rad]. About the forearm of an arm on a table: with it
/// position and orientation weigh alike in the singular values, on which the damping acts.
inline constexpr double kOrientationLength = 0.3;

/// The turn that R makes, as its axis times its angle, from 0 to pi [rad]: the logarithm of R. Where the
/// angle is pi both directions of the axis are right, and one of them is the answer.
Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& R);

/// Rows of the task and how far the tip is from it. With an orientation the rows behind those of the
/// position are angular, times kOrientationLength, of the rotation vector that brings the tip frame T
/// to its desired orientation (Siciliano et al.: Robotics, 2009, section 3.7.3, there the axis times
/// the sine of the angle):
///
///   pose  that of R_WT(t) R_WTᵀ in W, 3 rows;
///   axis  the least turn that brings T's z axis to that of R_WT(t), which has no part along T's z axis: its
///         parts along T's x and y axes, 2 rows. Where the axes are opposite, a half turn about T's x axis.
///
/// So the spin about T's own z axis is free to first order wherever the axis points to. Where nothing but
/// the position counts, this is SerialChain's Jacobian and the way to x_d(t).
class TipTask {
 public:
  TipTask() = default;
  /// The chain outlives the task.
  explicit TipTask(const SerialChain& chain, TaskKind kind = TaskKind::kPosition)
      : chain_(&chain), kind_(kind) {}
  explicit TipTask(const Problem& problem) : TipTask(problem.chain, problem.task_kind) {}

  const SerialChain& chain() const { return *chain_; }
  bool has_orientation() const { return kind_ != TaskKind::kPosition; }

  /// From now on this is the desired orientation R_WT(t); the identity before.
  void turn_to(const Eigen::Matrix3d& R_WT) { desired_ = R_WT; }

  /// Rows x joints [m/rad, m/m].
  void jacobian(const ChainPose& pose, TaskJacobian& J) const {
    chain_->jacobian(pose, chain_->points() - 1, J);
    if (has_orientation()) append_angular_rows(pose, J);
  }

  /// What a first-order step has to make up for if the tip has to be at p_WT [m].
  TaskVector error(const ChainPose& pose, const Eigen::Vector3d& p_WT) const {
    if (has_orientation()) return full_error(pose, p_WT);
    return (p_WT - pose.tip()).head(chain_->dimension());
  }

  /// The length of that [m].
  double distance(const ChainPose& pose, const Eigen::Vector3d& p_WT) const {
    return has_orientation() ? full_error(pose, p_WT).norm() : (p_WT - pose.tip()).norm();
  }

  /// A distance within which the tip keeps the tolerances of a problem with this task [m].
  static double tolerance(const Problem& problem);

 private:
  void append_angular_rows(const ChainPose& pose, TaskJacobian& J) const;
  TaskVector full_error(const ChainPose& pose, const Eigen::Vector3d& p_WT) const;

  const SerialChain* chain_ = nullptr;
  TaskKind kind_ = TaskKind::kPosition;
  Eigen::Matrix3d desired_ = Eigen::Matrix3d::Identity();  // R_WT(t)
};

}  // namespace bqsa
