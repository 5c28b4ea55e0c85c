#include "baselines/planning/motion_check.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "baselines/closest/segment_ellipsoid_distance.hpp"

namespace bqsa::baselines {
namespace {

/// The turn from one state of an obstacle to the next, seen in its own axes.
Eigen::AngleAxisd turn_between(const Ellipsoid& before, const Ellipsoid& after) {
  return Eigen::AngleAxisd(Eigen::Matrix3d(before.rotation().transpose() * after.rotation()));
}

/// Where the obstacle is at `ticks` control periods, a whole number or not.
Ellipsoid state_at(const Obstacle& obstacle, double ticks) {
  const int last = static_cast<int>(obstacle.motion.size()) - 1;
  const int tick = std::clamp(static_cast<int>(ticks), 0, std::max(last - 1, 0));
  const double part = ticks - tick;
  const Ellipsoid& before = obstacle.at(tick);
  if (part <= 0 || tick == last) return before;
  const Ellipsoid& after = obstacle.at(tick + 1);
  Eigen::AngleAxisd turn = turn_between(before, after);
  turn.angle() *= part;
  const Eigen::Vector3d center = before.center() + part * (after.center() - before.center());
  return {center, before.semi_axes(), before.rotation() * turn.toRotationMatrix()};
}

/// No more than the distance of the segment from a to b to the shape [m].
double distance_at_least(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                         const Ellipsoid& shape) {
  const Eigen::Vector3d along = b - a;
  const Eigen::Vector3d to_center = shape.center() - a;
  const double length_squared = along.squaredNorm();
  const double s =
      length_squared > 0 ? std::clamp(to_center.dot(along) / length_squared, 0.0, 1.0) : 0.0;
  return (to_center - s * along).norm() - shape.semi_axes().maxCoeff();
}

}  // namespace

void MotionCheck::assign(const Problem& problem, WorkCounters& counters) {
  problem_ = &problem;
  counters_ = &counters;
  clearances_.clear();
  for (std::size_t i = 0; i < problem.chain.links().size(); ++i) {
    clearances_.push_back(problem.radius_of(i) + problem.margin + kSafety);
  }
  const int links = static_cast<int>(problem.chain.links().size());
  const int obstacles = static_cast<int>(problem.obstacles.size());

  all_pairs_.clear();
  for (int i = links - 1; i >= 0; --i) {
    for (int j = 0; j < obstacles; ++j) all_pairs_.push_back({i, j});
  }
  open_.assign(kMaxHalvings + 1, {});
  for (std::vector<Pair>& pairs : open_) pairs.reserve(all_pairs_.size());

  shapes_.clear();
  filter_.reset();
  travel_.assign(problem.obstacles.size(), {});
  for (std::size_t j = 0; j < problem.obstacles.size(); ++j) {
    const Obstacle& obstacle = problem.obstacles[j];
    shapes_.push_back(obstacle.at(0));
    if (!obstacle.moves()) continue;
    std::vector<double>& travel = travel_[j];
    travel.push_back(0);
    for (std::size_t k = 1; k < obstacle.motion.size(); ++k) {
      const Ellipsoid& before = obstacle.motion[k - 1];
      const Ellipsoid& after = obstacle.motion[k];
      const double shift = (after.center() - before.center()).norm();
      const double turn = turn_between(before, after).angle() * before.semi_axes().maxCoeff();
      travel.push_back(travel.back() + shift + turn);
    }
  }
  const auto moves = [](const Obstacle& obstacle) { return obstacle.moves(); };
  if (std::ranges::none_of(problem.obstacles, moves)) {
    filter_.emplace(problem.chain, shapes_, problem.link_radius + problem.margin + kSafety);
  }
}

bool MotionCheck::is_free(double t, const JointVector& q) { return is_free(t, q, t, q); }

bool MotionCheck::is_free(double t0, const JointVector& q0, double t1, const JointVector& q1) {
  return is_certainly_free(q0, q1) || is_free_between(t0, q0, t1, q1, all_pairs_, 0);
}

bool MotionCheck::is_free_between(double t0, const JointVector& q0, double t1,
                                  const JointVector& q1, const std::vector<Pair>& pairs,
                                  int halvings) {
  const double t = (t0 + t1) / 2;
  const JointVector q = (q0 + q1) / 2;
  const JointVector change = (q1 - q0).cwiseAbs() / 2;  // on either side of the middle
  const JointVector travel = q0.cwiseAbs().cwiseMax(q1.cwiseAbs());
  const SerialChain& chain = problem_->chain;
  go_to(t);
  chain.forward(q, pose_);
  ++counters_->kinematics;

  std::vector<Pair>& open = open_[static_cast<std::size_t>(halvings)];
  open.clear();
  for (const Pair& pair : pairs) {
    const Link& link = chain.links()[static_cast<std::size_t>(pair.link)];
    const Eigen::Vector3d a = pose_.p_WO.col(link.start);
    const Eigen::Vector3d b = pose_.p_WO.col(link.end);
    const Ellipsoid& shape = shapes_[static_cast<std::size_t>(pair.obstacle)];
    const double clearance = clearances_[static_cast<std::size_t>(pair.link)];
    const double needed =
        clearance + link_motion(link, change, travel) + obstacle_motion(pair.obstacle, t0, t1);
    if (distance_at_least(a, b, shape) >= needed) continue;
    ++counters_->distance_queries;
    const double distance = segment_distance(a, b, shape).distance;
    if (distance < clearance) return false;
    if (distance < needed) open.push_back(pair);
  }
  if (open.empty()) return true;
  if (halvings == kMaxHalvings) return false;
  return is_free_between(t0, q0, t, q, open, halvings + 1) &&
         is_free_between(t, q, t1, q1, open, halvings + 1);
}

bool MotionCheck::is_certainly_free(const JointVector& q0, const JointVector& q1) {
  if (!filter_) return false;
  const std::uint64_t before = filter_->configurations();
  const bool free = filter_->certainly_free(q0, q1);
  const std::uint64_t configurations = filter_->configurations() - before;
  counters_->kinematics += configurations;
  counters_->quadratics += configurations * all_pairs_.size();
  return free;
}

double MotionCheck::link_motion(const Link& link, const JointVector& change,
                                const JointVector& travel) const {
  double start = 0;
  double end = 0;
  for (int j = 0; j < change.size(); ++j) {
    start += change(j) * problem_->chain.speed_bound(j, link.start, travel);
    end += change(j) * problem_->chain.speed_bound(j, link.end, travel);
  }
  return std::max(start, end);
}

double MotionCheck::obstacle_motion(int obstacle, double t0, double t1) const {
  const std::vector<double>& travel = travel_[static_cast<std::size_t>(obstacle)];
  if (travel.size() < 2) return 0;
  const auto way_to = [&](double t) {
    const double ticks = t / problem_->dt;
    const auto tick =
        static_cast<std::size_t>(std::clamp(ticks, 0.0, static_cast<double>(travel.size() - 2)));
    return travel[tick] + (ticks - static_cast<double>(tick)) * (travel[tick + 1] - travel[tick]);
  };
  const double middle = way_to((t0 + t1) / 2);
  return std::max(middle - way_to(t0), way_to(t1) - middle);
}

void MotionCheck::go_to(double t) {
  for (std::size_t j = 0; j < shapes_.size(); ++j) {
    const Obstacle& obstacle = problem_->obstacles[j];
    if (obstacle.moves()) shapes_[j] = state_at(obstacle, t / problem_->dt);
  }
}

}  // namespace bqsa::baselines
