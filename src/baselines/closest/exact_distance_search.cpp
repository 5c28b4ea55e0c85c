#include "baselines/closest/exact_distance_search.hpp"

#include <algorithm>

#include "baselines/closest/segment_ellipsoid_distance.hpp"

namespace bqsa::baselines {
namespace {

double squared_distance(const Eigen::Vector3d& p, const LinkAxis& axis) {
  const Eigen::Vector3d d = axis.b - axis.a;
  const double along = std::max((p - axis.a).dot(d), 0.0);
  const double whole = d.squaredNorm();
  return along < whole ? (p - axis.a - along / whole * d).squaredNorm()
                       : (p - axis.b).squaredNorm();
}

}  // namespace

void ExactDistanceSearch::assign(const Problem& problem, double exempt_length,
                                 WorkCounters& counters) {
  problem_ = &problem;
  exempt_length_ = exempt_length;
  counters_ = &counters;
  tick_ = 0;
  bounding_radius_.clear();
  for (const Obstacle& obstacle : problem.obstacles) {
    bounding_radius_.push_back(obstacle.shape.semi_axes().maxCoeff());
  }
}

void ExactDistanceSearch::search(const ChainPose& pose, double reach,
                                 std::vector<ClosestPoint>& found) {
  found.clear();
  const std::size_t links = problem_->chain.links().size();
  for (std::size_t j = 0; j < bounding_radius_.size(); ++j) {
    const Ellipsoid& shape = problem_->obstacles[j].at(tick_);
    const double far = bounding_radius_[j] + reach;
    for (std::size_t i = 0; i < links; ++i) {
      const LinkAxis axis = link_axis(problem_->chain, pose, i, exempt_length_);
      if (axis.s_end < 0 || squared_distance(shape.center(), axis) > far * far) continue;
      const SegmentDistance closest = segment_distance(axis.a, axis.b, shape);
      ++counters_->distance_queries;
      if (closest.distance >= reach) continue;
      found.push_back({.link = static_cast<int>(i),
                       .obstacle = static_cast<int>(j),
                       .s = closest.s * axis.s_end,
                       .distance = closest.distance,
                       .direction = closest.direction,
                       .p_obstacle = closest.p_ellipsoid});
    }
  }
}

}  // namespace bqsa::baselines
