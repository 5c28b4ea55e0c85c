#include "bqsa/tip_task.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace bqsa {
namespace {

/// The least turn that brings the z axis of R to the direction d, along the x and y axes of R [rad].
Eigen::Vector2d turn_of_axis(const Eigen::Matrix3d& R, const Eigen::Vector3d& d) {
  const Eigen::Vector3d across = R.col(2).cross(d);
  const double sine = across.norm();
  const double angle = std::atan2(sine, R.col(2).dot(d));
  if (sine == 0) return {angle, 0};
  return angle / sine * Eigen::Vector2d(R.col(0).dot(across), R.col(1).dot(across));
}

}  // namespace

Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

double TipTask::tolerance(const Problem& problem) {
  if (!problem.has_orientation()) return problem.tolerance;
  return std::min(problem.tolerance, kOrientationLength * problem.orientation_tolerance);
}

void TipTask::append_angular_rows(const ChainPose& pose, TaskJacobian& J) const {
  const TaskJacobian J_position = J;
  const int joints = chain_->joints();
  J.resize(kind_ == TaskKind::kAxis ? 5 : 6, joints);
  J.topRows<3>() = J_position;
  const Eigen::Matrix3d R = chain_->tip_rotation(pose);
  for (int j = 0; j < joints; ++j) {
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();
    if (!chain_->is_prismatic(j)) turn = kOrientationLength * pose.axis_W.col(j);
    if (kind_ == TaskKind::kAxis) {
      J.col(j).tail<2>() << R.col(0).dot(turn), R.col(1).dot(turn);
    } else {
      J.col(j).tail<3>() = turn;
    }
  }
}

TaskVector TipTask::full_error(const ChainPose& pose, const Eigen::Vector3d& p_WT) const {
  const Eigen::Matrix3d R = chain_->tip_rotation(pose);
  TaskVector error(kind_ == TaskKind::kAxis ? 5 : 6);
  error.head<3>() = p_WT - pose.tip();
  if (kind_ == TaskKind::kAxis) {
    error.tail<2>() = kOrientationLength * turn_of_axis(R, desired_.col(2));
  } else {
    error.tail<3>() = kOrientationLength * rotation_vector(desired_ * R.transpose());
  }
  return error;
}

}  // namespace bqsa
