/// @file
/// The judge's own exact distance between a segment and a convex polytope.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "bqsa/envelope/solid.hpp"
#include "harness/judge/solid_clearance.hpp"

namespace bqsa::harness {

/// A box or a convex hull, the solid of it, taken apart into corners, planes and edges. A flat hull
/// has two sides.
///
/// Whether a segment meets it is decided by separating planes: one of the polytope's faces, or one
/// along an edge and the segment. All that come into question are tried, each at its highest corner, so
/// that no plane claims more than it proves, whatever rounding did to its normal. Triangles so thin
/// that their normal means nothing are left out: what they cover, their neighbours cover to
/// rounding.
class ExactPolytope {
 public:
  explicit ExactPolytope(const Box& box);

  /// Uses only corners, triangles and span.
  /// @throws std::invalid_argument if the hull spans no plane
  explicit ExactPolytope(const ConvexHull& hull);

  /// Of the segment from a to b.
  SolidClearance clearance(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;

 private:
  struct Face {
    std::array<int, 3> corners;
    Eigen::Vector3d normal;
    double offset;  // of the highest corner along the normal
  };
  /// The corners opposite, in the triangles on both sides; of a flat hull's rim twice the same.
  struct Edge {
    int from, to;
    std::array<int, 2> opposite;
  };
  struct Separation;

  void build(const std::vector<std::array<int, 3>>& triangles, bool flat);
  const Eigen::Vector3d& corner(int number) const {
    return corners_[static_cast<std::size_t>(number)];
  }
  double support(const Eigen::Vector3d& normal) const;
  void try_edges(const Eigen::Vector3d& a, const Eigen::Vector3d& b, Separation& best) const;
  SolidClearance distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                          const Separation& proven) const;

  std::vector<Eigen::Vector3d> corners_;
  double size_ = 0;          // the longest distance from the first corner
  std::vector<Face> faces_;  // triangles
  std::vector<Face> sides_;  // planes through the rim of a flat hull, across it
  std::vector<Edge> edges_;
};

}  // namespace bqsa::harness
