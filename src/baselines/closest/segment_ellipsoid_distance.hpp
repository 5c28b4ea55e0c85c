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

/// Distance of the segment from a to b [m, W], which may have zero length.
///
/// Solves the dual problem, one concave function of one number. In the ellipsoid's axes, with
/// A = diag(a_i²) and x(t) = p + t d, every multiplier l >= 0 bounds the squared distance from below,
///
///     distance² >= l (G(l) - 1),   G(l) = min over t in [0, 1] of x(t)ᵀ (A + l)⁻¹ x(t),
///
/// and the best l attains it. The minimising t is a quotient of sums, and the slope of the bound,
/// S(l) - 1 with S(l) = sum a_i² x_i² / (a_i² + l)², is the secular equation of the point x(t): zero
/// where x - l (A + l)⁻¹ x lies on the surface. At l = 0 it is the level of the deepest point, so the
/// first evaluation decides whether they meet. Newton's method on S^(-1/2), which is nearly linear,
/// needs about five steps; a bracket catches it where t enters or leaves the ends.
///
/// Errors are of the rounding of the coordinates in the ellipsoid's axes. Does not allocate.
SegmentDistance segment_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                 const Ellipsoid& shape);

}  // namespace bqsa::baselines
