#include "baselines/closest_test_points.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace bqsa::baselines {
namespace {

/// M points of the unit circle in the plane z = 0.
Eigen::Matrix3Xd on_circle(int count) {
  Eigen::Matrix3Xd points(3, count);
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * std::numbers::pi * k / count;
    points.col(k) << std::cos(angle), std::sin(angle), 0;
  }
  return points;
}

/// M points of the unit sphere, of even density: a spiral that turns by the golden angle a point.
Eigen::Matrix3Xd on_sphere(int count) {
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  Eigen::Matrix3Xd points(3, count);
  for (int k = 0; k < count; ++k) {
    const double z = 1 - (2.0 * k + 1) / count;
    const double radius = std::sqrt(1 - z * z);
    points.col(k) << radius * std::cos(k * golden_angle), radius * std::sin(k * golden_angle), z;
  }
  return points;
}

/// The test points of a shape, in W.
void place(const Eigen::Matrix3Xd& unit, const Ellipsoid& shape, Eigen::Matrix3Xd& surface) {
  surface.resize(3, unit.cols());
  for (Eigen::Index k = 0; k < unit.cols(); ++k) {
    surface.col(k) =
        shape.rotation() * shape.semi_axes().cwiseProduct(unit.col(k)) + shape.center();
  }
}

}  // namespace

void ClosestTestPoints::assign(const Problem& problem, int link_points, int obstacle_points,
                               double exempt_length, WorkCounters& counters) {
  problem_ = &problem;
  link_points_ = link_points;
  exempt_length_ = exempt_length;
  counters_ = &counters;
  tick_ = 0;
  unit_ = problem.dimension() == 2 ? on_circle(obstacle_points) : on_sphere(obstacle_points);
  surface_.resize(problem.obstacles.size());
  for (std::size_t j = 0; j < surface_.size(); ++j) {
    place(unit_, problem.obstacles[j].at(0), surface_[j]);
  }
}

void ClosestTestPoints::go_to(int tick) {
  tick_ = tick;
  for (std::size_t j = 0; j < surface_.size(); ++j) {
    const Obstacle& obstacle = problem_->obstacles[j];
    if (obstacle.moves()) place(unit_, obstacle.at(tick), surface_[j]);
  }
}

ClosestPair ClosestTestPoints::search(const ChainPose& pose, int obstacle) const {
  const Eigen::Matrix3Xd& surface = surface_[static_cast<std::size_t>(obstacle)];
  const std::span<const Link> links = problem_->chain.links();
  const Eigen::Vector3d tip = pose.tip();
  const double exempt_squared = exempt_length_ * exempt_length_;

  ClosestPair closest;
  Eigen::Vector3d on_link = Eigen::Vector3d::Zero();
  Eigen::Vector3d on_obstacle = Eigen::Vector3d::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Eigen::Vector3d start = pose.p_WO.col(links[i].start);
    const Eigen::Vector3d along = pose.p_WO.col(links[i].end) - start;
    const bool last = i + 1 == links.size();
    for (int k = 0; k < link_points_; ++k) {
      const double s = static_cast<double>(k) / (link_points_ - 1);
      const Eigen::Vector3d p = start + s * along;
      if (last && (p - tip).squaredNorm() < exempt_squared) continue;
      Eigen::Index nearest;
      const double squared = (surface.colwise() - p).colwise().squaredNorm().minCoeff(&nearest);
      counters_->point_pairs += static_cast<std::uint64_t>(surface.cols());
      if (squared < least) {
        least = squared;
        closest.link = static_cast<int>(i);
        closest.s = s;
        on_link = p;
        on_obstacle = surface.col(nearest);
      }
    }
  }
  if (closest.link < 0) return closest;

  const Ellipsoid& shape = problem_->obstacles[static_cast<std::size_t>(obstacle)].at(tick_);
  const double side = shape.level(on_link) < 0 ? -1 : 1;
  closest.distance = side * std::sqrt(least);
  closest.direction = side * (on_link - on_obstacle).stableNormalized();
  return closest;
}

}  // namespace bqsa::baselines
