#include "harness/measuring/plain_kinematics.hpp"

#include <Eigen/Geometry>
#include <cassert>
#include <cmath>

namespace bqsa::harness {

PlainKinematics::PlainKinematics(const ChainDescription& arm)
    : arm_(arm), base_angle_(std::atan2(arm.R_WB(1, 0), arm.R_WB(0, 0))) {
  assert(arm.convention == DhConvention::kStandard);
  for (const DhRow& row : arm.rows) {
    assert(arm.dimension == 3 || (row.alpha == 0 && row.d == 0));
    joints_.push_back({row.a, row.d, row.offset, std::cos(row.alpha), std::sin(row.alpha)});
  }
}

void PlainKinematics::update(const JointVector& q) {
  if (arm_.dimension == 2) {
    update_in_plane(q);
  } else {
    update_in_space(q);
  }
}

void PlainKinematics::update_in_plane(const JointVector& q) {
  const auto joints = static_cast<Eigen::Index>(joints_.size());
  double angle = base_angle_, x = arm_.p_WB.x(), y = arm_.p_WB.y();
  double c = std::cos(angle), s = std::sin(angle);
  for (Eigen::Index j = 0; j < joints; ++j) {
    const Joint& joint = joints_[static_cast<std::size_t>(j)];
    pivot_(0, j) = x;
    pivot_(1, j) = y;
    angle += q(j) + joint.offset;
    c = std::cos(angle);
    s = std::sin(angle);
    x += joint.a * c;
    y += joint.a * s;
  }
  const Eigen::Vector3d& tool = arm_.p_LT;
  tip_ << x + c * tool.x() - s * tool.y(), y + s * tool.x() + c * tool.y(), arm_.p_WB.z();
  for (Eigen::Index j = 0; j < joints; ++j) {
    jacobian_(0, j) = pivot_(1, j) - tip_.y();
    jacobian_(1, j) = tip_.x() - pivot_(0, j);
  }
}

void PlainKinematics::update_in_space(const JointVector& q) {
  const auto joints = static_cast<Eigen::Index>(joints_.size());
  Eigen::Matrix3d R = arm_.R_WB;
  Eigen::Vector3d p = arm_.p_WB;
  for (Eigen::Index j = 0; j < joints; ++j) {
    const Joint& joint = joints_[static_cast<std::size_t>(j)];
    pivot_.col(j) = p;
    axis_.col(j) = R.col(2);
    const double angle = q(j) + joint.offset;
    const double c = std::cos(angle), s = std::sin(angle);
    Eigen::Matrix3d turn;
    turn << c, -s * joint.cos_alpha, s * joint.sin_alpha,  //
        s, c * joint.cos_alpha, -c * joint.sin_alpha,      //
        0, joint.sin_alpha, joint.cos_alpha;
    p += R * Eigen::Vector3d(joint.a * c, joint.a * s, joint.d);
    R = R * turn;
  }
  tip_ = p + R * arm_.p_LT;
  for (Eigen::Index j = 0; j < joints; ++j) {
    jacobian_.col(j) = axis_.col(j).cross(tip_ - pivot_.col(j));
  }
}

}  // namespace bqsa::harness
