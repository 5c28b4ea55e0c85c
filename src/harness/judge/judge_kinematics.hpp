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
  int number = 0;  ///< 1-based Denavit-Hartenberg row; a tool is one more
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

  /// Where everything is for joint angles q [rad], one a joint.
  void place(const Eigen::VectorXd& q, PointPositions& positions) const;

  /// Velocity of point k when the joints turn at the given rates [m per unit of the rate].
  Eigen::Vector3d velocity(const PointPositions& positions, const Eigen::VectorXd& rates,
                           int point) const;

  /// Bound, over all joint angles, of the distance between point k and the axis of joint j [m].
  double reach(int joint, int point) const { return reach_(joint, point); }

 private:
  /// A row of the table as fixed transforms before and after the joint's turn about z.
  struct Row {
    Eigen::Matrix4d before;
    Eigen::Matrix4d after;
    double offset;
  };

  std::vector<Row> rows_;
  Eigen::Matrix4d base_;
  Eigen::Vector4d tool_;
  bool has_tool_;
  std::vector<LinkSegment> links_;
  Eigen::MatrixXd reach_;  // joints x points
};

}  // namespace bqsa::harness
