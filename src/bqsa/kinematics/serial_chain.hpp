/// @file
/// Forward kinematics and Jacobians of every link end-point in one pass, without allocation.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "bqsa/kinematics/chain_description.hpp"
#include "bqsa/kinematics/sine_cosine.hpp"

namespace bqsa {

inline constexpr int kMaxJoints = kMaxAngles;
inline constexpr int kMaxLinks = kMaxJoints + 1;  ///< a tool is one more link
inline constexpr int kMaxPoints = kMaxLinks + 1;
inline constexpr int kMaxTaskRows = 6;

/// One number a joint [rad, rad/s, ...]; its storage is part of the object.
using JointVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxJoints, 1>;

/// Task rows x joints; its storage is part of the object.
using TaskJacobian =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxTaskRows, kMaxJoints>;

/// A link segment between two points of the chain. Links of zero length are left out of a chain's
/// list, and the others keep their numbers.
struct Link {
  int number;  ///< the paper's i: 1-based row of the Denavit-Hartenberg table; a tool is n + 1
  int start;   ///< index of O_i in ChainPose::p_WO
  int end;     ///< index of O_{i+1}
};

/// Where everything is for one joint vector, in W.
struct ChainPose {
  template <int MaxColumns>
  using Columns = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, MaxColumns>;

  Columns<kMaxPoints>
      p_WO;  ///< column k is the paper's O_{k+1}: the base, each frame's origin, the tip [m]
  Columns<kMaxJoints> axis_W;   ///< column j is the unit axis of joint j
  Columns<kMaxJoints> pivot_W;  ///< column j is a point on the axis of joint j [m]
  Angles sine, cosine;          ///< of the joint angles, offsets included

  Eigen::Vector3d tip() const { return p_WO.rightCols<1>(); }
};

/// A chain of up to 16 revolute joints. Immutable.
class SerialChain {
 public:
  /// @throws std::invalid_argument if there are no joints or more than 16, a number is not finite,
  ///   the base orientation is no rotation, the dimension is neither 2 nor 3, or an arm of dimension 2
  ///   leaves the plane z = 0
  explicit SerialChain(ChainDescription description);

  const ChainDescription& description() const { return description_; }
  int joints() const { return joints_; }
  int dimension() const { return description_.dimension; }  ///< rows of the tip task: 2 or 3
  int points() const { return points_; }                    ///< columns of ChainPose::p_WO
  bool in_plane() const { return in_plane_; }               ///< of dimension 2, in standard form
  std::span<const Link> links() const { return links_; }    ///< base to tip

  /// All end-points and joint axes for q [rad].
  void forward(const JointVector& q, ChainPose& pose) const;

  /// The same at less cost where the joints are close to q_from (`kSlightTurn`): `pose` is that of
  /// q_from on entry. Answers differ from those of `forward` by rounding.
  void forward_from(const JointVector& q_from, const JointVector& q, ChainPose& pose) const;

  /// Only joints 0 .. moving_joints(k) - 1 can move point k.
  int moving_joints(int point) const { return moving_joints_[static_cast<std::size_t>(point)]; }

  /// Translational Jacobian of point k: dimension() x joints() [m/rad].
  void jacobian(const ChainPose& pose, int point, TaskJacobian& J) const;

  /// Bound, over all joint angles, of the distance between the axis of joint j and point k [m];
  /// 0 if joint j cannot move the point.
  double reach(int joint, int point) const { return reach_(joint, point); }

 private:
  void place(ChainPose& pose) const;
  void place_in_plane(ChainPose& pose) const;

  ChainDescription description_;
  int joints_;
  int points_;
  bool in_plane_;
  Angles offset_{}, a_{}, d_{}, cos_alpha_{}, sin_alpha_{};
  std::vector<Link> links_;
  std::vector<int> moving_joints_;
  Eigen::MatrixXd reach_;  // joints x points
};

}  // namespace bqsa
