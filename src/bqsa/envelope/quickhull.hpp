/// @file
/// The convex hull of points on a grid, in whole numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace bqsa {

/// Coordinates of the grid are at most 2^40: with artificial points differences are at most 2^41,
/// those of two products 2^83 and heights 3 * 2^124, which fits into 127 bits.
inline constexpr int kGridBits = 40;

using Cell = std::array<std::int64_t, 3>;

/// A triangle of the hull: numbers of points, counterclockwise from outside.
using HullTriangle = std::array<int, 3>;

/// Triangles of a closed surface.
struct GridHull {
  std::vector<HullTriangle> triangles;

  /// Dimensions that the points span. Of flat ones (below 3) the hull is that of them and 3 - span
  /// artificial points beyond the grid, with numbers from the count of the points on.
  int span;
};

/// Quickhull (Barber, Dobkin and Huhdanpaa 1996): from a tetrahedron on, the point furthest above a
/// face replaces all faces that it is above. "Above" is strict and exact, so that the faces seen
/// from a point always hang together. Of points on a face or an edge some may be corners.
/// @param points  at least one, coordinates from 0 to 2^40
GridHull grid_hull(const std::vector<Cell>& points);

}  // namespace bqsa
