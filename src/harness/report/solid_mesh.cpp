#include "harness/report/solid_mesh.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <variant>

#include "bqsa/envelope/overloaded.hpp"

namespace bqsa::harness::report {
namespace {

using Eigen::Vector3d;

constexpr int kAround = 32;  // corners of a circle
constexpr int kUpwards = 6;  // from the rim of a half ball to its pole

/// A circle of a surface of revolution.
struct Ring {
  double height;  ///< along the axis [m]
  double radius;  ///< may be 0 at both ends of the axis [m]
};

/// The surface through rings from below to above, whose first and last are points.
SolidMesh revolved(const Vector3d& base, const Vector3d& axis, const std::vector<Ring>& rings) {
  const Vector3d u = axis.unitOrthogonal(), v = axis.cross(u);
  SolidMesh mesh;
  for (const Ring& ring : rings) {
    for (int k = 0; k < kAround; ++k) {
      const double angle = 2 * std::numbers::pi * k / kAround;
      mesh.vertices.emplace_back(base + ring.height * axis +
                                 ring.radius * (std::cos(angle) * u + std::sin(angle) * v));
    }
  }
  for (int ring = 0; ring + 1 < static_cast<int>(rings.size()); ++ring) {
    for (int k = 0; k < kAround; ++k) {
      const int a = kAround * ring + k, b = kAround * ring + (k + 1) % kAround;
      const int c = a + kAround, d = b + kAround;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  }
  return mesh;
}

SolidMesh mesh_of_capsule(const Vector3d& a, const Vector3d& b, double radius) {
  const double length = (b - a).norm();
  const Vector3d axis = length > 0 ? Vector3d((b - a) / length) : Vector3d::UnitZ();
  std::vector<Ring> rings;
  for (int k = -kUpwards; k <= kUpwards; ++k) {
    const double angle = std::numbers::pi / 2 * k / kUpwards;
    const Ring ring{radius * std::sin(angle), radius * std::cos(angle)};
    if (k <= 0) rings.push_back(ring);
    if (k >= 0) rings.push_back({length + ring.height, ring.radius});
  }
  return revolved(a, axis, rings);
}

SolidMesh mesh_of_cylinder(const Cylinder& cylinder) {
  const double length = (cylinder.b - cylinder.a).norm();
  return revolved(cylinder.a, (cylinder.b - cylinder.a) / length,
                  {{0, 0}, {0, cylinder.radius}, {length, cylinder.radius}, {length, 0}});
}

SolidMesh mesh_of_hull(const ConvexHull& hull) { return {hull.vertices, hull.triangles}; }

SolidMesh mesh_of_box(const Box& box) {
  std::vector<Vector3d> corners;
  for (unsigned k = 0; k < 8; ++k) {
    const Vector3d signs((k & 1U) != 0 ? 1 : -1, (k & 2U) != 0 ? 1 : -1, (k & 4U) != 0 ? 1 : -1);
    corners.emplace_back(box.center + box.rotation * box.half_lengths.cwiseProduct(signs));
  }
  return mesh_of_hull(convex_hull(corners));
}

}  // namespace

SolidMesh mesh_of(const Solid& solid) {
  return std::visit(Overloaded{[](const Ball& ball) {
                                 return mesh_of_capsule(ball.center, ball.center, ball.radius);
                               },
                               [](const Box& box) { return mesh_of_box(box); },
                               [](const Cylinder& cylinder) { return mesh_of_cylinder(cylinder); },
                               [](const Capsule& capsule) {
                                 return mesh_of_capsule(capsule.a, capsule.b, capsule.radius);
                               },
                               [](const ConvexHull& hull) { return mesh_of_hull(hull); }},
                    solid);
}

}  // namespace bqsa::harness::report
