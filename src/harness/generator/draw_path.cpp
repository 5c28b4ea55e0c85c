#include "harness/generator/draw_path.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;

/// Lengths and radii between which paths are drawn [m].
struct PathSizes {
  double least_length, most_length;
  double least_radius, most_radius;
  double least_stretching_radius, most_stretching_radius;
};
constexpr PathSizes kPlanarSizes = {0.4, 1.2, 0.2, 0.6, 0.2, 0.7};
constexpr PathSizes kSizesAroundSolids = {0.4, 0.9, 0.12, 0.25, 0.08, 0.25};
constexpr PathSizes kSpatialSizes = {0.2, 0.5, 0.08, 0.15, 0.08, 0.25};

const PathSizes& sizes_of(int dimension) { return dimension == 2 ? kPlanarSizes : kSpatialSizes; }

/// A random unit vector orthogonal to the unit vector u.
Vector3d draw_orthogonal(const Vector3d& u, int dimension, RandomStream& random) {
  const Vector3d w = random.direction(dimension);
  return (w - w.dot(u) * u).normalized();
}

PathDraft circle_from(const Vector3d& tip, double radius, const Vector3d& u, const Vector3d& v,
                      double turn) {
  return CircleDraft{.center = rounded(Vector3d(tip - radius * u)),
                     .radius = rounded(radius),
                     .axis_u = rounded(u),
                     .axis_v = rounded(v),
                     .turn = rounded(turn)};
}

}  // namespace

PathDraft draw_line_or_arc(const Vector3d& tip, int dimension, bool around_solids,
                           RandomStream& random) {
  const PathSizes& sizes = around_solids ? kSizesAroundSolids : sizes_of(dimension);
  const double length = random.uniform(sizes.least_length, sizes.most_length);
  const Vector3d u = random.direction(dimension);
  if (random.chance(0.5)) return LineDraft{rounded(tip), rounded(Vector3d(tip + length * u))};
  const double radius = random.uniform(sizes.least_radius, sizes.most_radius);
  const double turn = dimension == 2 ? length / radius : 2 * std::numbers::pi;
  return circle_from(tip, radius, u, draw_orthogonal(u, dimension, random), turn);
}

PathDraft draw_reaching_line(const Vector3d& tip, const Vector3d& center, RandomStream& random) {
  const double outwards = std::atan2(tip.y() - center.y(), tip.x() - center.x());
  const double yaw = outwards + random.uniform(-0.5, 0.5);
  const double pitch = random.uniform(-0.2, 0.2);
  const double length = random.uniform(0.2, 0.4);
  const Vector3d u(std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw),
                   std::sin(pitch));
  return LineDraft{rounded(tip), rounded(Vector3d(tip + length * u))};
}

std::optional<PathDraft> draw_stretching_arc(const Vector3d& tip, const Arm& arm,
                                             RandomStream& random) {
  constexpr double kLeast = 0.97;  // of the reach
  constexpr double kMost = 0.995;
  constexpr double kShortest = 0.3;  // from the start to the middle [rad]
  const PathSizes& sizes = sizes_of(arm.chain.dimension);
  const double farthest = random.uniform(kLeast, kMost) * arm.reach;
  const double from = (tip - arm.center).norm();
  const double least_radius = std::max(sizes.least_stretching_radius, (farthest - from) / 2);
  if (least_radius > sizes.most_stretching_radius || from > farthest) return std::nullopt;

  // The circle's centre is (farthest - radius) from the arm's and `radius` from the tip.
  const double radius = random.uniform(least_radius, sizes.most_stretching_radius);
  const Vector3d outward = (tip - arm.center) / from;
  const Vector3d aside = draw_orthogonal(outward, arm.chain.dimension, random);
  const double distance = farthest - radius;
  const double along = (distance * distance + from * from - radius * radius) / (2 * from);
  const double across = std::sqrt(std::max(0.0, distance * distance - along * along));
  const Vector3d to_center = along * outward + across * aside;
  const Vector3d u = (from * outward - to_center) / radius;
  const Vector3d farthest_way = to_center.normalized();
  const double half_turn = std::acos(std::clamp(u.dot(farthest_way), -1.0, 1.0));
  if (half_turn < kShortest) return std::nullopt;
  const Vector3d v = (farthest_way - u.dot(farthest_way) * u).normalized();
  return circle_from(tip, radius, u, v, 2 * half_turn);
}

}  // namespace bqsa::harness
