#include "baselines/closest/vectorized_test_point_search.hpp"

#include <algorithm>
#include <cmath>

namespace bqsa::baselines {
void VectorizedTestPointSearch::place(std::size_t obstacle, const Ellipsoid& shape) {
  Points& surface = surface_[obstacle];
  for (Eigen::Index k = 0; k < unit_.rows(); ++k) {
    const Eigen::Vector3d unit = unit_.row(k);
    surface.row(k) = shape.rotation() * shape.semi_axes().cwiseProduct(unit) + shape.center();
  }
  blocks_->set(static_cast<int>(obstacle), surface);
}

void VectorizedTestPointSearch::assign(const Problem& problem, double exempt_length,
                                       WorkCounters& counters) {
  problem_ = &problem;
  exempt_length_ = exempt_length;
  counters_ = &counters;
  tick_ = 0;
  unit_ = unit_test_points(problem.dimension(), counts_.obstacle).transpose();
  const std::size_t obstacles = problem.obstacles.size();
  surface_.assign(obstacles, Points(unit_.rows(), 3));
  blocks_.emplace(PointBlocks::Lanes::kPoints, problem.dimension(), static_cast<int>(obstacles),
                  static_cast<int>(unit_.rows()));
  for (std::size_t j = 0; j < obstacles; ++j) place(j, problem.obstacles[j].at(0));
  const auto links = static_cast<Eigen::Index>(problem.chain.links().size());
  links_.resize(links * counts_.link, 3);
  least_squared_.resize(obstacles * static_cast<std::size_t>(links_.rows()));
}

void VectorizedTestPointSearch::go_to(int tick) {
  tick_ = tick;
  for (std::size_t j = 0; j < surface_.size(); ++j) {
    const Obstacle& obstacle = problem_->obstacles[j];
    if (obstacle.moves()) place(j, obstacle.at(tick));
  }
}

/// Link by link, without the exempt ones, which are the last of all.
int VectorizedTestPointSearch::put_link_points(const ChainPose& pose) {
  const std::span<const Link> links = problem_->chain.links();
  const Eigen::Vector3d tip = pose.tip();
  int count = 0;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Eigen::Vector3d start = pose.p_WO.col(links[i].start);
    const Eigen::Vector3d along = pose.p_WO.col(links[i].end) - start;
    for (int k = 0; k < counts_.link; ++k) {
      const Eigen::Vector3d p = start + static_cast<double>(k) / (counts_.link - 1) * along;
      if (i + 1 == links.size() && (p - tip).squaredNorm() < exempt_length_ * exempt_length_) {
        break;
      }
      links_.row(count++) = p;
    }
  }
  return count;
}

void VectorizedTestPointSearch::search(const ChainPose& pose, double reach,
                                       std::vector<ClosestPoint>& found) {
  found.clear();
  const int points = put_link_points(pose);
  const PointGroups each = {
      {links_.col(0).data(), links_.col(1).data(), links_.col(2).data(), points}, 1};
  least_squared_distances(*blocks_, each, Rounding::kAsScalar,
                          std::span(least_squared_).first(least_needed(*blocks_, each)));
  counters_->point_pairs += static_cast<std::uint64_t>(points * unit_.rows()) * surface_.size();
  for (std::size_t j = 0; j < surface_.size(); ++j) {
    for (int first = 0; first < points; first += counts_.link) {
      const int count = std::min(counts_.link, points - first);
      const double* const least =
          &least_squared_[blocks_->index(static_cast<int>(j), first, points)];
      const int k = static_cast<int>(std::min_element(least, least + count) - least);
      const Eigen::Vector3d on_link = links_.row(first + k);
      const double side = problem_->obstacles[j].at(tick_).level(on_link) < 0 ? -1 : 1;
      const double distance = side * std::sqrt(least[k]);
      if (distance >= reach) continue;
      Eigen::Index nearest;
      (surface_[j].rowwise() - on_link.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
      const Eigen::Vector3d on_obstacle = surface_[j].row(nearest);
      found.push_back({.link = first / counts_.link,
                       .obstacle = static_cast<int>(j),
                       .s = static_cast<double>(k) / (counts_.link - 1),
                       .distance = distance,
                       .direction = side * (on_link - on_obstacle).stableNormalized(),
                       .p_obstacle = on_obstacle});
    }
  }
}

}  // namespace bqsa::baselines
