/// @file
/// How far rounding can move the polar form: which of its answers are certain in double precision.
///
/// With eps = 2^-53 and w = p - c, the computed u = T w differs from the exact one by at most
///
///     e = 6 eps |T|_F |w|        (w: 1 eps; T, rounded once from extended precision: 1 + 0.1 eps;
///                                 products and sums of at most three terms: 3 eps)
///
/// so that |S_ij - exact| <= |u_i| e_j + |u_j| e_i + e_i e_j + 4 eps (|u_i| |u_j| + 1), and the sign of
/// S12² - S11 S22 is certain when its size exceeds
///
///     2 |S12| d12 + d12² + |S11| d22 + |S22| d11 + d11 d22 + eps (S12² + |S11 S22|).
///
/// "Exact" means the ellipsoid that the stored semi-axes and rotation describe. Outside the band the
/// category is right; inside it the link touches to within rounding. For a link as long as the
/// obstacle the band is about 1e-15 semi-axes wide; it widens with the square of the distance of the
/// end-points, measured in the semi-axis that the link grazes.
#pragma once

#include <cmath>
#include <limits>

#include "bqsa/geometry/segment_test.hpp"

namespace bqsa {

/// Bounds on the rounding error of each part of a polar form, dimensionless.
struct PolarRounding {
  double s11, s12, s22, discriminant;
};

template <int Dim>
PolarRounding polar_rounding(const EllipsoidN<Dim>& ellipsoid,
                             const Eigen::Matrix<double, Dim, 1>& p1,
                             const Eigen::Matrix<double, Dim, 1>& p2) {
  constexpr double eps = std::numeric_limits<double>::epsilon() / 2;
  constexpr double second_order = 1.01;  // the bounds are evaluated on rounded values
  const double norm_T = ellipsoid.unit_map().norm();
  const double e1 = 6 * eps * norm_T * (p1 - ellipsoid.center()).norm();
  const double e2 = 6 * eps * norm_T * (p2 - ellipsoid.center()).norm();
  const double u1 = unit_point(ellipsoid, p1).norm();
  const double u2 = unit_point(ellipsoid, p2).norm();
  const auto bound = [&](double ua, double ea, double ub, double eb) {
    return second_order * (ua * eb + ub * ea + ea * eb + 4 * eps * (ua * ub + 1));
  };
  PolarRounding d{bound(u1, e1, u1, e1), bound(u1, e1, u2, e2), bound(u2, e2, u2, e2), 0};
  const PolarForm<double> f = polar_form(ellipsoid, p1, p2);
  d.discriminant = second_order * (2 * std::abs(f.s12) * d.s12 + d.s12 * d.s12 +
                                   std::abs(f.s11) * d.s22 + std::abs(f.s22) * d.s11 +
                                   d.s11 * d.s22 + eps * (f.s12 * f.s12 + std::abs(f.s11 * f.s22)));
  return d;
}

/// Whether rounding can have changed the category of `f`.
inline bool is_certain(const PolarForm<double>& f, const PolarRounding& d) {
  if (std::abs(f.s11) <= d.s11 || std::abs(f.s22) <= d.s22) return false;
  if (f.s11 < 0 || f.s22 < 0) return true;
  return std::abs(f.s12 * f.s12 - f.s11 * f.s22) > d.discriminant;
}

}  // namespace bqsa
