/// @file
/// How near a segment comes to a convex solid.
#pragma once

#include <Eigen/Core>

namespace bqsa::harness {

/// Distance of a segment from a convex solid, with a plane that proves it.
struct SolidClearance {
  /// The distance, to 1e-12 relative to the problem's size. If they meet: minus an upper bound of
  /// the shortest translation that separates them, exact to first order for shallow penetrations
  /// (but of a few in ten thousand across the rim of a cylinder) [m].
  double clearance = 0;

  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< of the plane, unit

  /// The solid lies in normal . x <= offset, the segment in normal . x >= offset + clearance, to
  /// rounding [m].
  double offset = 0;
};

}  // namespace bqsa::harness
