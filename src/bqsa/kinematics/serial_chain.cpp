#include "bqsa/kinematics/serial_chain.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace bqsa {
namespace {

/// Largest departure from orthonormality that passes for rounding.
constexpr double kRotationTolerance = 1e-9;

bool is_rotation(const Eigen::Matrix3d& R) {
  return R.isUnitary(kRotationTolerance) && R.determinant() > 0;
}

void validate(const ChainDescription& chain) {
  if (chain.joints() < 1 || chain.joints() > kMaxJoints) {
    throw std::invalid_argument("serial chain: expected 1 to 16 joints, got " +
                                std::to_string(chain.joints()));
  }
  if (chain.is_placed() && !chain.rows.empty()) {
    throw std::invalid_argument("serial chain: expected rows or placements, got both");
  }
  if (chain.dimension != 2 && chain.dimension != 3) {
    throw std::invalid_argument("serial chain: the dimension must be 2 or 3");
  }
  bool finite = chain.R_WB.allFinite() && chain.p_WB.allFinite() && chain.p_LT.allFinite() &&
                chain.R_LT.allFinite();
  for (const DhRow& row : chain.rows) {
    finite = finite && std::isfinite(row.a) && std::isfinite(row.alpha) && std::isfinite(row.d) &&
             std::isfinite(row.offset);
  }
  for (const JointPlacement& placement : chain.placements) {
    finite = finite && placement.R_PJ.allFinite() && placement.p_PJ.allFinite();
  }
  if (!finite) throw std::invalid_argument("serial chain: all parameters must be finite");
  bool rotations = is_rotation(chain.R_WB) && is_rotation(chain.R_LT);
  for (const JointPlacement& placement : chain.placements) {
    rotations = rotations && is_rotation(placement.R_PJ);
  }
  if (!rotations) {
    throw std::invalid_argument("serial chain: orientations must be orthonormal and right-handed");
  }
  bool in_plane = !chain.is_placed() && chain.R_WB.col(2) == Eigen::Vector3d::UnitZ() &&
                  chain.p_WB.z() == 0 && chain.p_LT.z() == 0;
  for (const DhRow& row : chain.rows) in_plane = in_plane && row.alpha == 0 && row.d == 0;
  if (chain.dimension == 2 && !in_plane) {
    throw std::invalid_argument(
        "serial chain: an arm of dimension 2 must have rows and lie in the plane z = 0");
  }
}

}  // namespace

SerialChain::SerialChain(ChainDescription description) : description_(std::move(description)) {
  validate(description_);
  const bool own_origin = description_.turns_about_own_origin();
  const bool tool = description_.p_LT.squaredNorm() > 0;
  joints_ = description_.joints();
  points_ = joints_ + 1 + (tool ? 1 : 0);
  in_plane_ = dimension() == 2 && !own_origin;

  moving_joints_.assign(static_cast<std::size_t>(points_), joints_);
  moving_joints_[0] = 0;
  Eigen::VectorXd length(points_ - 1);
  for (int j = 0; j < joints_; ++j) {
    const auto i = static_cast<std::size_t>(j);
    prismatic_[i] = description_.is_prismatic(j);
    has_prismatic_joints_ = has_prismatic_joints_ || prismatic_[i];
    moving_joints_[i + 1] = own_origin && !prismatic_[i] ? j : j + 1;
    length(j) = description_.link_length(j);
    if (description_.is_placed()) continue;
    const DhRow& row = description_.rows[i];
    offset_[i] = row.offset;
    a_[i] = row.a;
    d_[i] = row.d;
    cos_alpha_[i] = std::cos(row.alpha);
    sin_alpha_[i] = std::sin(row.alpha);
  }
  if (tool) length(joints_) = description_.p_LT.norm();
  for (int k = 0; k + 1 < points_; ++k) {
    if (length(k) > 0 || (k < joints_ && is_prismatic(k))) links_.push_back({k + 1, k, k + 1});
  }

  // Point j + 1 lies on the axis of joint j or, by a standard row, |a| away from it; the lengths from
  // there to point k bound the rest, but for what prismatic joints add.
  reach_ = Eigen::MatrixXd::Zero(joints_, points_);
  for (int j = 0; j < joints_; ++j) {
    const double a = own_origin ? 0 : std::abs(description_.rows[static_cast<std::size_t>(j)].a);
    for (int k = j + 1; k < points_; ++k) {
      if (j < moving_joints(k)) reach_(j, k) = a + length.segment(j + 1, k - j - 1).sum();
    }
  }
}

double SerialChain::speed_bound(int joint, int point, const JointVector& travel) const {
  if (joint >= moving_joints(point)) return 0;
  if (is_prismatic(joint)) return 1;
  double bound = reach(joint, point);
  if (!has_prismatic_joints_) return bound;
  for (int i = joint + 1; i < moving_joints(point); ++i) {
    if (is_prismatic(i)) bound += travel(i);
  }
  return bound;
}

void SerialChain::forward(const JointVector& q, ChainPose& pose) const {
  sine_cosine(q.data(), offset_, joints_, pose.sine, pose.cosine);
  place(q, pose);
}

void SerialChain::forward_from(const JointVector& q_from, const JointVector& q,
                               ChainPose& pose) const {
  if (!turn_slightly(q_from.data(), q.data(), joints_, pose.sine, pose.cosine)) {
    sine_cosine(q.data(), offset_, joints_, pose.sine, pose.cosine);
  }
  place(q, pose);
}

/// Everything but the sines and cosines of the pose, from them; of q only the prismatic joints count.
void SerialChain::place(const JointVector& q, ChainPose& pose) const {
  pose.p_WO.resize(3, points_);
  pose.axis_W.resize(3, joints_);
  pose.pivot_W.resize(3, joints_);
  if (in_plane_) return place_in_plane(pose);
  if (description_.is_placed()) return place_by_placements(q, pose);

  const bool modified = description_.convention == DhConvention::kModified;
  Eigen::Matrix3d R = description_.R_WB;
  Eigen::Vector3d p = description_.p_WB;
  pose.p_WO.col(0) = p;
  for (int j = 0; j < joints_; ++j) {
    const auto i = static_cast<std::size_t>(j);
    const double c = pose.cosine[i];
    const double s = pose.sine[i];
    const double ca = cos_alpha_[i];
    const double sa = sin_alpha_[i];
    const Eigen::Vector3d x = R.col(0), y = R.col(1), z = R.col(2);
    if (modified) {
      const Eigen::Vector3d y1 = ca * y + sa * z;
      const Eigen::Vector3d z1 = ca * z - sa * y;
      p += a_[i] * x + d_[i] * z1;
      pose.axis_W.col(j) = z1;
      pose.pivot_W.col(j) = p;
      R.col(0) = c * x + s * y1;
      R.col(1) = c * y1 - s * x;
      R.col(2) = z1;
    } else {
      const Eigen::Vector3d x1 = c * x + s * y;
      const Eigen::Vector3d y1 = c * y - s * x;
      pose.axis_W.col(j) = z;
      pose.pivot_W.col(j) = p;
      p += d_[i] * z + a_[i] * x1;
      R.col(0) = x1;
      R.col(1) = ca * y1 + sa * z;
      R.col(2) = ca * z - sa * y1;
    }
    pose.p_WO.col(j + 1) = p;
  }
  if (points_ > joints_ + 1) pose.p_WO.col(joints_ + 1) = p + R * description_.p_LT;
}

/// The same of a chain that is given by placements.
void SerialChain::place_by_placements(const JointVector& q, ChainPose& pose) const {
  Eigen::Matrix3d R = description_.R_WB;
  Eigen::Vector3d p = description_.p_WB;
  pose.p_WO.col(0) = p;
  for (int j = 0; j < joints_; ++j) {
    const auto i = static_cast<std::size_t>(j);
    const JointPlacement& placement = description_.placements[i];
    p += R * placement.p_PJ;
    R = R.lazyProduct(placement.R_PJ).eval();
    pose.axis_W.col(j) = R.col(2);
    pose.pivot_W.col(j) = p;
    if (prismatic_[i]) {
      p += q(j) * R.col(2);
    } else {
      const double c = pose.cosine[i];
      const double s = pose.sine[i];
      const Eigen::Vector3d x = R.col(0), y = R.col(1);
      R.col(0) = c * x + s * y;
      R.col(1) = c * y - s * x;
    }
    pose.p_WO.col(j + 1) = p;
  }
  if (points_ > joints_ + 1) pose.p_WO.col(joints_ + 1) = p + R * description_.p_LT;
}

/// The same for a planar arm in standard form: links are complex numbers, and joints turn them.
void SerialChain::place_in_plane(ChainPose& pose) const {
  double x = description_.R_WB(0, 0);  // of the link's direction
  double y = description_.R_WB(1, 0);
  double px = description_.p_WB.x();
  double py = description_.p_WB.y();
  double* p = pose.p_WO.data();
  double* pivot = pose.pivot_W.data();
  double* axis = pose.axis_W.data();
  for (std::size_t j = 0; j < static_cast<std::size_t>(joints_); ++j) {
    const double c = pose.cosine[j];
    const double s = pose.sine[j];
    const auto store = [=](double* at, double first, double second, double third) {
      at[3 * j] = first;
      at[3 * j + 1] = second;
      at[3 * j + 2] = third;
    };
    store(axis, 0, 0, 1);
    store(pivot, px, py, 0);
    store(p, px, py, 0);
    const double x1 = c * x - s * y;
    y = c * y + s * x;
    x = x1;
    px += a_[j] * x;
    py += a_[j] * y;
  }
  pose.p_WO.col(joints_) << px, py, 0;
  if (points_ > joints_ + 1) {
    const Eigen::Vector3d& tool = description_.p_LT;
    pose.p_WO.col(joints_ + 1) << px + x * tool.x() - y * tool.y(),
        py + y * tool.x() + x * tool.y(), 0;
  }
}

void SerialChain::jacobian(const ChainPose& pose, int point, TaskJacobian& J) const {
  J.resize(dimension(), joints_);
  const int moving = moving_joints(point);
  J.rightCols(joints_ - moving).setZero();
  const Eigen::Vector3d p = pose.p_WO.col(point);
  if (in_plane_) {
    for (int j = 0; j < moving; ++j) {  // every joint is where its link starts
      J(0, j) = pose.p_WO(1, j) - p.y();
      J(1, j) = p.x() - pose.p_WO(0, j);
    }
    return;
  }
  if (dimension() == 2) {
    for (int j = 0; j < moving; ++j) {
      J(0, j) = pose.pivot_W(1, j) - p.y();
      J(1, j) = p.x() - pose.pivot_W(0, j);
    }
    return;
  }
  for (int j = 0; j < moving; ++j) {
    const Eigen::Vector3d axis = pose.axis_W.col(j);
    const Eigen::Vector3d arm = p - pose.pivot_W.col(j);
    J.col(j) = axis.cross(arm);
  }
  for (int j = 0; has_prismatic_joints_ && j < moving; ++j) {
    if (is_prismatic(j)) J.col(j) = pose.axis_W.col(j);
  }
}

Eigen::Matrix3d SerialChain::tip_rotation(const ChainPose& pose) const {
  const bool standard = !description_.turns_about_own_origin();
  Eigen::Matrix3d R = description_.R_WB;
  for (int j = 0; j < joints_; ++j) {
    const auto i = static_cast<std::size_t>(j);
    const auto twist = [&] {
      const Eigen::Vector3d y = R.col(1), z = R.col(2);
      R.col(1) = cos_alpha_[i] * y + sin_alpha_[i] * z;
      R.col(2) = cos_alpha_[i] * z - sin_alpha_[i] * y;
    };
    if (description_.is_placed()) {
      R = R.lazyProduct(description_.placements[i].R_PJ).eval();
    } else if (!standard) {
      twist();
    }
    if (!prismatic_[i]) {
      const Eigen::Vector3d x = R.col(0), y = R.col(1);
      R.col(0) = pose.cosine[i] * x + pose.sine[i] * y;
      R.col(1) = pose.cosine[i] * y - pose.sine[i] * x;
    }
    if (standard) twist();
  }
  return R.lazyProduct(description_.R_LT);
}

}  // namespace bqsa
