#include "harness/judge/link_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "harness/judge/exact_distance.hpp"
#include "harness/judge/judge.hpp"

namespace bqsa::harness {
namespace {

/// Nothing that methods are told of goes unjudged.
void expect_truth_of_all(const Problem& problem, const std::vector<TrueObstacle>& truth) {
  std::size_t next = 0;
  for (const TrueObstacle& obstacle : truth) {
    if (static_cast<std::size_t>(obstacle.first) != next || obstacle.count < 1) {
      throw std::invalid_argument("obstacle " + obstacle.name + ": expected one after the other");
    }
    next += static_cast<std::size_t>(obstacle.count);
  }
  if (next != problem.obstacles.size()) {
    throw std::invalid_argument("expected the truth of all obstacles");
  }
}

/// Of the parts of obstacles that are no ellipsoids.
std::vector<Solid> parts_of(const std::vector<TrueObstacle>& truth) {
  std::vector<Solid> parts;
  for (const TrueObstacle& obstacle : truth) {
    parts.insert(parts.end(), obstacle.parts.begin(), obstacle.parts.end());
  }
  return parts;
}

std::vector<Ellipsoid> ellipsoids_of(const Problem& problem,
                                     const std::vector<TrueObstacle>& truth) {
  expect_truth_of_all(problem, truth);
  std::vector<Ellipsoid> shapes;
  for (const TrueObstacle& obstacle : truth) {
    if (!obstacle.is_ellipsoid()) continue;
    shapes.push_back(problem.obstacles[static_cast<std::size_t>(obstacle.first)].shape);
  }
  return shapes;
}

double fcl_tolerance(double size, double distance) {
  return kFclTolerance + kFclRelativeTolerance * (size + distance);
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
  const double tolerance = fcl_tolerance(size, distance);
  if (difference <= tolerance) return {};
  return fmt::format("FCL clearance {:.9e} m, exact clearance {:.9e} m", fcl.distance,
                     exact_clearance);
}

LinkScene::LinkScene(const Problem& problem) : LinkScene(problem, ellipsoids_as_told(problem)) {}

LinkScene::LinkScene(const Problem& problem, const std::vector<TrueObstacle>& truth)
    : kinematics_(problem.chain.description()), obstacles_(ellipsoids_of(problem, truth)) {
  for (const bool ellipsoids : {true, false}) {
    for (std::size_t k = 0; k < truth.size(); ++k) {
      if (truth[k].is_ellipsoid() != ellipsoids) continue;
      const std::size_t bodies = ellipsoids ? 1 : truth[k].parts.size();
      const Obstacle& told = problem.obstacles[static_cast<std::size_t>(truth[k].first)];
      names_.insert(names_.end(), bodies, truth[k].name);
      obstacle_of_.insert(obstacle_of_.end(), bodies, static_cast<int>(k));
      tracks_.insert(tracks_.end(), bodies, ObstacleTrack(told, problem.ticks));
      for (const Solid& part : truth[k].parts) solids_.emplace_back(part);
      if (!ellipsoids && tracks_.back().turns()) {
        throw std::invalid_argument("obstacle " + truth[k].name +
                                    ": expected one that does not turn");
      }
    }
  }
  const std::vector<Solid> parts = parts_of(truth);
  for (int link = 0; link < static_cast<int>(kinematics_.links().size()); ++link) {
    link_radii_.push_back(problem.radius_of(static_cast<std::size_t>(link)));
    const double radius = link_radii_.back();
    fcl_of_link_.push_back(&fcl_.try_emplace(radius, obstacles_, radius, parts).first->second);
    for (int body = 0; body < static_cast<int>(tracks_.size()); ++body) {
      pairs_.push_back({link, body});
    }
  }
}

std::string LinkScene::show(const LinkObstaclePair& pair) const {
  return fmt::format("link {}, obstacle {}", link(pair).number, obstacle_name(pair));
}

PairReading LinkScene::read(const PointPositions& positions, const LinkObstaclePair& pair,
                            const Instant& instant, FclQuestion question) const {
  const LinkSegment& ends = link(pair);
  Eigen::Vector3d start = positions.points[static_cast<std::size_t>(ends.start)];
  Eigen::Vector3d end = positions.points[static_cast<std::size_t>(ends.end)];
  if (static_cast<std::size_t>(pair.obstacle) >= obstacles_.size()) {
    return read_solid(start, end, pair, instant, question);
  }
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
  reading.clearance = exact.clearance() - link_radius(pair);
  reading.normal = exact.normal;
  const Eigen::Vector3d along_axes = obstacle.rotation().transpose() * exact.normal;
  reading.offset =
      exact.normal.dot(obstacle.center()) + obstacle.semi_axes().cwiseProduct(along_axes).norm();
  if (moves) {
    reading.normal = turn * exact.normal;
    reading.offset += reading.normal.dot(center) - exact.normal.dot(obstacle.center());
  }

  const FclCheck& fcl = *fcl_of_link_[static_cast<std::size_t>(pair.link)];
  const bool hit = fcl.collides(start, end, pair.obstacle);
  if (hit || question == FclQuestion::kHit) {
    reading.contradiction = contradiction(reading.clearance, hit);
  } else {
    const double distance = fcl.distance(start, end, pair.obstacle);
    reading.contradiction =
        contradiction(reading.clearance, FclAnswer{hit, distance}, (end - start).norm());
  }
  return reading;
}

PairReading LinkScene::read_solid(const Eigen::Vector3d& start, const Eigen::Vector3d& end,
                                  const LinkObstaclePair& pair, const Instant& instant,
                                  FclQuestion question) const {
  const ExactSolid& solid = solids_[static_cast<std::size_t>(pair.obstacle) - obstacles_.size()];
  const Eigen::Vector3d way = track(pair).at(instant).center - track(pair).at(Instant{}).center;
  const Eigen::Vector3d a = start - way, b = end - way;
  const SolidClearance exact = solid.clearance(a, b);
  PairReading reading;
  reading.clearance = exact.clearance - link_radius(pair);
  reading.normal = exact.normal;
  reading.offset = exact.offset + exact.normal.dot(way);
  const FclCheck& fcl = *fcl_of_link_[static_cast<std::size_t>(pair.link)];
  const bool hit = fcl.collides(a, b, pair.obstacle);
  reading.contradiction = contradiction(reading.clearance, hit);
  if (hit || question == FclQuestion::kHit || !reading.contradiction.empty()) return reading;
  const double distance = std::max(reading.clearance, 0.0);
  const double tolerance = fcl_tolerance((b - a).norm(), distance);
  if (!fcl.confirms(a, b, pair.obstacle, distance, tolerance)) {
    reading.contradiction =
        fmt::format("FCL does not confirm the exact clearance {:.9e} m", reading.clearance);
  }
  return reading;
}

}  // namespace bqsa::harness
