/// @file
/// Ellipsoids that are larger by a distance, proven.
#pragma once

#include "bqsa/geometry/ellipsoid.hpp"

namespace bqsa {

/// An ellipsoid that contains every point within `distance` [m] of the shape, with the same centre
/// and axes. (Longer semi-axes by the distance alone would not do: that ellipsoid lies inside.)
///
/// With q > 0 the ellipsoid of the semi-axes sqrt((1 + 1/q) a² + (1 + q) distance²) does, for any q
/// (Kurzhanski and Valyi); taken is the q whose axes have the least sum. For a ball that is exact.
/// For thin shapes it is generous: 10 mm around a sheet with the semi-axes 0.1 mm, 0.1 m and 10 m
/// gives 85 mm, 0.13 m and 10.07 m.
/// @throws std::invalid_argument if the distance is negative or not finite
template <int Dim>
EllipsoidN<Dim> ellipsoid_around(const EllipsoidN<Dim>& shape, double distance);

/// How far ellipsoid_around(shape, distance) reaches beyond the points within `distance` of the
/// shape [m], at most.
///
/// Support functions tell: in a direction in which the shape reaches s, the ellipsoid around it
/// reaches sqrt((1 + 1/q) s² + (1 + q) distance²), which less s + distance is convex in s and so
/// greatest for the shortest or the longest semi-axis.
/// @throws std::invalid_argument if the distance is negative or not finite
template <int Dim>
double largest_excess_around(const EllipsoidN<Dim>& shape, double distance);

}  // namespace bqsa
