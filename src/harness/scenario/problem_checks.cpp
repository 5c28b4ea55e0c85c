#include "harness/scenario/problem_checks.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "harness/judge/exact_distance.hpp"
#include "harness/judge/exact_solid.hpp"
#include "harness/judge/judge.hpp"
#include "harness/judge/obstacle_track.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;

/// Whether a sphere around the obstacle, a box along its axes, or the obstacle made larger so that it holds
/// all points within `radius` of it shows a capsule to be free. Most pairs are, and take no distance.
bool clearly_free(const Vector3d& a, const Vector3d& b, double radius, const Ellipsoid& shape) {
  const Vector3d& semi_axes = shape.semi_axes();
  const Vector3d offset = (a + b) / 2 - shape.center();
  if (offset.norm() > (b - a).norm() / 2 + semi_axes.maxCoeff() + radius) return true;
  const Vector3d middle = shape.rotation().transpose() * offset;
  const Vector3d half = shape.rotation().transpose() * (b - a) / 2;
  if ((middle.cwiseAbs() - half.cwiseAbs() - semi_axes).maxCoeff() > radius) return true;
  // Times 1 + radius / a in each direction, a the shortest semi-axis, every surface moves by radius or more.
  const Vector3d larger = semi_axes * (1 + radius / semi_axes.minCoeff());
  const Vector3d m = middle.cwiseQuotient(larger);
  const Vector3d h = half.cwiseQuotient(larger);
  const double length_squared = h.squaredNorm();
  const double nearest = length_squared > 0 ? std::clamp(-m.dot(h) / length_squared, -1.0, 1.0) : 0;
  constexpr double kRounding = 1e-9;  // of axes up to 1e6 times each other
  return (m + nearest * h).norm() > 1 + kRounding;
}

/// An obstacle as it is at t = 0: an ellipsoid, or solids with ellipsoids around them.
class CheckedObstacle {
 public:
  CheckedObstacle(const Problem& problem, const TrueObstacle& truth)
      : name_(truth.name),
        told_(std::span(problem.obstacles)
                  .subspan(static_cast<std::size_t>(truth.first),
                           static_cast<std::size_t>(truth.count))),
        parts_(truth.parts.begin(), truth.parts.end()) {}

  const std::string& name() const { return name_; }
  bool moves() const { return told().moves(); }

  /// One of its ellipsoids; all move alike.
  const Obstacle& told() const { return told_.front(); }

  /// Of a segment, signed as the judge has it [m].
  double clearance(const Vector3d& a, const Vector3d& b) const {
    if (parts_.empty()) return exact_distance(a, b, told().shape).clearance();
    double least = std::numeric_limits<double>::infinity();
    for (const ExactSolid& part : parts_) least = std::min(least, part.clearance(a, b).clearance);
    return least;
  }

  /// How deep a capsule is in it, 0 if it is free or touches [m].
  double penetration(const Vector3d& a, const Vector3d& b, double radius) const {
    const bool free = std::all_of(told_.begin(), told_.end(), [&](const Obstacle& around) {
      return clearly_free(a, b, radius, around.shape);
    });
    if (free) return 0;
    const double depth = radius - clearance(a, b);
    return depth > Judge::kTouching ? depth : 0;
  }

 private:
  const std::string& name_;
  std::span<const Obstacle> told_;
  std::vector<ExactSolid> parts_;
};

std::vector<CheckedObstacle> checked_obstacles(const Problem& problem,
                                               const std::vector<TrueObstacle>& truth) {
  std::vector<CheckedObstacle> obstacles;
  obstacles.reserve(truth.size());
  for (const TrueObstacle& obstacle : truth) obstacles.emplace_back(problem, obstacle);
  return obstacles;
}

/// The points that an arm's lengths let it reach: a spherical shell around a point that no joint
/// moves.
struct Reach {
  Vector3d center;   ///< [m]
  double least = 0;  ///< [m]
  double most = 0;   ///< [m]
};

/// What of row or placement 1 joint 1 does not move [m]: the d of a standard row along its axis, all of
/// any other.
Vector3d fixed_part(const ChainDescription& chain) {
  if (chain.is_placed()) return chain.placements.front().p_PJ;
  const DhRow& first = chain.rows.front();
  if (chain.convention == DhConvention::kStandard) return {0, 0, first.d};
  return {first.a, -first.d * std::sin(first.alpha), first.d * std::cos(first.alpha)};
}

/// Behind that part the distances between the frames' origins are constant, and the triangle inequality
/// bounds what they can span. A prismatic joint is a length of its own, from 0 to the larger of its
/// limits; one without limits reaches anywhere.
Reach reach_of(const ChainDescription& chain, const JointLimits& limits) {
  const Vector3d offset = fixed_part(chain);
  std::vector<double> lengths = {
      chain.p_LT.norm(), chain.turns_about_own_origin() ? 0 : std::abs(chain.rows.front().a)};
  for (int j = 1; j < chain.joints(); ++j) lengths.push_back(chain.link_length(j));
  Reach reach{.center = chain.p_WB + chain.R_WB * offset};
  for (int j = 0; j < chain.joints(); ++j) {
    if (!chain.is_prismatic(j)) continue;
    const bool limited = limits.lower.size() > 0 && limits.upper.size() > 0;
    double slide = std::numeric_limits<double>::infinity();
    if (limited) slide = std::max(std::abs(limits.lower(j)), std::abs(limits.upper(j)));
    reach.most += slide;
  }
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

/// Of the last link [m].
double tip_radius(const Problem& problem) {
  return problem.radius_of(problem.chain.links().size() - 1);
}

/// Part of the chord, from its start, that is free before it enters the shape it is known to hit.
double free_part(const Chord& chord, double radius, const CheckedObstacle& obstacle) {
  double low = 0;
  double high = 1;
  for (int i = 0; i < 40; ++i) {  // to 1e-12 of the chord
    const double middle = (low + high) / 2;
    const Vector3d end = chord.a + middle * (chord.b - chord.a);
    (obstacle.penetration(chord.a, end, radius) > 0 ? high : low) = middle;
  }
  return low;
}

/// The tip, as a ball of the last link's radius, and a moving obstacle, each where it is at the time.
class MovingTip {
 public:
  /// @param looks  that may still be taken in the whole scenario
  MovingTip(const Problem& problem, const Task& task, const CheckedObstacle& obstacle, long& looks)
      : radius_(tip_radius(problem)),
        ticks_(problem.ticks),
        task_(task),
        obstacle_(obstacle),
        track_(obstacle.told(), problem.ticks),
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
    const Ellipsoid& shape = obstacle_.told().shape;
    const Vector3d seen = shape.center() + shape.rotation() * tip;
    return obstacle_.clearance(seen, seen) - radius_;
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
  const CheckedObstacle& obstacle_;
  ObstacleTrack track_;
  long& looks_;
};

/// Refuses a tip path that enters a moving obstacle, the two taken at the same time.
void check_moving(const YamlValue& value, const Problem& problem,
                  const std::vector<CheckedObstacle>& obstacles, const Task& task) {
  constexpr long kLooks = 1L << 21;  // seconds of work
  long looks = kLooks;
  for (const CheckedObstacle& obstacle : obstacles) {
    if (!obstacle.moves()) continue;
    const MovingTip moving_tip(problem, task, obstacle, looks);
    for (int tick = 1; tick <= problem.ticks; ++tick) {
      const double entry = moving_tip.entry(tick);
      if (entry < moving_tip.never()) {
        value.fail("a path free of obstacles",
                   fmt::format("one that enters obstacle {} at t = {:.4g} s", obstacle.name(),
                               entry * problem.dt));
      }
      if (looks < 0) {
        value.fail(
            fmt::format("a path that {} looks show to keep out of moving obstacles", kLooks),
            fmt::format("one that keeps too near to obstacle {} for that, until t = {:.4g} s",
                        obstacle.name(), problem.time(tick)));
      }
    }
  }
}

}  // namespace

void check_start(const YamlValue& value, const Problem& problem,
                 const std::vector<TrueObstacle>& truth, const Units& units) {
  const std::vector<YamlValue> values = value.list("joint values");
  for (int j = 0; j < problem.chain.joints(); ++j) {
    const JointLimits& limits = problem.limits;
    const bool below = limits.lower.size() > 0 && problem.start(j) < limits.lower(j);
    const bool above = limits.upper.size() > 0 && problem.start(j) > limits.upper(j);
    if (below || above) {
      const double limit = below ? limits.lower(j) : limits.upper(j);
      const bool slides = problem.chain.is_prismatic(j);
      values[static_cast<std::size_t>(j)].fail(fmt::format(
          "{} {} the limit {}", slides ? "a length" : "an angle", below ? "not below" : "not above",
          slides ? units.show(limit) : units.show_angle(limit)));
    }
  }
  const std::vector<CheckedObstacle> obstacles = checked_obstacles(problem, truth);
  ChainPose pose;
  problem.chain.forward(problem.start, pose);
  for (std::size_t i = 0; i < problem.chain.links().size(); ++i) {
    const Link& link = problem.chain.links()[i];
    for (const CheckedObstacle& obstacle : obstacles) {
      const double shortfall =
          obstacle.penetration(pose.p_WO.col(link.start), pose.p_WO.col(link.end),
                               problem.radius_of(i) + problem.margin);
      if (!(shortfall > 0)) continue;
      const double clearance = problem.margin - shortfall;
      if (clearance < -Judge::kTouching) {
        value.fail("a start free of collision",
                   fmt::format("link {}, {} deep in obstacle {}", link.number,
                               units.show(-clearance), obstacle.name()));
      }
      value.fail("a start that keeps the margin of " + units.show(problem.margin),
                 fmt::format("link {}, {} from obstacle {}", link.number,
                             units.show(std::max(clearance, 0.0)), obstacle.name()));
    }
  }
}

void check_start_orientation(const YamlValue& value, const Problem& problem, double tolerance,
                             const Units& units) {
  constexpr double kDigits = 1e6;
  const Eigen::Matrix3d R =
      JudgeKinematics(problem.chain.description()).tip_rotation(problem.start);
  const double angle = angle_away(problem.task_kind, problem.desired_rotation(0), R);
  if (angle <= tolerance) return;
  const Eigen::Vector4d q =
      (kDigits * Eigen::Quaterniond(R).coeffs()).array().round() / kDigits + 0.0;  // no -0
  value.fail(fmt::format("one that begins within {} of the tip's at the start, quaternion [{:g}, "
                         "{:g}, {:g}, {:g}]",
                         units.show_angle(tolerance), q(3), q(0), q(1), q(2)),
             fmt::format("one that is {} away", units.show_angle(angle)));
}

void check_path(const YamlValue& value, const Problem& problem,
                const std::vector<TrueObstacle>& truth, const Task& task, double start_tolerance,
                const Units& units) {
  const int dimension = problem.dimension();
  ChainPose pose;
  problem.chain.forward(problem.start, pose);
  const Vector3d beginning = point_at(task.path, 0);
  const double start_distance = (beginning - pose.tip()).norm();
  const Reach reach = reach_of(problem.chain.description(), problem.limits);

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
  const std::vector<CheckedObstacle> obstacles = checked_obstacles(problem, truth);
  for (const Chord& piece : pieces) {
    for (const CheckedObstacle& obstacle : obstacles) {
      if (obstacle.moves()) continue;
      const double radius = tip_radius(problem);
      if (!(obstacle.penetration(piece.a, piece.b, radius) > 0)) continue;
      const double s = piece.from + free_part(piece, radius, obstacle) * (piece.to - piece.from);
      value.fail("a path free of obstacles",
                 fmt::format("one that enters obstacle {} at t = {:.4g} s", obstacle.name(),
                             task.duration * fraction_at(task.profile, s)));
    }
  }
  check_moving(value, problem, obstacles, task);
}

}  // namespace bqsa::harness
