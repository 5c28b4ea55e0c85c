/// @file
/// The judge's own kinematics: homogeneous transforms multiplied out straight from the description
/// of the chain. Shares no code with SerialChain; tests compare the two.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "bqsa/kinematics/chain_description.hpp"

namespace bqsa::harness {

/// A link of positive length between two points of the chain.
struct LinkSegment {
  int number = 0;  ///< 1-based Denavit-Hartenberg row, or joint; a tool is one more
  int start = 0;   ///< index into PointPositions::points
  int end = 0;
};

/// The chain at one joint vector, in W.
struct PointPositions {
  std::vector<Eigen::Vector3d> points;  ///< the base, each frame's origin, the tip of a tool [m]
  std::vector<Eigen::Vector3d> axes;    ///< unit axis of each joint
  std::vector<Eigen::Vector3d> pivots;  ///< a point on the axis of each joint [m]

  const Eigen::Vector3d& tip() const { return points.back(); }
};

class JudgeKinematics {
 public:
  explicit JudgeKinematics(const ChainDescription& chain);

  int joints() const { return static_cast<int>(rows_.size()); }
  int points() const { return joints() + 1 + (has_tool_ ? 1 : 0); }

  /// Base to tip; links of zero length are left out, the others keep their numbers.
  std::span<const LinkSegment> links() const { return links_; }

  /// Whether the joint slides along its axis, else it turns about it.
  bool is_prismatic(int joint) const { return rows_[static_cast<std::size_t>(joint)].prismatic; }

  /// Where everything is for joint values q [rad, m], one a joint.
  void place(const Eigen::VectorXd& q, PointPositions& positions) const;

  /// Orientation of the tip frame in W for joint values q [rad, m].
  Eigen::Matrix3d tip_rotation(const Eigen::VectorXd& q) const;

  /// Velocity of point k when the joints move at the given rates [m per unit of the rate].
  Eigen::Vector3d velocity(const PointPositions& positions, const Eigen::VectorXd& rates,
                           int point) const;

  /// Bound, over all joint angles, of the distance between point k and the axis of joint j, prismatic
  /// joints at 0 [m].
  double reach(int joint, int point) const { return reach_(joint, point); }

  /// Bound of |dP/dq_j| of point k [m/rad, m/m] while no prismatic joint i is further from 0 than
  /// travel(i) [m]: 1 for one that slides; for one that turns its reach, and for each prismatic joint
  /// in between, which may take the point that much further from the axis, its travel.
  double speed_bound(int joint, int point, const Eigen::VectorXd& travel) const;

 private:
  /// A row or placement as fixed transforms before and after the joint's motion about or along z.
  struct Row {
    Eigen::Matrix4d before;
    Eigen::Matrix4d after;
    double offset;
    bool prismatic = false;
  };

  static Eigen::Matrix4d moved(const Row& row, double q);

  std::vector<Row> rows_;
  Eigen::Matrix4d base_;
  Eigen::Vector4d tool_;
  Eigen::Matrix3d tool_rotation_;
  bool has_tool_;
  std::vector<LinkSegment> links_;
  Eigen::MatrixXd reach_;  // joints x points
};

}  // namespace bqsa::harness
