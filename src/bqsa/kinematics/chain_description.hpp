/// @file
/// A serial arm as plain data: what a scenario file says and what every kinematics is built from.
#pragma once

#include <Eigen/Core>
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

/// A chain of revolute joints, base to tip.
struct ChainDescription {
  int dimension = 3;  ///< 2: the arm moves in the plane z = 0 and its task is (x, y); 3: (x, y, z)
  DhConvention convention = DhConvention::kStandard;
  std::vector<DhRow> rows;                             ///< one a joint
  Eigen::Matrix3d R_WB = Eigen::Matrix3d::Identity();  ///< orientation of the base in W
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();      ///< position of the base in W [m]
  Eigen::Vector3d p_LT = Eigen::Vector3d::Zero();  ///< tip in the last frame L [m]; zero: no tool
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
