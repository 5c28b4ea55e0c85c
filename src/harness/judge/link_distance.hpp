/// @file
/// The judge's own exact distance between two segments.
#pragma once

#include <Eigen/Core>

namespace bqsa::harness {

/// The closest points of two segments, at p + s (q - p) of either.
struct LinkDistance {
  double distance = 0;  ///< [m]
  double s = 0;         ///< parameter of the point of the first
  double t = 0;         ///< of the second
  Eigen::Vector3d on_first = Eigen::Vector3d::Zero();
  Eigen::Vector3d on_second = Eigen::Vector3d::Zero();

  /// Unit normal from the first to the second: between the two supporting planes with it lies
  /// `distance`, to rounding. Any direction if they meet.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
};

/// Distance between the segments a and b, to a few ulp of the lengths and coordinates, parallel ones
/// and points included. The candidates are those of Ericson (Real-Time Collision Detection, 5.1.9):
/// the common perpendicular where it meets both, and each end against the other segment. That
/// perpendicular is found by the cross product of the directions: of nearly parallel ones its place is
/// uncertain by the rounding over their angle, and not over the angle's square as by the usual
/// determinant, so that the distance is not.
LinkDistance link_distance(const Eigen::Vector3d& a_start, const Eigen::Vector3d& a_end,
                           const Eigen::Vector3d& b_start, const Eigen::Vector3d& b_end);

}  // namespace bqsa::harness
