/// @file
/// A frame for solids of revolution.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace bqsa {

/// A rotation whose third column is along a vector; any for the zero vector.
inline Eigen::Matrix3d frame_along(const Eigen::Vector3d& direction) {
  const Eigen::Vector3d z =
      direction.norm() > 0 ? direction.normalized() : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d x = z.unitOrthogonal();
  Eigen::Matrix3d frame;
  frame << x, z.cross(x), z;
  return frame;
}

}  // namespace bqsa
