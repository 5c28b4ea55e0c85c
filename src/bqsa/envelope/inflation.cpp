#include "bqsa/envelope/inflation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <queue>

namespace bqsa {
namespace {

using Eigen::Vector3d;

constexpr int kMaxTriangles = 200'000;

/// Normals in the cone of three unit vectors.
struct Cone {
  std::array<Vector3d, 3> corners;
  double bound;  ///< no normal in it has a larger difference of support functions

  bool operator<(const Cone& other) const { return bound < other.bound; }
};

/// The cone in two, divided at its longest side.
std::array<std::array<Vector3d, 3>, 2> divided(const std::array<Vector3d, 3>& corners) {
  std::size_t longest = 0;
  double most = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const double side = (corners[(k + 1) % 3] - corners[k]).squaredNorm();
    if (side <= most) continue;
    most = side;
    longest = k;
  }
  const Vector3d& a = corners[longest];
  const Vector3d& b = corners[(longest + 1) % 3];
  const Vector3d& c = corners[(longest + 2) % 3];
  const Vector3d middle = (a + b).normalized();
  return {{{a, middle, c}, {middle, b, c}}};
}

}  // namespace

double largest_inflation(const Ellipsoid& ellipsoid, const Solid& solid, double accuracy) {
  double reached = 0;  // a difference that some normal has
  std::priority_queue<Cone> cones;
  const auto add = [&](const std::array<Vector3d, 3>& corners) {
    const Vector3d middle = (corners[0] + corners[1] + corners[2]).normalized();
    const Vector3d v = support_point(solid, middle);
    const auto g = [&](const Vector3d& n) {
      return ellipsoid.support(n) + n.dot(ellipsoid.center() - v);
    };
    reached = std::max(reached, g(middle));
    double bound = std::max({g(corners[0]), g(corners[1]), g(corners[2])});
    const Vector3d across = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    if (bound > 0) bound /= std::abs(across.dot(corners[0]));
    cones.push({corners, bound});
  };
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      for (const double z : {-1.0, 1.0}) {
        add({x * Vector3d::UnitX(), y * Vector3d::UnitY(), z * Vector3d::UnitZ()});
      }
    }
  }
  for (int triangles = 8; triangles < kMaxTriangles; triangles += 2) {
    const Cone most = cones.top();
    if (most.bound <= reached + accuracy) break;
    cones.pop();
    for (const std::array<Vector3d, 3>& half : divided(most.corners)) add(half);
  }
  return std::max(cones.top().bound, 0.0);
}

}  // namespace bqsa
