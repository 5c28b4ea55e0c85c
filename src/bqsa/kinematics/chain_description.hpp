/// @file
/// A serial arm as plain data: what a scenario file says and what every kinematics is built from.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <vector>

namespace bqsa {

/// One joint in Denavit-Hartenberg parameters. The joint turns by its angle plus `offset`.
struct DhRow {
  double a = 0;       ///< length along x [m]
  double alpha = 0;   ///< twist about x [rad]
  double d = 0;       ///< length along z [m]
  double offset = 0;  ///< joint angle at theta = 0 [rad]
};

enum class DhConvention {
  kStandard,  ///< a row is Rz(theta + offset) Tz(d) Tx(a) Rx(alpha)
  kModified,  ///< Craig: a row is Rx(alpha) Tx(a) Rz(theta + offset) Tz(d), alpha and a of the row
              ///< itself
};

enum class JointType {
  kRevolute,   ///< turns about z of its frame [rad]
  kPrismatic,  ///< slides along z of its frame [m]
};

/// A joint's frame J in that of the joint before, P, or in the base: the joint moves by its z.
/// Unlike a Denavit-Hartenberg row it can hold any axis with any origin on it, so that axes that are
/// parallel but for 1e-6 rad, as URDF files have them, need no common normal.
struct JointPlacement {
  Eigen::Matrix3d R_PJ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p_PJ = Eigen::Vector3d::Zero();  ///< [m]
  JointType type = JointType::kRevolute;
};

/// A chain of joints, base to tip, by either `rows`, which turn, or `placements`. Frame i is that
/// after row i or that of joint i once it has moved, and link i ends in its origin. So the link that
/// ends in the frame of a prismatic joint changes its length with the joint.
struct ChainDescription {
  int dimension = 3;  ///< 2: the arm moves in the plane z = 0 and its task is (x, y); 3: (x, y, z)
  DhConvention convention = DhConvention::kStandard;
  std::vector<DhRow> rows;                             ///< one a joint
  std::vector<JointPlacement> placements;              ///< one a joint
  Eigen::Matrix3d R_WB = Eigen::Matrix3d::Identity();  ///< orientation of the base in W
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();      ///< position of the base in W [m]
  Eigen::Vector3d p_LT = Eigen::Vector3d::Zero();  ///< tip in the last frame L [m]; zero: no tool
  Eigen::Matrix3d R_LT = Eigen::Matrix3d::Identity();  ///< orientation of the tip frame T in L

  int joints() const { return static_cast<int>(rows.size() + placements.size()); }
  bool is_placed() const { return !placements.empty(); }

  bool is_prismatic(int joint) const {
    return is_placed() && placements[static_cast<std::size_t>(joint)].type == JointType::kPrismatic;
  }

  /// Length of the link that ends in the origin of frame j + 1, a prismatic joint j at 0 [m].
  double link_length(int j) const {
    const auto i = static_cast<std::size_t>(j);
    return is_placed() ? placements[i].p_PJ.norm() : std::hypot(rows[i].a, rows[i].d);
  }

  /// Whether joint i, if it turns, leaves the origin of frame i, which is on its axis, at rest.
  bool turns_about_own_origin() const {
    return is_placed() || convention == DhConvention::kModified;
  }
};

/// A planar arm: joint angles relative to the previous link, link i along its own x axis [m].
inline ChainDescription planar_chain(const std::vector<double>& link_lengths,
                                     const Eigen::Vector2d& base = Eigen::Vector2d::Zero()) {
  ChainDescription chain;
  chain.dimension = 2;
  for (const double length : link_lengths) chain.rows.push_back({.a = length});
  chain.p_WB << base, 0;
  return chain;
}

}  // namespace bqsa
