#include "harness/generator/draw_scene.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "harness/generator/draw_spot.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector4d;

Vector4d quaternion_of(const Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  return {q.w(), q.x(), q.y(), q.z()};
}

/// A box in a frame whose columns are R, its centre given in that frame from an origin [m].
ObstacleDraft board(const Vector3d& origin, const Matrix3d& R, const Vector3d& center,
                    const Vector3d& half) {
  return {.kind = ShapeKind::kBox,
          .center = rounded(Vector3d(origin + R * center)),
          .semi_axes = rounded(half),
          .rotation = rounded(quaternion_of(R))};
}

/// A solid of random kind, size and rotation about the origin.
ObstacleDraft draw_solid(RandomStream& random) {
  constexpr double kLeast = 0.02;  // half an extent [m]
  constexpr double kMost = 0.08;
  constexpr ShapeKind kKinds[] = {ShapeKind::kBox, ShapeKind::kCylinder, ShapeKind::kCapsule,
                                  ShapeKind::kSphere};
  ObstacleDraft solid;
  solid.kind = kKinds[random.whole(0, 3)];
  solid.center.setZero();
  Vector3d half;
  for (double& extent : half) extent = rounded(random.uniform(kLeast, kMost));
  if (solid.kind == ShapeKind::kCylinder) half.y() = half.x();
  if (solid.kind == ShapeKind::kCapsule) {
    half.y() = half.x() = rounded(half.x() / 2);
    half.z() = rounded(half.z() + half.x());
  }
  if (solid.kind == ShapeKind::kSphere) half = Vector3d::Constant(half.x());
  solid.semi_axes = half;
  solid.rotation = rounded(random.quaternion());
  return solid;
}

}  // namespace

ObstacleDraft draw_solid_on_link(const NominalMotion& nominal, RandomStream& random) {
  const Spot spot = draw_middle_spot(nominal, random);
  ObstacleDraft solid = draw_solid(random);
  const double radius = nominal.problem().radius_of(spot.link);
  const double shift = random.uniform(0.2, 0.9) * (solid.semi_axes.minCoeff() + radius);
  solid.center = rounded(Vector3d(spot.point + shift * spot.sideways));
  return solid;
}

ObstacleDraft draw_solid_near(const NominalMotion& nominal, RandomStream& random) {
  constexpr double kDistance = 0.3;  // [m]
  const Spot spot = draw_spot(nominal, 0, nominal.problem().ticks, 1, random);
  ObstacleDraft solid = draw_solid(random);
  const double distance = random.uniform(0, kDistance);
  solid.center = rounded(Vector3d(spot.point + distance * random.direction(3)));
  return solid;
}

std::vector<ObstacleDraft> draw_corridor(const NominalMotion& nominal, RandomStream& random) {
  constexpr double kHalfThickness = 0.01;  // [m]
  const Spot spot = draw_middle_spot(nominal, random);
  Matrix3d R;  // x along the link, z across the walls
  R << spot.along, spot.sideways.cross(spot.along), spot.sideways;
  const double radius = nominal.problem().radius_of(spot.link);
  const double gap = random.uniform(0.12, 0.3);
  const double lower = random.uniform(-radius, 0.5 * radius);  // face of the first wall
  const auto wall = [&](double face, double side) {
    const Vector3d half(random.uniform(0.15, 0.3), random.uniform(0.15, 0.3), kHalfThickness);
    return board(spot.point, R, {0, 0, face + side * kHalfThickness}, half);
  };
  const ObstacleDraft first = wall(lower, -1);
  const ObstacleDraft second = wall(lower + gap + 2 * radius, 1);
  return {first, second};
}

std::vector<ObstacleDraft> draw_shelf(const NominalMotion& nominal, RandomStream& random) {
  constexpr double kHalfThickness = 0.01;  // [m]
  constexpr double kBeside = 0.08;         // of the end of the path from boards, at least [m]
  const Problem& problem = nominal.problem();
  const Vector3d end = problem.desired_tip(problem.duration());
  const Vector3d inwards = (end - problem.desired_tip(0)).normalized();
  Matrix3d R;  // x inwards, y to the side, z up
  R.col(0) = inwards;
  R.col(1) = Vector3d::UnitZ().cross(inwards).normalized();
  R.col(2) = R.col(0).cross(R.col(1));

  const double half_depth = random.uniform(0.1, 0.18);
  const double half_width = random.uniform(0.18, 0.3);
  const double half_height = random.uniform(0.15, 0.25);
  const double behind = random.uniform(0.07, 0.12);  // of the end, to the back
  const double aside = random.uniform(-1, 1) * (half_width - kBeside);
  const double above = random.uniform(-1, 1) * (half_height - kBeside);
  const Vector3d middle = end + R * Vector3d(behind - half_depth, aside, above);
  const double t = kHalfThickness;
  const Vector3d level(half_depth, half_width + 2 * t, t);
  const Vector3d upright(half_depth, t, half_height);
  return {board(middle, R, {0, 0, -half_height - t}, level),
          board(middle, R, {0, 0, half_height + t}, level),
          board(middle, R, {0, -half_width - t, 0}, upright),
          board(middle, R, {0, half_width + t, 0}, upright),
          board(middle, R, {half_depth + t, 0, 0}, {t, half_width + 2 * t, half_height + 2 * t})};
}

}  // namespace bqsa::harness
