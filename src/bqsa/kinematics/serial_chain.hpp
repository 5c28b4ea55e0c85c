/// @file
/// Forward kinematics and Jacobians of every link end-point in one pass, without allocation.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "bqsa/kinematics/chain_description.hpp"
#include "bqsa/kinematics/sine_cosine.hpp"

namespace bqsa {

inline constexpr int kMaxJoints = kMaxAngles;
inline constexpr int kMaxLinks = kMaxJoints + 1;  ///< a tool is one more link
inline constexpr int kMaxPoints = kMaxLinks + 1;
inline constexpr int kMaxTaskRows = 6;

/// One number a joint [rad, rad/s, ...; m, m/s, ... of one that slides]; its storage is part of the
/// object.
using JointVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxJoints, 1>;

/// Task rows x joints; its storage is part of the object.
using TaskJacobian =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxTaskRows, kMaxJoints>;

/// A link segment between two points of the chain. Links of zero length are left out of a chain's
/// list, and the others keep their numbers.
struct Link {
  int number;  ///< the paper's i: 1-based row of the Denavit-Hartenberg table, or joint; a tool is n + 1
  int start;  ///< index of O_i in ChainPose::p_WO
  int end;    ///< index of O_{i+1}
};

/// Where everything is for one joint vector, in W.
struct ChainPose {
  template <int MaxColumns>
  using Columns = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, MaxColumns>;

  Columns<kMaxPoints>
      p_WO;  ///< column k is the paper's O_{k+1}: the base, each frame's origin, the tip [m]
  Columns<kMaxJoints> axis_W;   ///< column j is the unit axis of joint j
  Columns<kMaxJoints> pivot_W;  ///< column j is a point on the axis of joint j [m]
  Angles sine, cosine;          ///< of the joint angles, offsets included; else they mean nothing

  Eigen::Vector3d tip() const { return p_WO.rightCols<1>(); }
};

/// A chain of up to 16 joints that turn or slide. Immutable.
class SerialChain {
 public:
  /// @throws std::invalid_argument if there are no joints or more than 16, rows and placements, a
  ///   number is not finite, an orientation is no rotation, the dimension is neither 2 nor 3, or an arm
  ///   of dimension 2 has placements or leaves the plane z = 0
  explicit SerialChain(ChainDescription description);

  const ChainDescription& description() const { return description_; }
  int joints() const { return joints_; }
  int dimension() const { return description_.dimension; }  ///< rows of the tip task: 2 or 3
  int points() const { return points_; }                    ///< columns of ChainPose::p_WO
  bool in_plane() const { return in_plane_; }               ///< of dimension 2, in standard form

  /// Base to tip. The link that ends at a prismatic joint is one of them, as long as it may be.
  std::span<const Link> links() const { return links_; }

  bool is_prismatic(int joint) const { return prismatic_[static_cast<std::size_t>(joint)]; }
  bool has_prismatic_joints() const { return has_prismatic_joints_; }

  /// All end-points and joint axes for q [rad, m].
  void forward(const JointVector& q, ChainPose& pose) const;

  /// The same at less cost where the joints are close to q_from (`kSlightTurn`): `pose` is that of
  /// q_from on entry. Answers differ from those of `forward` by rounding.
  void forward_from(const JointVector& q_from, const JointVector& q, ChainPose& pose) const;

  /// Only joints 0 .. moving_joints(k) - 1 can move point k.
  int moving_joints(int point) const { return moving_joints_[static_cast<std::size_t>(point)]; }

  /// Translational Jacobian of point k: dimension() x joints() [m/rad, m/m].
  void jacobian(const ChainPose& pose, int point, TaskJacobian& J) const;

  /// Orientation of the tip frame T in W, from what turns in the pose.
  Eigen::Matrix3d tip_rotation(const ChainPose& pose) const;

  /// Bound, over all joint angles, of the distance between the axis of joint j, which turns, and
  /// point k, prismatic joints at 0 [m]; 0 if joint j cannot move the point.
  double reach(int joint, int point) const { return reach_(joint, point); }

  /// Bound of the speed of point k where joint j moves at speed 1, no prismatic joint i further from
  /// 0 than travel(i) [m/rad, m/m]: its reach with what those between may add, or 1.
  double speed_bound(int joint, int point, const JointVector& travel) const;

 private:
  void place(const JointVector& q, ChainPose& pose) const;
  void place_in_plane(ChainPose& pose) const;
  void place_by_placements(const JointVector& q, ChainPose& pose) const;

  ChainDescription description_;
  int joints_;
  int points_;
  bool in_plane_;
  bool has_prismatic_joints_ = false;
  std::array<bool, kMaxJoints> prismatic_{};
  Angles offset_{}, a_{}, d_{}, cos_alpha_{}, sin_alpha_{};
  std::vector<Link> links_;
  std::vector<int> moving_joints_;
  Eigen::MatrixXd reach_;  // joints x points
};

}  // namespace bqsa
