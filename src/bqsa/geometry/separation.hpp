/// @file
/// A proven distance between link and obstacle, from the quadratic and without a further search.
#pragma once

#include <Eigen/Core>

#include "bqsa/geometry/segment_test.hpp"

namespace bqsa {

/// Lower bound of the distance between the segment from p1 to p2 and the solid ellipsoid [m]; not
/// positive exactly if they meet.
///
/// With u the vertex (`vertex`, segment_test.hpp) in unit coordinates, the plane that supports the
/// ellipsoid at u/|u| has the normal n = Tᵀu, and the whole segment lies beyond it:
///
///     nᵀ(P - c) >= u·u on the segment,   max nᵀ(P - c) = |u| on the ellipsoid,
///
/// so that they are at least |u| (|u| - 1) / |Tᵀu| apart; a capsule of radius r around the segment is
/// free if the bound exceeds r. Exact for a sphere, and to first order in a distance that is small
/// against the radius of curvature. Further away from a thin shape it can be far too small: 100 mm beside
/// the edge of a sheet with the semi-axes 0.1 mm, 100 mm and 10 m it may say 5 mm.
template <int Dim>
double separation(const EllipsoidN<Dim>& ellipsoid, const Eigen::Matrix<double, Dim, 1>& p1,
                  const Eigen::Matrix<double, Dim, 1>& p2) {
  using Vector = Eigen::Matrix<double, Dim, 1>;
  const Vector u1 = unit_point(ellipsoid, p1);
  const Vector u2 = unit_point(ellipsoid, p2);
  const double t = vertex(polar_form<double, Dim>(u1, u2));
  const Vector u = u1 + t * (u2 - u1);
  const double level = u.norm();
  if (!(level > 0)) return -ellipsoid.semi_axes().minCoeff();
  const Vector normal = ellipsoid.unit_map().transpose() * u;
  return level * (level - 1) / normal.norm();
}

}  // namespace bqsa
