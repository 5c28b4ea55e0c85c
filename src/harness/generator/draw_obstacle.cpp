#include "harness/generator/draw_obstacle.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/generator/draw_spot.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;

/// An obstacle of random size and rotation about the origin.
ObstacleDraft draw_shape(int dimension, RandomStream& random) {
  if (dimension == 3) {
    constexpr double kLeast = 0.03;  // [m]
    constexpr double kMost = 0.1;
    Vector3d semi_axes;
    for (double& axis : semi_axes) axis = random.uniform(kLeast, kMost);
    return {.center = Vector3d::Zero(),
            .semi_axes = rounded(semi_axes),
            .rotation = rounded(random.quaternion())};
  }
  constexpr double kLeast = 0.03;  // [m]
  constexpr double kMost = 0.15;
  constexpr double kLeastAspect = 0.4;
  const double longer = random.uniform(kLeast, kMost);
  const double shorter = longer * random.uniform(std::max(kLeastAspect, kLeast / longer), 1);
  const double angle = random.uniform(0, std::numbers::pi);
  return {.center = Vector3d::Zero(),
          .semi_axes = rounded(Vector3d(longer, shorter, longer)),
          .rotation = {rounded(angle), 0, 0, 0}};
}

/// How far a spot's obstacle is shifted sideways: never so far that it leaves the link [m].
double draw_shift(const Ellipsoid& shape, const Vector3d& sideways, double link_radius,
                  int dimension, RandomStream& random) {
  return dimension == 2 ? random.uniform(0, 0.9) * shape.support(sideways)
                        : random.uniform(0.2, 0.9) * (shape.semi_axes().minCoeff() + link_radius);
}

Vector3d draw_center(const Spot& spot, const ObstacleDraft& obstacle, const Problem& problem,
                     double t, RandomStream& random) {
  const Ellipsoid shape = shape_at(obstacle, problem.dimension(), t);
  const double radius = problem.radius_of(spot.link);
  return spot.point +
         draw_shift(shape, spot.sideways, radius, problem.dimension(), random) * spot.sideways;
}

}  // namespace

ObstacleDraft draw_on_link(const NominalMotion& nominal, RandomStream& random) {
  const int dimension = nominal.problem().dimension();
  const Spot spot = draw_middle_spot(nominal, random);
  ObstacleDraft obstacle = draw_shape(dimension, random);
  obstacle.center = rounded(draw_center(spot, obstacle, nominal.problem(), 0, random));
  return obstacle;
}

ObstacleDraft draw_moving(const NominalMotion& nominal, RandomStream& random) {
  constexpr double kSlowest = 0.02;     // [m/s]
  constexpr double kFastest = 0.3;      // [m/s]
  constexpr double kFastestTurn = 0.5;  // [rad/s]
  const int dimension = nominal.problem().dimension();
  const Spot spot = draw_middle_spot(nominal, random);
  ObstacleDraft obstacle = draw_shape(dimension, random);
  const double speed = random.log_uniform(kSlowest, kFastest);
  obstacle.motion = {.velocity = rounded(Vector3d(speed * random.direction(dimension))),
                     .angular_velocity = Vector3d::Zero()};
  const Vector3d axis = dimension == 2 ? Vector3d::UnitZ() : random.direction(3);
  const double turn = random.uniform(-kFastestTurn, kFastestTurn);
  if (random.chance(0.5)) obstacle.motion->angular_velocity = rounded(Vector3d(turn * axis));
  const double t = nominal.problem().time(spot.tick);
  obstacle.center = rounded(Vector3d(draw_center(spot, obstacle, nominal.problem(), t, random) -
                                     obstacle.motion->velocity * t));
  return obstacle;
}

ObstacleDraft draw_near(const NominalMotion& nominal, RandomStream& random) {
  constexpr double kPlanarDistance = 0.3;   // [m]
  constexpr double kSpatialDistance = 0.2;  // [m]
  const int dimension = nominal.problem().dimension();
  const Spot spot = draw_spot(nominal, 0, nominal.problem().ticks, 1, random);
  ObstacleDraft obstacle = draw_shape(dimension, random);
  const double distance = random.uniform(0, dimension == 2 ? kPlanarDistance : kSpatialDistance);
  obstacle.center = rounded(Vector3d(spot.point + distance * random.direction(dimension)));
  return obstacle;
}

std::pair<ObstacleDraft, ObstacleDraft> draw_gap(const NominalMotion& nominal,
                                                 RandomStream& random) {
  constexpr double kNarrowest = 0.04;  // [m]
  constexpr double kWidest = 0.12;     // [m]
  const Spot spot = draw_middle_spot(nominal, random);
  const Vector3d& n = spot.sideways;
  std::pair<ObstacleDraft, ObstacleDraft> pair = {draw_shape(2, random), draw_shape(2, random)};
  const double gap = random.uniform(kNarrowest, kWidest);

  // Heights of the two tangents over the link, along n: the first obstacle below the lower one, the
  // second above the upper one, each touching its tangent at the spot's place along the link.
  const Ellipsoid first = shape_at(pair.first, 2, 0);
  const Ellipsoid second = shape_at(pair.second, 2, 0);
  const double lower = random.uniform(0.1, 0.9) * first.semi_axes().minCoeff();
  const double upper = lower + gap;
  const auto farthest_along_n = [&n](const Ellipsoid& shape) -> Vector3d {
    const Vector3d local = shape.semi_axes().cwiseProduct(shape.rotation().transpose() * n);
    return shape.rotation() * shape.semi_axes().cwiseProduct(local) / shape.support(n);
  };
  pair.first.center = rounded(Vector3d(spot.point + lower * n - farthest_along_n(first)));
  pair.second.center = rounded(Vector3d(spot.point + upper * n + farthest_along_n(second)));
  return pair;
}

}  // namespace bqsa::harness
