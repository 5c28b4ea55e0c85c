#include "harness/generator/placed_shape.hpp"

#include <algorithm>

#include "harness/judge/exact_distance.hpp"

namespace bqsa::harness {
namespace {

std::variant<Obstacle, ExactSolid> shape_of(const ObstacleDraft& draft, const Problem& problem) {
  if (is_solid(draft.kind)) return ExactSolid(to_solid(draft));
  return to_obstacle(draft, problem.dimension(), problem.ticks, problem.dt);
}

}  // namespace

PlacedShape::PlacedShape(const Obstacle& ellipsoid)
    : shape_(ellipsoid), center_(ellipsoid.shape.center()), radius_(0) {}

PlacedShape::PlacedShape(const ObstacleDraft& draft, const Problem& problem)
    : shape_(shape_of(draft, problem)), center_(draft.center), radius_(draft.semi_axes.norm()) {}

bool PlacedShape::moves() const {
  const auto* const ellipsoid = std::get_if<Obstacle>(&shape_);
  return ellipsoid != nullptr && ellipsoid->moves();
}

bool PlacedShape::is_closer(const Eigen::Vector3d& a, const Eigen::Vector3d& b, int tick,
                            double clearance) const {
  const auto* const obstacle = std::get_if<Obstacle>(&shape_);
  const Eigen::Vector3d& center = obstacle != nullptr ? obstacle->at(tick).center() : center_;
  const double radius = obstacle != nullptr ? obstacle->at(tick).semi_axes().maxCoeff() : radius_;
  const double outer_radius = (b - a).norm() / 2 + radius;
  if (((a + b) / 2 - center).norm() > outer_radius + std::max(clearance, 0.0)) return false;
  if (obstacle != nullptr) return exact_distance(a, b, obstacle->at(tick)).clearance() < clearance;
  return std::get<ExactSolid>(shape_).clearance(a, b).clearance < clearance;
}

}  // namespace bqsa::harness
