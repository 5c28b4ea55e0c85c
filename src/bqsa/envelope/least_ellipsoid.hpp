/// @file
/// The ellipsoid of least volume around points (in the plane: the ellipse of least area), with a
/// proof of both: that it contains them, and that there is none much smaller.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "bqsa/geometry/ellipsoid.hpp"

namespace bqsa {

struct LeastEllipsoidSettings {
  double volume_gap = 1e-6;  ///< aimed at: volume over the least possible volume, less one [-]

  /// No semi-axis comes out shorter [m]. At 0, points that lie in a plane or on a line are refused:
  /// around them is no ellipsoid of least volume, and how thick they are is not for this function
  /// to invent.
  double least_semi_axis = 0;
};

/// A point with a share in the proof that no ellipsoid is much smaller.
struct Contact {
  std::size_t point;  ///< index
  double weight;      ///< positive; all together 1
};

template <int Dim>
struct LeastEllipsoid {
  EllipsoidN<Dim> shape;

  /// Dimensions that the points span: Dim, or less for points of a flat (a plane, a line, a point).
  int span = Dim;

  /// Proven by the contacts: the product of the `span` longest semi-axes is at most 1 + volume_gap
  /// times that of any other ellipsoid around the points (of a flat: around them within the flat).
  /// It exceeds the gap aimed at if the least semi-axis asked for it, or if rounding ended the
  /// search.
  double volume_gap = 0;

  std::vector<Contact> contacts = {};
};

/// Search. Over weights u of the points, on a core of few of them (core_search.hpp). With c = sum
/// u_i p_i and S = sum u_i (p_i - c)(p_i - c)ᵀ, the ellipsoid is {(p - c)ᵀ S⁻¹ (p - c) <= d}
/// (Khachiyan 1996).
///
/// No ellipsoid is much smaller. If {p : |A p - b| <= 1} contains the points, then 1 >= sum u_i
/// |A p_i - b|² >= tr(A S Aᵀ) >= d det(A S Aᵀ)^(1/d), the last for the means of the d eigenvalues,
/// so that the product of its semi-axes 1 / |det A| is at least d^(d/2) sqrt(det S). The gap
/// compares the answer with this bound, which is evaluated in extended precision from the given
/// points.
///
/// It contains the points. With T its stored unit map and w = p - c, the computed |T w| differs
/// from that of exact arithmetic by at most e of rounding.hpp. All semi-axes are multiplied by the
/// largest |T w| + 2 e (if that exceeds 1) and 16 roundings. Once e makes each point lie inside in
/// exact arithmetic, "exact" as in rounding.hpp; the second e makes `shape.level(p) <= 0` true as
/// computed, too.
///
/// Flat points. A direction counts as missing if the points extend along it by less than 1e-8 of
/// the longest distance between them or 1e-4 of the least semi-axis: the ellipsoid is then the
/// least one within the flat, with the least semi-axis across it. A set that is thin but not flat
/// gets its own least ellipsoid, with short semi-axes grown to the least one.
///
/// Takes about 20 passes over the points, and memory for one more copy of them.
///
/// @throws std::invalid_argument if there is no point, one is not finite or has a coordinate beyond
///   1e50 m, if points are flat (below 1e-50 m all are) and no least semi-axis is given, or if a
///   setting is no positive number
template <int Dim>
LeastEllipsoid<Dim> least_ellipsoid(std::span<const Eigen::Matrix<double, Dim, 1>> points,
                                    const LeastEllipsoidSettings& settings = {});

/// d^(d/2) sqrt(det S) of the comment above for d = `span` and the points that `contacts` names: no
/// ellipsoid around them has a smaller product of semi-axes [m^span]. Of flat points (span < Dim),
/// S is that of their shadow on the first `span` columns of `directions`.
template <int Dim>
double least_axis_product(std::span<const Eigen::Matrix<double, Dim, 1>> points,
                          std::span<const Contact> contacts, int span = Dim,
                          const Eigen::Matrix<double, Dim, Dim>& directions =
                              Eigen::Matrix<double, Dim, Dim>::Identity());

}  // namespace bqsa
