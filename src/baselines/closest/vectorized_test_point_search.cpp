#include "baselines/closest/vectorized_test_point_search.hpp"

#include <cmath>

#include "baselines/closest/least_squared_distances.hpp"

namespace bqsa::baselines {
namespace {

PointArrays arrays(const Eigen::Matrix<double, Eigen::Dynamic, 3>& points, Eigen::Index count) {
  return {points.col(0).data(), points.col(1).data(), points.col(2).data(),
          static_cast<int>(count)};
}

}  // namespace

void VectorizedTestPointSearch::place(const Ellipsoid& shape, Points& surface) const {
  surface.resize(unit_.rows(), 3);
  for (Eigen::Index k = 0; k < unit_.rows(); ++k) {
    const Eigen::Vector3d unit = unit_.row(k);
    surface.row(k) = shape.rotation() * shape.semi_axes().cwiseProduct(unit) + shape.center();
  }
}

void VectorizedTestPointSearch::assign(const Problem& problem, double exempt_length,
                                       WorkCounters& counters) {
  problem_ = &problem;
  exempt_length_ = exempt_length;
  counters_ = &counters;
  tick_ = 0;
  unit_ = unit_test_points(problem.dimension(), counts_.obstacle).transpose();
  surface_.resize(problem.obstacles.size());
  for (std::size_t j = 0; j < surface_.size(); ++j) {
    place(problem.obstacles[j].at(0), surface_[j]);
  }
  link_.resize(counts_.link, 3);
  least_squared_.resize(counts_.link);
}

void VectorizedTestPointSearch::go_to(int tick) {
  tick_ = tick;
  for (std::size_t j = 0; j < surface_.size(); ++j) {
    const Obstacle& obstacle = problem_->obstacles[j];
    if (obstacle.moves()) place(obstacle.at(tick), surface_[j]);
  }
}

void VectorizedTestPointSearch::search(const ChainPose& pose, double reach,
                                       std::vector<ClosestPoint>& found) {
  found.clear();
  const bool planar = problem_->dimension() == 2;
  const std::span<const Link> links = problem_->chain.links();
  const Eigen::Vector3d tip = pose.tip();
  for (std::size_t j = 0; j < surface_.size(); ++j) {
    const Points& surface = surface_[j];
    for (std::size_t i = 0; i < links.size(); ++i) {
      const Eigen::Vector3d start = pose.p_WO.col(links[i].start);
      const Eigen::Vector3d along = pose.p_WO.col(links[i].end) - start;
      Eigen::Index count = 0;  // the exempt test points are the last ones
      for (int k = 0; k < counts_.link; ++k) {
        const Eigen::Vector3d p = start + static_cast<double>(k) / (counts_.link - 1) * along;
        if (i + 1 == links.size() && (p - tip).squaredNorm() < exempt_length_ * exempt_length_) {
          break;
        }
        link_.row(count++) = p;
      }
      if (count == 0) continue;
      (planar ? least_squared_distances_2d : least_squared_distances_3d)(
          arrays(link_, count), arrays(surface, surface.rows()), least_squared_.data());
      counters_->point_pairs += static_cast<std::uint64_t>(count * surface.rows());

      Eigen::Index k, nearest;
      const double least = least_squared_.head(count).minCoeff(&k);
      const Eigen::Vector3d on_link = link_.row(k);
      const double side = problem_->obstacles[j].at(tick_).level(on_link) < 0 ? -1 : 1;
      const double distance = side * std::sqrt(least);
      if (distance >= reach) continue;
      (surface.rowwise() - on_link.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
      const Eigen::Vector3d on_obstacle = surface.row(nearest);
      found.push_back({.link = static_cast<int>(i),
                       .obstacle = static_cast<int>(j),
                       .s = static_cast<double>(k) / (counts_.link - 1),
                       .distance = distance,
                       .direction = side * (on_link - on_obstacle).stableNormalized(),
                       .p_obstacle = on_obstacle});
    }
  }
}

}  // namespace bqsa::baselines
