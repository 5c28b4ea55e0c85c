#include "harness/judge/segment_pair.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;

Vector3d nearest_on(const Vector3d& a, const Vector3d& b, const Vector3d& p) {
  const Vector3d along = b - a;
  const double length_squared = along.squaredNorm();
  if (!(length_squared > 0)) return a;
  return a + std::clamp((p - a).dot(along) / length_squared, 0.0, 1.0) * along;
}

}  // namespace

PointPair nearest_points(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                         const Vector3d& d) {
  PointPair best{a, nearest_on(c, d, a)};
  const auto offer = [&best](const Vector3d& on_first, const Vector3d& on_second) {
    const PointPair pair{on_first, on_second};
    if (pair.distance() < best.distance()) best = pair;
  };
  offer(b, nearest_on(c, d, b));
  offer(nearest_on(a, b, c), c);
  offer(nearest_on(a, b, d), d);

  // Inside of both segments, on their common perpendicular. Near-parallel ones lose digits of the
  // place along them, of which the distance depends the less the nearer they are to parallel.
  const Vector3d u = b - a, v = d - c, r = c - a;
  const Vector3d n = u.cross(v);
  const double squared = n.squaredNorm();
  if (squared > 0) {
    const double s = r.cross(v).dot(n) / squared;
    const double t = r.cross(u).dot(n) / squared;
    if (s > 0 && s < 1 && t > 0 && t < 1) offer(a + s * u, c + t * v);
  }
  return best;
}

}  // namespace bqsa::harness
