/// @file
/// The judge's own exact distance between a segment and a solid ellipsoid. Shares no code with
/// src/bqsa.
#pragma once

#include <Eigen/Core>

#include "bqsa/geometry/ellipsoid.hpp"

namespace bqsa::harness {

/// Result of a segment-ellipsoid distance query; lengths in metres.
struct SegmentDistance {
  double distance = 0;  ///< 0 if they meet
  /// If they meet: an upper bound of the shortest translation that separates them, exact to first
  /// order for shallow penetrations; else 0.
  double depth = 0;
  double t = 0;  ///< parameter of the closest (or deepest) point of the segment
  Eigen::Vector3d on_segment = Eigen::Vector3d::Zero();
  Eigen::Vector3d on_ellipsoid = Eigen::Vector3d::Zero();
  /// Unit normal of a plane that proves the result: over the segment, normal . (x - centre) exceeds
  /// its largest value over the ellipsoid by clearance(), to rounding.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();

  /// Signed: distance, or minus depth.
  double clearance() const { return distance > 0 ? distance : -depth; }
};

/// Distance between the segment from a to b and the solid ellipsoid, to 1e-12 relative to the
/// problem's size. Uses only centre, semi-axes and rotation of the ellipsoid.
SegmentDistance exact_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                               const Ellipsoid& ellipsoid);

}  // namespace bqsa::harness
