#include "harness/scenario/problem_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "harness/judge/exact_distance.hpp"
#include "harness/judge/judge.hpp"
#include "harness/judge/obstacle_track.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;

/// How deep a capsule is in an obstacle, 0 if it is free or touches [m].
double penetration(const Vector3d& a, const Vector3d& b, double radius, const Ellipsoid& shape) {
  const Vector3d middle = (a + b) / 2;
  const double outer_radius = (b - a).norm() / 2 + shape.semi_axes().maxCoeff() + radius;
  if ((middle - shape.center()).norm() > outer_radius) return 0;
  const double depth = radius - exact_distance(a, b, shape).clearance();
  return depth > Judge::kTouching ? depth : 0;
}

/// The points that an arm's lengths let it reach: a spherical shell around a point that no joint
/// moves.
struct Reach {
  Vector3d center;   ///< [m]
  double least = 0;  ///< [m]
  double most = 0;   ///< [m]
};

/// Joint 1 does not move the d of a standard row 1 along its axis, nor any of a modified row 1.
/// From there on the distances between the frames' origins are constant, and the triangle
/// inequality bounds what they can span.
Reach reach_of(const ChainDescription& chain) {
  const DhRow& first = chain.rows.front();
  const bool modified = chain.convention == DhConvention::kModified;
  const Vector3d offset = modified ? Vector3d(first.a, -first.d * std::sin(first.alpha),
                                              first.d * std::cos(first.alpha))
                                   : Vector3d(0, 0, first.d);
  std::vector<double> lengths = {chain.p_LT.norm(), modified ? 0 : std::abs(first.a)};
  for (std::size_t j = 1; j < chain.rows.size(); ++j) {
    lengths.push_back(std::hypot(chain.rows[j].a, chain.rows[j].d));
  }
  Reach reach{.center = chain.p_WB + chain.R_WB * offset};
  for (const double length : lengths) reach.most += length;
  const double longest = *std::max_element(lengths.begin(), lengths.end());
  reach.least = std::max(0.0, 2 * longest - reach.most);
  return reach;
}

Vector3d nearest_on_segment(const Vector3d& a, const Vector3d& b, const Vector3d& p) {
  const double length_squared = (b - a).squaredNorm();
  if (!(length_squared > 0)) return a;
  return a + std::clamp((p - a).dot(b - a) / length_squared, 0.0, 1.0) * (b - a);
}

/// One straight piece of the path as a set of points.
struct Chord {
  double from, to;  ///< path parameters
  Vector3d a, b;    ///< end-points [m]
};

/// @param sagitta  how far the path may be from its chords [m]
void check_reach(const YamlValue& value, const Chord& chord, const Reach& reach, double sagitta,
                 int dimension, const Units& units) {
  constexpr int kDigits = 12;              // a path may leave the shell by very little
  const double slack = 1e-9 * reach.most;  // a path may end at the very edge
  const Vector3d near = nearest_on_segment(chord.a, chord.b, reach.center);
  const Vector3d far =
      (chord.a - reach.center).norm() > (chord.b - reach.center).norm() ? chord.a : chord.b;
  const bool too_far = (far - reach.center).norm() > reach.most + slack;
  const bool too_near = (near - reach.center).norm() < reach.least - sagitta - slack;
  if (!too_far && !too_near) return;
  const Vector3d& bad = too_far ? far : near;
  value.fail(fmt::format("a path within reach, {} to {} from {}", units.show(reach.least, kDigits),
                         units.show(reach.most, kDigits), units.show(reach.center, dimension)),
             fmt::format("{}, which is {} away", units.show(bad, dimension),
                         units.show((bad - reach.center).norm(), kDigits)));
}

/// Part of the chord, from its start, that is free before it enters the shape it is known to hit.
double free_part(const Chord& chord, double radius, const Ellipsoid& shape) {
  double low = 0;
  double high = 1;
  for (int i = 0; i < 40; ++i) {  // to 1e-12 of the chord
    const double middle = (low + high) / 2;
    const Vector3d end = chord.a + middle * (chord.b - chord.a);
    (penetration(chord.a, end, radius, shape) > 0 ? high : low) = middle;
  }
  return low;
}

/// The tip, as a ball of the link radius, and a moving obstacle, each where it is at the time.
class MovingTip {
 public:
  /// @param looks  that may still be taken in the whole scenario
  MovingTip(const Problem& problem, const Task& task, const Obstacle& obstacle, long& looks)
      : radius_(problem.link_radius),
        ticks_(problem.ticks),
        task_(task),
        shape_(obstacle.shape),
        track_(obstacle, problem.ticks),
        looks_(looks) {}

  /// Looks through the motion to a tick. Where the clearance halfway through a part of it exceeds
  /// what that part can take away, the part is free; others are halved until what can be taken away
  /// is a small part of the touching band.
  /// @returns a time in ticks at which the tip enters the obstacle, or `ticks` + 1 if it never does
  double entry(int tick) const { return entry(tick, 0, 1); }

  double never() const { return ticks_ + 1; }

 private:
  double parameter(const Instant& instant) const {
    return progress(task_.profile, std::clamp((instant.tick - 1 + instant.s) / ticks_, 0.0, 1.0));
  }

  double clearance(const Instant& instant) const {
    const ObstacleState state = track_.at(instant);
    const Vector3d tip =
        state.rotation.transpose() * (point_at(task_.path, parameter(instant)) - state.center);
    const Vector3d seen = shape_.center() + shape_.rotation() * tip;
    return exact_distance(seen, seen, shape_).clearance() - radius_;
  }

  double entry(int tick, double low, double high) const {
    constexpr double kResolution = Judge::kTouching / 16;
    const double middle = low + (high - low) / 2;
    if (--looks_ < 0) return never();
    const double now = clearance({tick, middle});
    if (now < -Judge::kTouching) return boundary(tick, low, middle);
    const double way_of_tip = way(task_.path, parameter({tick, low}), parameter({tick, high}));
    const double change = way_of_tip + (high - low) / 2 * track_.travel(tick);
    if (now > change || change <= kResolution) return never();
    const double first = entry(tick, low, middle);
    return first < never() ? first : entry(tick, middle, high);
  }

  /// Between an instant that is free, or is taken for the entry if it is not, and one that is not.
  double boundary(int tick, double low, double high) const {
    for (int i = 0; i < 40; ++i) {  // to 1e-12 of a tick
      const double middle = (low + high) / 2;
      (clearance({tick, middle}) < -Judge::kTouching ? high : low) = middle;
    }
    return tick - 1 + high;
  }

  double radius_;
  int ticks_;
  const Task& task_;
  const Ellipsoid& shape_;
  ObstacleTrack track_;
  long& looks_;
};

/// Refuses a tip path that enters a moving obstacle, the two taken at the same time.
void check_moving(const YamlValue& value, const Problem& problem, const Task& task) {
  constexpr long kLooks = 1L << 21;  // seconds of work
  long looks = kLooks;
  for (const Obstacle& obstacle : problem.obstacles) {
    if (!obstacle.moves()) continue;
    const MovingTip moving_tip(problem, task, obstacle, looks);
    for (int tick = 1; tick <= problem.ticks; ++tick) {
      const double entry = moving_tip.entry(tick);
      if (entry < moving_tip.never()) {
        value.fail("a path free of obstacles",
                   fmt::format("one that enters obstacle {} at t = {:.4g} s", obstacle.name,
                               entry * problem.dt));
      }
      if (looks < 0) {
        value.fail(
            fmt::format("a path that {} looks show to keep out of moving obstacles", kLooks),
            fmt::format("one that keeps too near to obstacle {} for that, until t = {:.4g} s",
                        obstacle.name, problem.time(tick)));
      }
    }
  }
}

}  // namespace

void check_start(const YamlValue& value, const Problem& problem, const Units& units) {
  const std::vector<YamlValue> angles = value.list("joint angles");
  for (int j = 0; j < problem.chain.joints(); ++j) {
    const JointLimits& limits = problem.limits;
    const bool below = limits.lower.size() > 0 && problem.start(j) < limits.lower(j);
    const bool above = limits.upper.size() > 0 && problem.start(j) > limits.upper(j);
    if (below || above) {
      const double limit = (below ? limits.lower(j) : limits.upper(j)) / units.rad_per_angle;
      angles[static_cast<std::size_t>(j)].fail(fmt::format("an angle {} the limit {:g} {}",
                                                           below ? "not below" : "not above", limit,
                                                           units.angle_name));
    }
  }
  ChainPose pose;
  problem.chain.forward(problem.start, pose);
  for (const Link& link : problem.chain.links()) {
    for (const Obstacle& obstacle : problem.obstacles) {
      const double shortfall = penetration(pose.p_WO.col(link.start), pose.p_WO.col(link.end),
                                           problem.link_radius + problem.margin, obstacle.at(0));
      if (!(shortfall > 0)) continue;
      const double clearance = problem.margin - shortfall;
      if (clearance < -Judge::kTouching) {
        value.fail("a start free of collision",
                   fmt::format("link {}, {} deep in obstacle {}", link.number,
                               units.show(-clearance), obstacle.name));
      }
      value.fail("a start that keeps the margin of " + units.show(problem.margin),
                 fmt::format("link {}, {} from obstacle {}", link.number,
                             units.show(std::max(clearance, 0.0)), obstacle.name));
    }
  }
}

void check_path(const YamlValue& value, const Problem& problem, const Task& task,
                double start_tolerance, const Units& units) {
  const int dimension = problem.dimension();
  ChainPose pose;
  problem.chain.forward(problem.start, pose);
  const Vector3d beginning = point_at(task.path, 0);
  const double start_distance = (beginning - pose.tip()).norm();
  const Reach reach = reach_of(problem.chain.description());

  const std::vector<double> parameters = chords(task.path);
  std::vector<Chord> pieces;
  for (std::size_t i = 0; i + 1 < parameters.size(); ++i) {
    pieces.push_back({parameters[i], parameters[i + 1], point_at(task.path, parameters[i]),
                      point_at(task.path, parameters[i + 1])});
  }
  for (const Chord& piece : pieces) {
    check_reach(value, piece, reach, sagitta(task.path), dimension, units);
  }
  if (start_distance > start_tolerance) {
    value.fail(fmt::format("a path that begins within {} of the tip at the start, {}",
                           units.show(start_tolerance), units.show(pose.tip(), dimension)),
               fmt::format("{}, which is {} away", units.show(beginning, dimension),
                           units.show(start_distance)));
  }
  for (const Chord& piece : pieces) {
    for (const Obstacle& obstacle : problem.obstacles) {
      if (obstacle.moves()) continue;
      if (!(penetration(piece.a, piece.b, problem.link_radius, obstacle.shape) > 0)) continue;
      const double s = piece.from + free_part(piece, problem.link_radius, obstacle.shape) *
                                        (piece.to - piece.from);
      value.fail("a path free of obstacles",
                 fmt::format("one that enters obstacle {} at t = {:.4g} s", obstacle.name,
                             task.duration * fraction_at(task.profile, s)));
    }
  }
  check_moving(value, problem, task);
}

}  // namespace bqsa::harness
