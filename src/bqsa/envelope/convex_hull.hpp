/// @file
/// The convex hull of points in space, with nothing left to rounding.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <utility>
#include <vector>

namespace bqsa {

/// A convex solid by its corners; flat (a polygon, a segment, a point) if `span` is below 3.
struct ConvexHull {
  std::vector<Eigen::Vector3d> vertices;  ///< of the given points [m]

  /// Counterclockwise as seen from outside; of a polygon, one side of it.
  std::vector<std::array<int, 3>> triangles;

  /// Pairs of vertices, the smaller number first. All edges are here, and lines across faces too.
  std::vector<std::pair<int, int>> edges;

  int span = 0;  ///< dimensions that the points span on the grid of `convex_hull`, 0 to 3

  /// Each given point is this near to the hull of `vertices`, or within it [m].
  double deviation = 0;
};

/// Quickhull (Barber, Dobkin and Huhdanpaa) on a grid of 2^40 cells along the longest extent, where
/// each decision is one of whole numbers and exact, so that points on a face, on an edge or twice
/// in the same place do no harm. A point moves by at most 0.51 cells along each axis when it is put
/// on the grid, the hull's deviation is twice that: at most 4e-12 of the longest extent.
/// @throws std::invalid_argument if there is no point, or one is not finite or has a coordinate
///   beyond 1e50 m
ConvexHull convex_hull(std::span<const Eigen::Vector3d> points);

/// Volume of the hull [m³].
double volume(const ConvexHull& hull);

/// The two parts of the hull on both sides of the plane normal·p = offset, as points of which they
/// are the hulls: corners of the hull and the points where the plane cuts its edges, which belong
/// to both. The first part is where normal·p is less.
std::array<std::vector<Eigen::Vector3d>, 2> cut(const ConvexHull& hull,
                                                const Eigen::Vector3d& normal, double offset);

}  // namespace bqsa
