#include "harness/judge/motion_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/judge/judge.hpp"

namespace bqsa::harness {
namespace {

/// Part of the touching band to which the end of the bisection is resolved.
constexpr double kResolution = Judge::kTouching / 16;

/// Half an interval of this depth is lost beside 1 in double precision.
constexpr int kMaxDepth = 50;

/// One motion being bisected.
class Bisection {
 public:
  Bisection(const LinkScene& scene, const Eigen::VectorXd& from, const Eigen::VectorXd& to,
            int tick, const std::vector<LinkObstaclePair>& pairs, long limit, double known)
      : scene_(scene),
        kinematics_(scene.kinematics()),
        from_(from),
        to_(to),
        tick_(tick),
        change_(to - from),
        bounds_(point_bounds(kinematics_, to - from, travel_of(from, to))),
        pairs_(pairs),
        limit_(limit),
        least_known_(known),
        colliding_(pairs.size(), false),
        undecided_(pairs.size(), false) {
    verdict_.proven.assign(pairs.size(), std::numeric_limits<double>::infinity());
  }

  MotionVerdict run() {
    std::vector<std::size_t> all;
    for (std::size_t pair = 0; pair < pairs_.size(); ++pair) all.push_back(pair);
    const bool bounded = std::all_of(bounds_.acceleration.begin(), bounds_.acceleration.end(),
                                     [](double bound) { return std::isfinite(bound); });
    if (bounded) {
      bisect(0, 1, all, 0);
    } else {
      give_up(all);
    }
    for (std::size_t pair = 0; pair < pairs_.size(); ++pair) {
      if (colliding_[pair]) {
        verdict_.colliding.push_back(pairs_[pair]);
      } else if (undecided_[pair]) {
        verdict_.undecided.push_back(pairs_[pair]);
      }
    }
    return verdict_;
  }

 private:
  void give_up(const std::vector<std::size_t>& open) {
    for (const std::size_t pair : open) undecided_[pair] = true;
  }

  void bisect(double low, double high, const std::vector<std::size_t>& open, int depth) {
    if (depth > kMaxDepth || verdict_.visits >= limit_) return give_up(open);
    const double middle = low + (high - low) / 2;
    kinematics_.place(between(from_, to_, middle), positions_);

    std::vector<std::size_t> rest;
    for (const std::size_t pair : open) {
      if (!colliding_[pair] && !settled(pair, middle, (high - low) / 2)) rest.push_back(pair);
    }
    if (rest.empty()) return;
    bisect(low, middle, rest, depth + 1);
    bisect(middle, high, rest, depth + 1);
  }

  /// Reads the pair at the placed midpoint; whether the interval around it needs no closer look.
  bool settled(std::size_t index, double middle, double half_width) {
    const LinkObstaclePair& pair = pairs_[index];
    const Instant instant{tick_, middle};
    const PairReading reading = scene_.read(positions_, pair, instant, FclQuestion::kHit);
    ++verdict_.visits;
    verdict_.clearance = std::min(verdict_.clearance, reading.clearance);
    least_known_ = std::min(least_known_, reading.clearance);
    if (!reading.contradiction.empty() && verdict_.contradiction.empty()) {
      verdict_.contradiction = fmt::format("{}: {}", scene_.show(pair), reading.contradiction);
    }
    if (reading.clearance < -Judge::kTouching) {
      colliding_[index] = true;
      return true;
    }
    const bool touching = reading.clearance <= Judge::kTouching;
    verdict_.touching = verdict_.touching || touching;
    const double least = least_clearance(reading, pair, instant, half_width);
    const bool no_nearer = least >= least_known_ - clearance_resolution(least_known_);
    const bool touches =
        touching && (least >= -Judge::kTouching || reading.clearance - least <= kResolution);
    if (!touches && !(least > 0 && no_nearer)) return false;
    verdict_.proven[index] = std::min(verdict_.proven[index], least);
    return true;
  }

  /// Lower bound of the clearance on the interval of half width h around the instant.
  double least_clearance(const PairReading& reading, const LinkObstaclePair& pair,
                         const Instant& instant, double h) const {
    const LinkSegment& link = scene_.link(pair);
    const ObstacleState obstacle = scene_.track(pair).at(instant);
    const double spin = obstacle.spin.norm();
    double from_plane = std::numeric_limits<double>::infinity();
    double speed = 0;
    for (const int point : {link.start, link.end}) {
      const auto at = static_cast<std::size_t>(point);
      const Eigen::Vector3d arm = positions_.points[at] - obstacle.center;
      const Eigen::Vector3d velocity = kinematics_.velocity(positions_, change_, point) -
                                       obstacle.velocity - obstacle.spin.cross(arm);
      const double passing = bounds_.speed[at] + obstacle.velocity.norm();
      const double acceleration =
          bounds_.acceleration[at] + 2 * spin * passing + spin * spin * (arm.norm() + h * passing);
      const double approach = h * std::abs(reading.normal.dot(velocity)) + h * h / 2 * acceleration;
      const double height = reading.normal.dot(positions_.points[at]) - reading.offset;
      from_plane = std::min(from_plane, height - approach);
      speed = std::max(speed, bounds_.speed[at]);
    }
    const double way = h * (speed + scene_.track(pair).travel(tick_));
    return std::max(from_plane - scene_.link_radius(pair), reading.clearance - way);
  }

  const LinkScene& scene_;
  const JudgeKinematics& kinematics_;
  const Eigen::VectorXd& from_;
  const Eigen::VectorXd& to_;
  const int tick_;
  const Eigen::VectorXd change_;
  const PointBounds bounds_;
  const std::vector<LinkObstaclePair>& pairs_;
  const long limit_;
  double least_known_;  // clearance; -infinity if none is sought
  std::vector<bool> colliding_;
  std::vector<bool> undecided_;
  PointPositions positions_;
  MotionVerdict verdict_;
};

}  // namespace

PointBounds point_bounds(const JudgeKinematics& kinematics, const Eigen::VectorXd& change,
                         const Eigen::VectorXd& travel) {
  const Eigen::Index joints = change.size();
  PointBounds bounds;
  Eigen::VectorXd of_joint(joints);  // speed bounds of the point
  for (int point = 0; point < kinematics.points(); ++point) {
    for (int j = 0; j < joints; ++j) {
      of_joint(j) = kinematics.speed_bound(j, point, travel);
    }
    double speed = 0;
    double acceleration = 0;
    for (int j = 0; j < joints; ++j) {
      const double size = std::abs(change(j));
      speed += size * of_joint(j);
      const double turn = kinematics.is_prismatic(j) ? 0 : size;
      acceleration += turn * size * of_joint(j);
      for (int k = j + 1; k < joints; ++k) {
        acceleration += 2 * turn * std::abs(change(k)) * of_joint(k);
      }
    }
    bounds.speed.push_back(speed);
    bounds.acceleration.push_back(acceleration);
  }
  return bounds;
}

double clearance_resolution(double clearance) {
  constexpr double kRelative = 1e-3;
  return std::max(1e-6, kRelative * clearance);
}

Eigen::VectorXd between(const Eigen::VectorXd& from, const Eigen::VectorXd& to, double s) {
  return (1 - s) * from + s * to;
}

std::vector<double> MotionCheck::travel(const Eigen::VectorXd& from, const Eigen::VectorXd& to,
                                        int tick) const {
  const PointBounds bounds = point_bounds(scene_.kinematics(), to - from, travel_of(from, to));
  std::vector<double> travel;
  for (const LinkObstaclePair& pair : scene_.pairs()) {
    const LinkSegment& link = scene_.link(pair);
    travel.push_back(std::max(bounds.speed[static_cast<std::size_t>(link.start)],
                              bounds.speed[static_cast<std::size_t>(link.end)]) +
                     scene_.track(pair).travel(tick));
  }
  return travel;
}

MotionVerdict MotionCheck::follow(const Eigen::VectorXd& from, const Eigen::VectorXd& to, int tick,
                                  const std::vector<LinkObstaclePair>& pairs, long limit,
                                  double known) const {
  return Bisection(scene_, from, to, tick, pairs, limit, known).run();
}

Eigen::VectorXd travel_of(const Eigen::VectorXd& from, const Eigen::VectorXd& to) {
  return from.cwiseAbs().cwiseMax(to.cwiseAbs());
}

}  // namespace bqsa::harness
