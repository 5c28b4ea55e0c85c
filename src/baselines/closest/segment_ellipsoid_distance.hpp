/// @file
/// Exact distance of a segment to a solid ellipsoid: the closest point that needs no test points.
#pragma once

#include <Eigen/Core>

#include "bqsa/geometry/ellipsoid.hpp"

namespace bqsa::baselines {

/// The closest points of a segment and a solid ellipsoid. If they meet, `distance` is 0, `s` is the
/// segment's point deepest inside in the ellipsoid's own metric, both points are that point, and
/// `direction` is the outward normal of the level surface there.
struct SegmentDistance {
  double distance = 0;                                    ///< [m]
  double s = 0;                                           ///< on the segment: 0 at a, 1 at b
  Eigen::Vector3d p_segment = Eigen::Vector3d::Zero();    ///< in W [m]
  Eigen::Vector3d p_ellipsoid = Eigen::Vector3d::Zero();  ///< in W [m]
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();    ///< unit, from ellipsoid to segment
};

/// Distance of the segment from a to b [m, W], which may have zero length. The squared distance is
/// convex along the segment; its minimum is found by a bracketed search on the derivative, with the
/// point's closest point on the surface from the secular equation. Does not allocate.
SegmentDistance segment_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                 const Ellipsoid& shape);

}  // namespace bqsa::baselines
