#include "bqsa/shadow_field.hpp"

#include <utility>

#include "bqsa/geometry/nearest_plane.hpp"
#include "bqsa/geometry/separation.hpp"

namespace bqsa {
namespace {

constexpr Eigen::Index first_axis(CoordinatePlane plane) { return static_cast<int>(plane); }
constexpr Eigen::Index second_axis(CoordinatePlane plane) { return (first_axis(plane) + 1) % 3; }

Ellipse shadow_on(CoordinatePlane plane, const Ellipsoid& shape) {
  Eigen::Matrix<double, 2, 3> selector;
  selector << Eigen::RowVector3d::Unit(first_axis(plane)),
      Eigen::RowVector3d::Unit(second_axis(plane));
  return shadow(shape, selector);
}

}  // namespace

Eigen::Vector2d projected(const Eigen::Vector3d& p, CoordinatePlane plane) {
  return {p(first_axis(plane)), p(second_axis(plane))};
}

void ShadowField::assign(const std::vector<Obstacle>& obstacles, WorkCounters& counters,
                         double clearance, std::shared_ptr<const ObstacleIndex> index) {
  counters_ = &counters;
  tight_ = clearance > 0;
  tick_ = 0;
  distance_ = 0;
  slimness_ = {};
  const auto shadows_of = [](const Ellipsoid& shape) -> Shadows {
    return {shadow_on(CoordinatePlane::kXy, shape), shadow_on(CoordinatePlane::kYz, shape),
            shadow_on(CoordinatePlane::kZx, shape)};
  };
  shadows_.assign(obstacles, shadows_of);
  if (index == nullptr) index = std::make_shared<ObstacleIndex>(obstacles);
  neighbours_ = std::make_unique<NeighbourLists>(std::move(index), FreeBy::kShadows, counters);
}

void ShadowField::assign(const Problem& problem, WorkCounters& counters,
                         std::shared_ptr<const ObstacleIndex> index) {
  assign(problem.obstacles, counters, problem.link_radius + problem.margin, std::move(index));
  slimness_ = slimness_of(problem);
}

bool ShadowField::hit(const Shadows& shadows, const Eigen::Vector3d& p1, const Eigen::Vector3d& p2,
                      double distance) const {
  std::array<double, kCoordinatePlanes.size()> bounds;
  for (std::size_t k = 0; k < bounds.size(); ++k) {
    const CoordinatePlane plane = kCoordinatePlanes[k];
    ++counters_->quadratics;
    bounds[k] = separation<2>(shadows[k], projected(p1, plane), projected(p2, plane));
    if (bounds[k] > distance) return false;
  }
  if (!tight_) return true;
  for (std::size_t k = 0; k < bounds.size(); ++k) {
    if (bounds[k] <= 0) continue;
    const CoordinatePlane plane = kCoordinatePlanes[k];
    ++counters_->distance_queries;
    const NearestPlane<2> nearest =
        nearest_plane<2>(shadows[k], projected(p1, plane), projected(p2, plane), distance);
    if (nearest.distance > distance) return false;
  }
  return true;
}

int ShadowField::first_hit(const ChainPose& pose, const Link& link, int from) const {
  const Eigen::Vector3d p1 = pose.p_WO.col(link.start);
  const Eigen::Vector3d p2 = pose.p_WO.col(link.end);
  const double kept = distance_ - slimness_[static_cast<std::size_t>(link.end)];
  return neighbours_->find({tick_, link, pose, pose, 0, kept}, from, [&](int obstacle) {
    return hit(shadows_.at(obstacle, tick_), p1, p2, kept);
  });
}

}  // namespace bqsa
