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

  const bool modified = chain.convention == DhConvention::kModified;
  std::vector<double> lengths;  // of link i, between points i - 1 and i
  for (const DhRow& row : chain.rows) {
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
    if (lengths[static_cast<std::size_t>(i)] > 0) links_.push_back({i + 1, i, i + 1});
  }

  // The axis of joint j passes through point j (standard) or point j + 1 (modified); the lengths
  // from there to a point bound its distance to the axis. The first standard row goes by d along
  // the axis itself.
  reach_ = Eigen::MatrixXd::Zero(joints(), points());
  for (int j = 0; j < joints(); ++j) {
    double sum = modified ? 0 : std::abs(chain.rows[static_cast<std::size_t>(j)].a);
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
    X = X * turn_about_z(q(j) + row.offset) * row.after;
    positions.points.push_back(X.topRightCorner<3, 1>());
  }
  if (has_tool_) positions.points.push_back((X * tool_).head<3>());
}

Eigen::Vector3d JudgeKinematics::velocity(const PointPositions& positions,
                                          const Eigen::VectorXd& rates, int point) const {
  const auto at = static_cast<std::size_t>(point);
  Vector3d sum = Vector3d::Zero();
  for (int j = 0; j < joints() && j < point; ++j) {
    const auto joint = static_cast<std::size_t>(j);
    sum += rates(j) * positions.axes[joint].cross(positions.points[at] - positions.pivots[joint]);
  }
  return sum;
}

}  // namespace bqsa::harness
