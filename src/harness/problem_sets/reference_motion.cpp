#include "harness/problem_sets/reference_motion.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "baselines/planning/ompl_motions.hpp"

namespace bqsa::harness {
namespace {

namespace ob = ompl::base;

constexpr double kQuinticPeak = 1.875;  // largest speed of the quintic, of its mean

/// Free motions, and how many were asked for.
class CountedMotions {
 public:
  CountedMotions(const FreeMotion& is_free, long most) : is_free_(is_free), left_(most) {}

  bool is_free(const JointVector& from, const JointVector& to) {
    --left_;
    return is_free_(from, to);
  }
  bool spent() const { return left_ <= 0; }
  void allow(long more) { left_ = more; }

 private:
  const FreeMotion& is_free_;
  long left_;
};

constexpr double kTurn = 2 * std::numbers::pi;  // that a joint without limits may make [rad, m]

/// The limit, or where there is none a turn below the start and all goals.
double lower_bound(const JointVector& start, const std::vector<JointVector>& goals,
                   const JointLimits& limits, Eigen::Index j) {
  if (limits.lower.size() > 0 && std::isfinite(limits.lower(j))) return limits.lower(j);
  double least = start(j);
  for (const JointVector& goal : goals) least = std::min(least, goal(j));
  return least - kTurn;
}

double upper_bound(const JointVector& start, const std::vector<JointVector>& goals,
                   const JointLimits& limits, Eigen::Index j) {
  if (limits.upper.size() > 0 && std::isfinite(limits.upper(j))) return limits.upper(j);
  double most = start(j);
  for (const JointVector& goal : goals) most = std::max(most, goal(j));
  return most + kTurn;
}

std::vector<JointVector> corners_by_rrt(const JointVector& start,
                                        const std::vector<JointVector>& goals,
                                        const JointLimits& limits, CountedMotions& motions,
                                        const ReferenceSettings& settings) {
  baselines::start_ompl(settings.seed);
  const Eigen::Index joints = start.size();
  const auto space = std::make_shared<ob::RealVectorStateSpace>(static_cast<unsigned>(joints));
  ob::RealVectorBounds bounds(static_cast<unsigned>(joints));
  for (Eigen::Index j = 0; j < joints; ++j) {
    const auto i = static_cast<unsigned>(j);
    bounds.setLow(i, lower_bound(start, goals, limits, j));
    bounds.setHigh(i, upper_bound(start, goals, limits, j));
  }
  space->setBounds(bounds);
  const auto information = std::make_shared<ob::SpaceInformation>(space);
  information->setStateValidityChecker([&motions, joints](const ob::State* state) {
    const JointVector q = baselines::joints_of(state, joints);
    return motions.is_free(q, q);
  });
  information->setMotionValidator(std::make_shared<baselines::StraightMotions>(
      information, [&motions](const JointVector& from, const JointVector& to) {
        return motions.is_free(from, to);
      }));
  information->setup();

  const auto goal = std::make_shared<ob::GoalStates>(information);
  for (const JointVector& q : goals) goal->addState(baselines::state_of(space, q));
  const baselines::Stop spent = [&motions] { return motions.spent(); };
  const auto path = baselines::rrt_connect(information, start, goal, 0, spent);
  if (!path) return {};
  motions.allow(settings.most_checks);
  return baselines::simplified(*path, goal, spent);
}

}  // namespace

std::vector<JointVector> plan_reference(const JointVector& start,
                                        const std::vector<JointVector>& goals,
                                        const JointLimits& limits, const FreeMotion& is_free,
                                        const ReferenceSettings& settings) {
  CountedMotions motions(is_free, settings.most_checks);
  for (const JointVector& goal : goals) {
    if (motions.is_free(start, goal)) return {start, goal};
  }
  std::vector<JointVector> corners = corners_by_rrt(start, goals, limits, motions, settings);
  for (std::size_t k = 1; k < corners.size(); ++k) {
    if (!is_free(corners[k - 1], corners[k])) return {};
  }
  return corners;
}

Trajectory timed_reference(const std::vector<JointVector>& corners, const JointLimits& limits,
                           const ReferenceSettings& settings) {
  // Time at full speed from the first corner to each [s].
  std::vector<double> reached = {0};
  for (std::size_t k = 1; k < corners.size(); ++k) {
    const Eigen::ArrayXd change = (corners[k] - corners[k - 1]).array().abs();
    reached.push_back(reached.back() + (change / limits.max_velocity.array()).maxCoeff());
  }
  const double whole = reached.back();
  const double duration = std::max(kQuinticPeak * whole / settings.speed, settings.tick);
  const int ticks = static_cast<int>(std::ceil(duration / settings.tick));
  Trajectory motion;
  std::size_t leg = 1;  // leads to corner `leg`
  for (int tick = 0; tick <= ticks; ++tick) {
    const double s = static_cast<double>(tick) / ticks;
    const double now = whole * (s * s * s * (10 + s * (6 * s - 15)));
    while (leg + 1 < corners.size() && reached[leg] < now) ++leg;
    const double time_of_leg = reached[leg] - reached[leg - 1];
    const double part =
        time_of_leg > 0 ? std::clamp((now - reached[leg - 1]) / time_of_leg, 0.0, 1.0) : 0;
    motion.t.push_back(tick * duration / ticks);
    motion.q.push_back((1 - part) * corners[leg - 1] + part * corners[leg]);
  }
  return motion;
}

}  // namespace bqsa::harness
