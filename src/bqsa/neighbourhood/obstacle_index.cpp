#include "bqsa/neighbourhood/obstacle_index.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bqsa {
namespace {

/// Of an obstacle about which nothing can be proven.
GrowingBox everywhere() {
  const Eigen::Vector3d infinite =
      Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  return GrowingBox::around(-infinite, infinite, Eigen::Vector3d::Zero());
}

GrowingBox box_at_rest(const Ellipsoid& shape) {
  const double rounding = ObstacleIndex::rounding(shape);
  if (!(rounding <= 0.25)) return everywhere();
  Eigen::Vector3d half;
  for (int axis = 0; axis < 3; ++axis) {
    half(axis) = (1 + 2 * rounding) * shape.support(Eigen::Vector3d::Unit(axis));
  }
  return GrowingBox::around(shape.center() - half, shape.center() + half,
                            half / shape.semi_axes().minCoeff());
}

/// The turn that leads from one rotation to the other, no less than it is [rad].
double turn_between(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to) {
  constexpr double kRounding = 1e-7;
  const double cosine = ((to.cwiseProduct(from)).sum() - 1) / 2;
  return std::acos(std::clamp(cosine, -1.0, 1.0)) + kRounding;
}

}  // namespace

double ObstacleIndex::rounding(const Ellipsoid& shape) {
  constexpr double kEps = std::numeric_limits<double>::epsilon() / 2;
  const double ratio = shape.semi_axes().maxCoeff() / shape.semi_axes().minCoeff();
  return 64 * kEps * ratio * ratio;
}

ObstacleIndex::ObstacleIndex(const std::vector<Obstacle>& obstacles) : obstacles_(&obstacles) {
  std::vector<GrowingBox> boxes;
  std::vector<std::int32_t> at_rest;
  boxes.reserve(obstacles.size());
  at_rest.reserve(obstacles.size());
  std::size_t rows = 0;
  for (std::size_t j = 0; j < obstacles.size(); ++j) {
    const Obstacle& obstacle = obstacles[j];
    if (obstacle.moves()) {
      movers_.push_back(static_cast<std::int32_t>(j));
      rows = std::max(rows, obstacle.motion.size());
    } else {
      at_rest.push_back(static_cast<std::int32_t>(j));
      boxes.push_back(box_at_rest(obstacle.shape));
    }
  }
  at_rest_ = BoxTree(boxes, at_rest);
  if (movers_.empty()) return;
  const auto last_tick = static_cast<int>(rows) - 1;
  for (int period = 0; period <= std::max(last_tick - 1, 0) / kPeriod; ++period) {
    boxes.clear();
    for (const std::int32_t j : movers_) {
      const Obstacle& obstacle = obstacles[static_cast<std::size_t>(j)];
      boxes.push_back(rests(j, period) ? box_at_rest(shape(j, period))
                                       : box_on_the_move(obstacle, period));
    }
    moving_.emplace_back(boxes, movers_);
  }
}

bool ObstacleIndex::rests(int obstacle, int period) const {
  const std::vector<Ellipsoid>& motion = (*obstacles_)[static_cast<std::size_t>(obstacle)].motion;
  if (motion.empty()) return true;
  const auto first = static_cast<std::size_t>(period) * kPeriod;
  const std::size_t end = std::min(first + kPeriod + 1, motion.size());
  for (std::size_t tick = first + 1; tick < end; ++tick) {
    if (motion[tick].center() != motion[first].center() ||
        motion[tick].rotation() != motion[first].rotation()) {
      return false;
    }
  }
  return true;
}

GrowingBox ObstacleIndex::box_on_the_move(const Obstacle& obstacle, int period) {
  const std::vector<Ellipsoid>& motion = obstacle.motion;
  const auto first = static_cast<std::size_t>(period) * kPeriod;
  const std::size_t end = std::min(first + kPeriod + 1, motion.size());
  Eigen::Vector3d low = motion[first].center(), high = low;
  double way = 0, turn = 0;  // of one tick
  for (std::size_t tick = first + 1; tick < end; ++tick) {
    const Ellipsoid& from = motion[tick - 1];
    const Ellipsoid& to = motion[tick];
    low = low.cwiseMin(to.center());
    high = high.cwiseMax(to.center());
    way = std::max(way, (to.center() - from.center()).norm());
    turn = std::max(turn, turn_between(from.rotation(), to.rotation()));
  }
  largest_turn_ = std::max(largest_turn_, turn);
  const Eigen::Vector3d& axes = motion[first].semi_axes();
  const double ratio = axes.maxCoeff() / axes.minCoeff();
  const double left = (1 - kShortestPart * ratio * turn) * (1 - rounding(motion[first]));
  if (!(left >= 0.25)) return everywhere();
  const double stretch = ratio / left;
  const Eigen::Vector3d radius =
      Eigen::Vector3d::Constant((axes.maxCoeff() + kShortestPart * ratio * way) / left);
  return GrowingBox::around(low - radius, high + radius, Eigen::Vector3d::Constant(stretch));
}

std::size_t ObstacleIndex::bytes() const {
  std::size_t sum = at_rest_.bytes() + movers_.size() * sizeof(std::int32_t);
  for (const BoxTree& tree : moving_) sum += tree.bytes();
  return sum;
}

}  // namespace bqsa
