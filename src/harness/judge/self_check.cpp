#include "harness/judge/self_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "harness/judge/motion_check.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// Part of the touching band to which the end of the bisection is resolved.
constexpr double kResolution = Judge::kTouching / 16;

/// Half an interval of this depth is lost beside 1 in double precision.
constexpr int kMaxDepth = 50;

enum class Finding { kFree, kCollides, kUndecided };

/// One pair on one motion being bisected.
class PairMotion {
 public:
  PairMotion(const SelfScene& scene, const LinkPair& pair, const VectorXd& from, const VectorXd& to,
             long& visits_left, SelfVerdict& verdict)
      : scene_(scene),
        pair_(pair),
        from_(from),
        to_(to),
        change_(relative_change()),
        visits_left_(visits_left),
        verdict_(verdict) {
    const PointBounds bounds = point_bounds(scene.kinematics(), change_, travel_of(from, to));
    first_ = link_bounds(bounds, scene.link(pair.first));
    second_ = link_bounds(bounds, scene.link(pair.second));
  }

  /// Bound of what the whole motion can take from the clearance [m].
  double travel() const { return speed(first_) + speed(second_); }

  Finding follow() { return std::isfinite(travel()) ? bisect(0, 1, 0) : Finding::kUndecided; }

 private:
  struct EndBounds {
    int point = 0;
    double speed = 0;         // [m]
    double acceleration = 0;  // [m]
  };
  struct LinkBounds {
    EndBounds start, end;
  };

  static EndBounds end_bounds(const PointBounds& bounds, int point) {
    const auto i = static_cast<std::size_t>(point);
    return {point, bounds.speed[i], bounds.acceleration[i]};
  }
  static LinkBounds link_bounds(const PointBounds& bounds, const LinkSegment& link) {
    return {end_bounds(bounds, link.start), end_bounds(bounds, link.end)};
  }

  /// The joints' change over the motion, none of those that carry the pair's first link.
  VectorXd relative_change() const {
    VectorXd change = to_ - from_;
    change.head(scene_.first_joint_between(pair_)).setZero();
    return change;
  }

  static double speed(const LinkBounds& link) { return std::max(link.start.speed, link.end.speed); }

  /// Collision on a sub-interval counts more than one left undecided.
  Finding bisect(double low, double high, int depth) {
    if (depth > kMaxDepth || visits_left_ <= 0) return Finding::kUndecided;
    --visits_left_;
    const double middle = low + (high - low) / 2;
    scene_.kinematics().place(between(from_, to_, middle), positions_);
    const PairReading reading = scene_.read(positions_, pair_, FclQuestion::kHit);
    if (!reading.contradiction.empty() && verdict_.disagreement.empty()) {
      verdict_.disagreement = fmt::format("{}: {}", scene_.show(pair_), reading.contradiction);
    }
    if (reading.clearance < -Judge::kTouching) return Finding::kCollides;
    const bool touching = reading.clearance <= Judge::kTouching;
    verdict_.touching = verdict_.touching || touching;
    const double least = least_clearance(reading, (high - low) / 2);
    const bool touches =
        touching && (least >= -Judge::kTouching || reading.clearance - least <= kResolution);
    if (least > 0 || touches) return Finding::kFree;
    const Finding first = bisect(low, middle, depth + 1);
    if (first == Finding::kCollides) return first;
    const Finding second = bisect(middle, high, depth + 1);
    return second == Finding::kFree ? first : second;
  }

  /// Lower bound of the clearance on the interval of half width h around the placed configuration.
  double least_clearance(const PairReading& reading, double h) const {
    const auto height = [&](const EndBounds& end) {
      return reading.normal.dot(positions_.points[static_cast<std::size_t>(end.point)]) -
             reading.offset;
    };
    const auto approach = [&](const EndBounds& end) {
      const Vector3d velocity = scene_.kinematics().velocity(positions_, change_, end.point);
      return h * std::abs(reading.normal.dot(velocity)) + h * h / 2 * end.acceleration;
    };
    const double most_of_first = std::max(height(first_.start) + approach(first_.start),
                                          height(first_.end) + approach(first_.end));
    const double least_of_second = std::min(height(second_.start) - approach(second_.start),
                                            height(second_.end) - approach(second_.end));
    return std::max(least_of_second - most_of_first - scene_.reach(pair_),
                    reading.clearance - h * travel());
  }

  const SelfScene& scene_;
  const LinkPair pair_;
  const VectorXd& from_;
  const VectorXd& to_;
  const VectorXd change_;
  LinkBounds first_;
  LinkBounds second_;
  long& visits_left_;
  SelfVerdict& verdict_;
  PointPositions positions_;
};

/// Follows all pairs through a run.
class RunCheck {
 public:
  RunCheck(const SelfScene& scene, long limit) : scene_(scene), visits_left_(limit) {}

  SelfVerdict run(const std::vector<VectorXd>& rows) {
    std::vector<double> before;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const int tick = static_cast<int>(k);
      const std::vector<double> now = check_tick(rows[k], tick);
      if (k > 0) check_motion(rows[k - 1], rows[k], tick, before, now);
      before = now;
    }
    for (const auto& [numbers, contact] : contacts_) verdict_.contacts.push_back(contact);
    std::stable_sort(
        verdict_.contacts.begin(), verdict_.contacts.end(),
        [](const SelfContact& a, const SelfContact& b) { return a.first_tick < b.first_tick; });
    return verdict_;
  }

 private:
  /// Reads all pairs; returns their clearances.
  std::vector<double> check_tick(const VectorXd& q, int tick) {
    std::vector<double> clearances;
    scene_.kinematics().place(q, positions_);
    for (const LinkPair& pair : scene_.pairs()) {
      const PairReading reading = scene_.read(positions_, pair, FclQuestion::kHitAndDistance);
      clearances.push_back(reading.clearance);
      verdict_.clearance_at_ticks = std::min(verdict_.clearance_at_ticks, reading.clearance);
      if (!reading.contradiction.empty() && verdict_.disagreement.empty()) {
        verdict_.disagreement =
            fmt::format("tick {}: {}: {}", tick, scene_.show(pair), reading.contradiction);
      }
      if (reading.clearance < -Judge::kTouching) {
        SelfContact& contact = contact_of(pair, tick);
        contact.at_tick = true;
        ++contact.ticks;
      } else if (reading.clearance <= Judge::kTouching) {
        verdict_.touching = true;
      }
    }
    return clearances;
  }

  /// Follows the motion to `tick` for the pairs that are free at both ends and near enough to meet: at
  /// any time at most half the way is between the pair and one of the ends.
  void check_motion(const VectorXd& from, const VectorXd& to, int tick,
                    const std::vector<double>& before, const std::vector<double>& after) {
    for (std::size_t p = 0; p < scene_.pairs().size(); ++p) {
      const LinkPair& pair = scene_.pairs()[p];
      const double clearance = std::min(before[p], after[p]);
      PairMotion motion(scene_, pair, from, to, visits_left_, verdict_);
      if (clearance < -Judge::kTouching || clearance > motion.travel() / 2) continue;
      const Finding finding = motion.follow();
      if (finding == Finding::kCollides) contact_of(pair, tick);
      if (finding == Finding::kUndecided) verdict_.undecided = true;
    }
  }

  SelfContact& contact_of(const LinkPair& pair, int tick) {
    const SelfContact fresh{.first = scene_.link(pair.first).number,
                            .second = scene_.link(pair.second).number,
                            .first_tick = tick};
    return contacts_.try_emplace({fresh.first, fresh.second}, fresh).first->second;
  }

  const SelfScene& scene_;
  long visits_left_;
  SelfVerdict verdict_;
  PointPositions positions_;
  std::map<std::pair<int, int>, SelfContact> contacts_;
};

}  // namespace

SelfVerdict check_self_collision(const SelfScene& scene, const std::vector<VectorXd>& rows,
                                 long limit) {
  return RunCheck(scene, limit).run(rows);
}

}  // namespace bqsa::harness
