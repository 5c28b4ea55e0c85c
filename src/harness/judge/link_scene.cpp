#include "harness/judge/link_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/judge/exact_distance.hpp"
#include "harness/judge/judge.hpp"

namespace bqsa::harness {
namespace {

std::vector<Ellipsoid> shapes_of(const std::vector<Obstacle>& obstacles) {
  std::vector<Ellipsoid> shapes;
  shapes.reserve(obstacles.size());
  for (const Obstacle& obstacle : obstacles) shapes.push_back(obstacle.shape);
  return shapes;
}

std::vector<std::string> names_of(const std::vector<Obstacle>& obstacles) {
  std::vector<std::string> names;
  names.reserve(obstacles.size());
  for (const Obstacle& obstacle : obstacles) names.push_back(obstacle.name);
  return names;
}

std::vector<ObstacleTrack> tracks_of(const Problem& problem) {
  std::vector<ObstacleTrack> tracks;
  tracks.reserve(problem.obstacles.size());
  for (const Obstacle& obstacle : problem.obstacles) tracks.emplace_back(obstacle, problem.ticks);
  return tracks;
}

}  // namespace

std::string contradiction(double exact_clearance, bool fcl_hit) {
  if (!std::isfinite(exact_clearance)) return "the exact clearance is not finite";
  if (fcl_hit && exact_clearance > Judge::kTouching) {
    return fmt::format("FCL hits, exact clearance {:.3e} m", exact_clearance);
  }
  if (!fcl_hit && exact_clearance < -Judge::kTouching) {
    return fmt::format("FCL misses, exact depth {:.3e} m", -exact_clearance);
  }
  return {};
}

std::string contradiction(double exact_clearance, const FclAnswer& fcl, double size) {
  std::string verdict = contradiction(exact_clearance, fcl.hit);
  if (!verdict.empty() || fcl.hit) return verdict;
  // FCL marks contact by a negative distance, and the exact depth has no counterpart in FCL.
  const double distance = std::max(exact_clearance, 0.0);
  const double difference = std::abs(std::max(fcl.distance, 0.0) - distance);
  const double tolerance = kFclTolerance + kFclRelativeTolerance * (size + distance);
  if (difference <= tolerance) return {};
  return fmt::format("FCL clearance {:.9e} m, exact clearance {:.9e} m", fcl.distance,
                     exact_clearance);
}

LinkScene::LinkScene(const Problem& problem)
    : kinematics_(problem.chain.description()),
      names_(names_of(problem.obstacles)),
      obstacles_(shapes_of(problem.obstacles)),
      tracks_(tracks_of(problem)),
      link_radius_(problem.link_radius),
      fcl_(obstacles_, link_radius_) {
  for (int link = 0; link < static_cast<int>(kinematics_.links().size()); ++link) {
    for (int obstacle = 0; obstacle < static_cast<int>(obstacles_.size()); ++obstacle) {
      pairs_.push_back({link, obstacle});
    }
  }
}

std::string LinkScene::show(const LinkObstaclePair& pair) const {
  return fmt::format("link {}, obstacle {}", link(pair).number,
                     names_[static_cast<std::size_t>(pair.obstacle)]);
}

PairReading LinkScene::read(const PointPositions& positions, const LinkObstaclePair& pair,
                            const Instant& instant, FclQuestion question) const {
  const LinkSegment& ends = link(pair);
  Eigen::Vector3d start = positions.points[static_cast<std::size_t>(ends.start)];
  Eigen::Vector3d end = positions.points[static_cast<std::size_t>(ends.end)];
  const Ellipsoid& obstacle = obstacles_[static_cast<std::size_t>(pair.obstacle)];
  const bool moves = track(pair).moves();
  Eigen::Vector3d center;  // of the obstacle now
  Eigen::Matrix3d turn;    // that it has made since t = 0
  if (moves) {
    const ObstacleState state = track(pair).at(instant);
    center = state.center;
    turn = state.rotation * obstacle.rotation().transpose();
    start = obstacle.center() + turn.transpose() * (start - center);
    end = obstacle.center() + turn.transpose() * (end - center);
  }

  const SegmentDistance exact = exact_distance(start, end, obstacle);
  PairReading reading;
  reading.clearance = exact.clearance() - link_radius_;
  reading.normal = exact.normal;
  const Eigen::Vector3d along_axes = obstacle.rotation().transpose() * exact.normal;
  reading.offset =
      exact.normal.dot(obstacle.center()) + obstacle.semi_axes().cwiseProduct(along_axes).norm();
  if (moves) {
    reading.normal = turn * exact.normal;
    reading.offset += reading.normal.dot(center) - exact.normal.dot(obstacle.center());
  }

  const bool hit = fcl_.collides(start, end, pair.obstacle);
  if (hit || question == FclQuestion::kHit) {
    reading.contradiction = contradiction(reading.clearance, hit);
  } else {
    const double distance = fcl_.distance(start, end, pair.obstacle);
    reading.contradiction =
        contradiction(reading.clearance, FclAnswer{hit, distance}, (end - start).norm());
  }
  return reading;
}

}  // namespace bqsa::harness
