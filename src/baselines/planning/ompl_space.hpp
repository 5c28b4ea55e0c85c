/// @file
/// States (W s, q) of OMPL, seen as postures at times. Includes headers of OMPL.
#pragma once

#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/ProjectionEvaluator.h>
#include <ompl/base/goals/GoalRegion.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "baselines/planning/planning_scene.hpp"

namespace bqsa::baselines {

/// Between (W s, q) and (t, q), s = t / duration.
struct TimeScale {
  double scale;     ///< W [rad]
  double duration;  ///< [s]
  double dt;        ///< control period [s]
  Eigen::Index joints;

  TimeScale(const Problem& problem, double time_scale)
      : scale(time_scale),
        duration(problem.duration()),
        dt(problem.dt),
        joints(problem.chain.joints()) {}

  double time(double coordinate) const { return coordinate / scale * duration; }
  double coordinate(double t) const { return t / duration * scale; }
  int nearest_tick(double t) const { return static_cast<int>(std::lround(t / dt)); }

  TimedPosture read(const double* x) const {
    return {.t = time(x[0]), .q = Eigen::Map<const Eigen::VectorXd>(x + 1, joints)};
  }
  void write(const TimedPosture& posture, double* x) const {
    x[0] = coordinate(posture.t);
    Eigen::Map<Eigen::VectorXd>(x + 1, joints) = posture.q;
  }
};

/// Bounds of (W s, q) up to a multiple of the duration; joints without limits may turn by pi either
/// way from the start.
inline ompl::base::RealVectorBounds bounds_of(const Problem& problem, double time_scale,
                                              double durations) {
  ompl::base::RealVectorBounds bounds(static_cast<unsigned>(problem.chain.joints()) + 1);
  bounds.setLow(0, 0);
  bounds.setHigh(0, durations * time_scale);
  for (int j = 0; j < problem.chain.joints(); ++j) {
    const auto i = static_cast<unsigned>(j) + 1;
    const JointLimits& limits = problem.limits;
    const bool limited = limits.lower.size() > 0 && limits.upper.size() > 0;
    bounds.setLow(i, limited ? limits.lower(j) : problem.start(j) - std::numbers::pi);
    bounds.setHigh(i, limited ? limits.upper(j) : problem.start(j) + std::numbers::pi);
  }
  return bounds;
}

/// The end of the path, in any posture.
/// @tparam Values  function object: the coordinates of a state
template <typename Values>
class EndOfPath final : public ompl::base::GoalRegion {
 public:
  EndOfPath(const ompl::base::SpaceInformationPtr& information, double time_scale)
      : ompl::base::GoalRegion(information), time_scale_(time_scale) {
    constexpr double kRounding = 1e-9;
    threshold_ = kRounding * time_scale;
  }
  double distanceGoal(const ompl::base::State* state) const override {
    return time_scale_ - Values()(state)[0];
  }

 private:
  double time_scale_;
};

/// (W s, q_1, q_2): along the path, and the joints that move most of the arm.
template <typename Values>
class TimeAndFirstJoints final : public ompl::base::ProjectionEvaluator {
 public:
  /// @param cell_time   of W s [rad]
  /// @param cell_joint  of q_1 and q_2 [rad]
  TimeAndFirstJoints(const ompl::base::StateSpacePtr& space, double cell_time, double cell_joint)
      : ompl::base::ProjectionEvaluator(space.get()),
        dimension_(std::min(3U, space->getDimension())) {
    cellSizes_.assign(dimension_, cell_joint);
    cellSizes_[0] = cell_time;
  }
  unsigned int getDimension() const override { return dimension_; }
  void project(const ompl::base::State* state,
               Eigen::Ref<Eigen::VectorXd> projection) const override {
    for (unsigned i = 0; i < dimension_; ++i) projection[i] = Values()(state)[i];
  }

 private:
  unsigned dimension_;
};

}  // namespace bqsa::baselines
