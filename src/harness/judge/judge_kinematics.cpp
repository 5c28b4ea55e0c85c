#include "harness/judge/judge_kinematics.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace bqsa::harness {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector3d;

Matrix4d turn_about_x(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Matrix4d X;
  X << 1, 0, 0, 0,  //
      0, c, -s, 0,  //
      0, s, c, 0,   //
      0, 0, 0, 1;
  return X;
}

Matrix4d turn_about_z(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Matrix4d X;
  X << c, -s, 0, 0,  //
      s, c, 0, 0,    //
      0, 0, 1, 0,    //
      0, 0, 0, 1;
  return X;
}

Matrix4d shift(double x, double z) {
  Matrix4d X = Matrix4d::Identity();
  X(0, 3) = x;
  X(2, 3) = z;
  return X;
}

}  // namespace

JudgeKinematics::JudgeKinematics(const ChainDescription& chain)
    : base_(Matrix4d::Identity()), has_tool_(chain.p_LT.squaredNorm() > 0) {
  base_.topLeftCorner<3, 3>() = chain.R_WB;
  base_.topRightCorner<3, 1>() = chain.p_WB;
  tool_ << chain.p_LT, 1;
  tool_rotation_ = chain.R_LT;

  std::vector<double> lengths;  // of link i, between points i - 1 and i
  std::vector<double> own;      // distance of point j + 1 from the axis of joint j
  for (const JointPlacement& placement : chain.placements) {
    Matrix4d X = Matrix4d::Identity();
    X.topLeftCorner<3, 3>() = placement.R_PJ;
    X.topRightCorner<3, 1>() = placement.p_PJ;
    rows_.push_back({X, Matrix4d::Identity(), 0, placement.type == JointType::kPrismatic});
    lengths.push_back(placement.p_PJ.norm());
    own.push_back(0);
  }
  for (const DhRow& row : chain.rows) {
    const bool modified = chain.convention == DhConvention::kModified;
    own.push_back(modified ? 0 : std::abs(row.a));
    if (modified) {
      rows_.push_back({turn_about_x(row.alpha) * shift(row.a, 0), shift(0, row.d), row.offset});
    } else {
      rows_.push_back(
          {Matrix4d::Identity(), shift(row.a, row.d) * turn_about_x(row.alpha), row.offset});
    }
    lengths.push_back(std::hypot(row.a, row.d));
  }
  if (has_tool_) lengths.push_back(chain.p_LT.norm());
  for (int i = 0; i + 1 < points(); ++i) {
    const bool varies = i < joints() && is_prismatic(i);
    if (varies || lengths[static_cast<std::size_t>(i)] > 0) links_.push_back({i + 1, i, i + 1});
  }

  // The axis of joint j passes through point j (standard) or point j + 1 (modified, placements); the
  // lengths from there to a point bound its distance to the axis. The first standard row goes by d
  // along the axis itself.
  reach_ = Eigen::MatrixXd::Zero(joints(), points());
  for (int j = 0; j < joints(); ++j) {
    double sum = own[static_cast<std::size_t>(j)];
    reach_(j, j + 1) = sum;
    for (int k = j + 2; k < points(); ++k) {
      sum += lengths[static_cast<std::size_t>(k - 1)];
      reach_(j, k) = sum;
    }
  }
}

void JudgeKinematics::place(const Eigen::VectorXd& q, PointPositions& positions) const {
  positions.points.clear();
  positions.axes.clear();
  positions.pivots.clear();
  Matrix4d X = base_;
  positions.points.push_back(X.topRightCorner<3, 1>());
  for (int j = 0; j < joints(); ++j) {
    const Row& row = rows_[static_cast<std::size_t>(j)];
    X = X * row.before;
    positions.axes.push_back(X.block<3, 1>(0, 2));
    positions.pivots.push_back(X.topRightCorner<3, 1>());
    X = X * moved(row, q(j)) * row.after;
    positions.points.push_back(X.topRightCorner<3, 1>());
  }
  if (has_tool_) positions.points.push_back((X * tool_).head<3>());
}

/// The joint's own motion.
Eigen::Matrix4d JudgeKinematics::moved(const Row& row, double q) {
  return row.prismatic ? shift(0, q) : turn_about_z(q + row.offset);
}

Eigen::Matrix3d JudgeKinematics::tip_rotation(const Eigen::VectorXd& q) const {
  Matrix4d X = base_;
  for (int j = 0; j < joints(); ++j) {
    const Row& row = rows_[static_cast<std::size_t>(j)];
    X = X * row.before * moved(row, q(j)) * row.after;
  }
  return X.topLeftCorner<3, 3>() * tool_rotation_;
}

Eigen::Vector3d JudgeKinematics::velocity(const PointPositions& positions,
                                          const Eigen::VectorXd& rates, int point) const {
  const auto at = static_cast<std::size_t>(point);
  Vector3d sum = Vector3d::Zero();
  for (int j = 0; j < joints() && j < point; ++j) {
    const auto joint = static_cast<std::size_t>(j);
    const Vector3d& axis = positions.axes[joint];
    if (is_prismatic(j)) {
      sum += rates(j) * axis;
    } else {
      sum += rates(j) * axis.cross(positions.points[at] - positions.pivots[joint]);
    }
  }
  return sum;
}

double JudgeKinematics::speed_bound(int joint, int point, const Eigen::VectorXd& travel) const {
  if (joint >= point) return 0;
  if (is_prismatic(joint)) return 1;
  double bound = reach(joint, point);
  for (int i = joint + 1; i < joints() && i < point; ++i) {
    if (is_prismatic(i)) bound += travel(i);
  }
  return bound;
}

}  // namespace bqsa::harness
