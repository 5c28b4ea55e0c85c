#include "baselines/closest/test_point_search.hpp"

#include <cmath>
#include <limits>

namespace bqsa::baselines {
namespace {

/// The test points of a shape, in W.
void place(const Eigen::Matrix3Xd& unit, const Ellipsoid& shape, Eigen::Matrix3Xd& surface) {
  surface.resize(3, unit.cols());
  for (Eigen::Index k = 0; k < unit.cols(); ++k) {
    surface.col(k) =
        shape.rotation() * shape.semi_axes().cwiseProduct(unit.col(k)) + shape.center();
  }
}

}  // namespace

void TestPointSearch::assign(const Problem& problem, double exempt_length, WorkCounters& counters) {
  problem_ = &problem;
  exempt_length_ = exempt_length;
  counters_ = &counters;
  tick_ = 0;
  unit_ = unit_test_points(problem.dimension(), counts_.obstacle);
  surface_.resize(problem.obstacles.size());
  for (std::size_t j = 0; j < surface_.size(); ++j) {
    place(unit_, problem.obstacles[j].at(0), surface_[j]);
  }
}

void TestPointSearch::go_to(int tick) {
  tick_ = tick;
  for (std::size_t j = 0; j < surface_.size(); ++j) {
    const Obstacle& obstacle = problem_->obstacles[j];
    if (obstacle.moves()) place(unit_, obstacle.at(tick), surface_[j]);
  }
}

void TestPointSearch::search(const ChainPose& pose, double reach,
                             std::vector<ClosestPoint>& found) {
  found.clear();
  const std::span<const Link> links = problem_->chain.links();
  const Eigen::Vector3d tip = pose.tip();
  const double exempt_squared = exempt_length_ * exempt_length_;
  for (std::size_t j = 0; j < surface_.size(); ++j) {
    const Eigen::Matrix3Xd& surface = surface_[j];
    for (std::size_t i = 0; i < links.size(); ++i) {
      const Eigen::Vector3d start = pose.p_WO.col(links[i].start);
      const Eigen::Vector3d along = pose.p_WO.col(links[i].end) - start;
      const bool last = i + 1 == links.size();
      double least = std::numeric_limits<double>::infinity();
      double s_least = 0;
      Eigen::Index nearest = 0;
      for (int k = 0; k < counts_.link; ++k) {
        const double s = static_cast<double>(k) / (counts_.link - 1);
        const Eigen::Vector3d p = start + s * along;
        if (last && (p - tip).squaredNorm() < exempt_squared) continue;
        Eigen::Index index;
        const double squared = (surface.colwise() - p).colwise().squaredNorm().minCoeff(&index);
        counters_->point_pairs += static_cast<std::uint64_t>(surface.cols());
        if (squared < least) {
          least = squared;
          s_least = s;
          nearest = index;
        }
      }
      if (least == std::numeric_limits<double>::infinity()) continue;  // all exempt
      const Eigen::Vector3d on_link = start + s_least * along;
      const Eigen::Vector3d on_obstacle = surface.col(nearest);
      const double side = problem_->obstacles[j].at(tick_).level(on_link) < 0 ? -1 : 1;
      const double distance = side * std::sqrt(least);
      if (distance >= reach) continue;
      found.push_back({.link = static_cast<int>(i),
                       .obstacle = static_cast<int>(j),
                       .s = s_least,
                       .distance = distance,
                       .direction = side * (on_link - on_obstacle).stableNormalized(),
                       .p_obstacle = on_obstacle});
    }
  }
}

}  // namespace bqsa::baselines
