#include "harness/judge/exact_polytope.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "harness/judge/segment_pair.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;

/// Triangles less high than this part of the polytope's size have no normal to speak of, and
/// corners this near to a plane may be on either side.
constexpr double kThin = 1e-10;

/// Sides of a unit cube whose corner k is on the upper side along axis i where k has the bit i.
constexpr std::array<std::array<int, 3>, 12> kBoxTriangles = {{{0, 2, 1},
                                                               {1, 2, 3},
                                                               {4, 5, 6},
                                                               {5, 7, 6},
                                                               {0, 1, 4},
                                                               {1, 5, 4},
                                                               {2, 6, 3},
                                                               {3, 6, 7},
                                                               {0, 4, 2},
                                                               {2, 4, 6},
                                                               {1, 3, 5},
                                                               {3, 7, 5}}};

/// Normal of the triangle and, as its length, twice the area; from the corner between the two
/// shorter sides, which loses least.
Vector3d area_normal(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double ab = (b - a).squaredNorm(), bc = (c - b).squaredNorm(), ca = (a - c).squaredNorm();
  if (ab >= bc && ab >= ca) return (a - c).cross(b - c);
  if (bc >= ca) return (b - a).cross(c - a);
  return (c - b).cross(a - b);
}

double longest_side(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  return std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
}

}  // namespace

/// The best plane so far.
struct ExactPolytope::Separation {
  double clearance = -std::numeric_limits<double>::infinity();
  Vector3d normal = Vector3d::UnitX();
  double offset = 0;

  void offer(double other, const Vector3d& n, double at) {
    if (!(other > clearance)) return;
    clearance = other;
    normal = n;
    offset = at;
  }
};

ExactPolytope::ExactPolytope(const Box& box) {
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vector3d signs((corner & 1U) != 0 ? 1 : -1, (corner & 2U) != 0 ? 1 : -1,
                         (corner & 4U) != 0 ? 1 : -1);
    corners_.emplace_back(box.center + box.rotation * box.half_lengths.cwiseProduct(signs));
  }
  build({kBoxTriangles.begin(), kBoxTriangles.end()}, false);
}

ExactPolytope::ExactPolytope(const ConvexHull& hull) : corners_(hull.vertices) {
  if (hull.span < 2) throw std::invalid_argument("polytope: expected points that span a plane");
  build(hull.triangles, hull.span == 2);
}

void ExactPolytope::build(const std::vector<std::array<int, 3>>& triangles, bool flat) {
  for (const Vector3d& p : corners_) size_ = std::max(size_, (p - corners_.front()).norm());
  std::map<std::pair<int, int>, std::array<int, 2>> edges;
  const auto add_face = [&](const std::array<int, 3>& corners) {
    const Vector3d& a = corner(corners[0]);
    const Vector3d& b = corner(corners[1]);
    const Vector3d& c = corner(corners[2]);
    const Vector3d normal = area_normal(a, b, c);
    if (!(normal.norm() > kThin * size_ * longest_side(a, b, c))) return;
    const Vector3d unit = normal.normalized();
    faces_.push_back({corners, unit, support(unit)});
  };
  for (const std::array<int, 3>& triangle : triangles) {
    add_face(triangle);
    if (flat) add_face({triangle[0], triangle[2], triangle[1]});
    for (std::size_t k = 0; k < 3; ++k) {
      const auto ends = std::minmax(triangle[k], triangle[(k + 1) % 3]);
      const int opposite = triangle[(k + 2) % 3];
      const auto [known, is_new] =
          edges.try_emplace({ends.first, ends.second}, std::array<int, 2>{opposite, opposite});
      if (!is_new) known->second[1] = opposite;
    }
  }
  if (faces_.empty()) throw std::invalid_argument("polytope: expected points that span a plane");
  for (const auto& [ends, opposite] : edges) {
    edges_.push_back({ends.first, ends.second, opposite});
    if (!flat || opposite[0] != opposite[1]) continue;
    const Vector3d along = corner(ends.second) - corner(ends.first);
    const Vector3d across = along.cross(faces_.front().normal);
    if (!(across.norm() > kThin * size_)) continue;
    const bool inward = across.dot(corner(opposite[0]) - corner(ends.first)) > 0;
    const Vector3d outward = (inward ? -1 : 1) * across.normalized();
    sides_.push_back({{ends.first, ends.second, ends.first}, outward, support(outward)});
  }
}

double ExactPolytope::support(const Vector3d& normal) const {
  double highest = -std::numeric_limits<double>::infinity();
  for (const Vector3d& p : corners_) highest = std::max(highest, normal.dot(p));
  return highest;
}

/// Planes along an edge and the segment that have the polytope on one side.
void ExactPolytope::try_edges(const Vector3d& a, const Vector3d& b, Separation& best) const {
  const Vector3d along = b - a;
  const double slack = kThin * size_;
  for (const Edge& edge : edges_) {
    const Vector3d& from = corner(edge.from);
    Vector3d normal = (corner(edge.to) - from).cross(along);
    const double length = normal.norm();
    if (!(length > 0)) continue;
    normal /= length;
    const double u = normal.dot(corner(edge.opposite[0]) - from);
    const double v = normal.dot(corner(edge.opposite[1]) - from);
    for (const double side : {1.0, -1.0}) {
      if (side * u > slack || side * v > slack) continue;
      const Vector3d n = side * normal;
      const double lowest = std::min(n.dot(a), n.dot(b));
      if (!(lowest - n.dot(from) > best.clearance)) continue;
      const double highest = support(n);
      best.offer(lowest - highest, n, highest);
    }
  }
}

/// Of a segment that a plane is known to separate from the polytope. The nearest points of the two
/// are on an edge and anywhere on the segment, or in a face and at an end of the segment. A face
/// that the segment is wholly below has no nearest point that its neighbours lack.
SolidClearance ExactPolytope::distance(const Vector3d& a, const Vector3d& b,
                                       const Separation& proven) const {
  double least = std::numeric_limits<double>::infinity();
  Vector3d apart = proven.normal;
  const auto offer = [&](const Vector3d& on_segment, const Vector3d& on_polytope) {
    const Vector3d way = on_segment - on_polytope;
    const double length = way.norm();
    if (length >= least) return;
    least = length;
    apart = way;
  };
  for (const Face& face : faces_) {
    const double height_a = face.normal.dot(a) - face.offset;
    const double height_b = face.normal.dot(b) - face.offset;
    if (std::max(height_a, height_b) < -kThin * size_) continue;
    if (std::min(height_a, height_b) >= least) continue;
    const std::array<Vector3d, 3> p = {corner(face.corners[0]), corner(face.corners[1]),
                                       corner(face.corners[2])};
    for (std::size_t k = 0; k < 3; ++k) {
      const PointPair pair = nearest_points(a, b, p[k], p[(k + 1) % 3]);
      offer(pair.on_first, pair.on_second);
    }
    for (const Vector3d& end : {a, b}) {
      const auto inside = [&](std::size_t k) {
        return face.normal.cross(p[(k + 1) % 3] - p[k]).dot(end - p[k]) >= 0;
      };
      if (inside(0) && inside(1) && inside(2)) {
        offer(end, end - face.normal.dot(end - p[0]) * face.normal);
      }
    }
  }
  Separation best = proven;
  if (least > 0) {
    const Vector3d normal = apart / least;
    const double highest = support(normal);
    best.offer(std::min(normal.dot(a), normal.dot(b)) - highest, normal, highest);
  }
  return {least, best.normal, best.offset};
}

SolidClearance ExactPolytope::clearance(const Vector3d& a, const Vector3d& b) const {
  Separation best;
  for (const std::vector<Face>* planes : {&faces_, &sides_}) {
    for (const Face& face : *planes) {
      best.offer(std::min(face.normal.dot(a), face.normal.dot(b)) - face.offset, face.normal,
                 face.offset);
    }
  }
  try_edges(a, b, best);
  if (!sides_.empty()) {  // flat: the segment may lie in the plane, and the polygon beside its line
    const Vector3d beside = (b - a).cross(faces_.front().normal);
    if (beside.norm() > 0) {
      for (const Vector3d& n : {Vector3d(beside.normalized()), Vector3d(-beside.normalized())}) {
        const double highest = support(n);
        best.offer(std::min(n.dot(a), n.dot(b)) - highest, n, highest);
      }
    }
  }
  if (best.clearance > 0) return distance(a, b, best);
  return {best.clearance, best.normal, best.offset};
}

}  // namespace bqsa::harness
