/// @file
/// Straight joint motions as OMPL plans them. Includes headers of OMPL.
#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/goals/GoalStates.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/PathGeometric.h>

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "baselines/planning/ompl_planners.hpp"
#include "bqsa/problem.hpp"

namespace bqsa::baselines {

/// Whether a straight joint motion is allowed.
using AllowedMotion = std::function<bool(const JointVector& from, const JointVector& to)>;

using JointState = ompl::base::ScopedState<ompl::base::RealVectorStateSpace>;

/// The joints of a state of a RealVectorStateSpace [rad, m].
JointVector joints_of(const ompl::base::State* state, Eigen::Index joints);

JointState state_of(const ompl::base::StateSpacePtr& space, const JointVector& q);

/// Valid motions as a whole or not at all: of one that is not nothing is kept.
class WholeMotions : public ompl::base::MotionValidator {
 public:
  using MotionValidator::checkMotion;
  using MotionValidator::MotionValidator;

  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to,
                   std::pair<ompl::base::State*, double>& last_valid) const final;
};

/// Straight motions between states of a RealVectorStateSpace that end within its bounds and are
/// allowed.
class StraightMotions final : public WholeMotions {
 public:
  StraightMotions(const ompl::base::SpaceInformationPtr& information, AllowedMotion allowed)
      : WholeMotions(information), allowed_(std::move(allowed)) {}

  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to) const override;
  using WholeMotions::checkMotion;

 private:
  AllowedMotion allowed_;
};

/// RRT-Connect (Kuffner and LaValle, ICRA 2000) as OMPL has it.
/// @param information  set up, of a RealVectorStateSpace
/// @param range  of one motion [rad]; 0 for OMPL's own choice
/// @return empty if none was found
std::optional<ompl::geometric::PathGeometric> rrt_connect(
    const ompl::base::SpaceInformationPtr& information, const JointVector& start,
    const ompl::base::GoalPtr& goal, double range, const Stop& stop);

/// Corners of the path after OMPL's PathSimplifier has shortened and smoothed it.
std::vector<JointVector> simplified(ompl::geometric::PathGeometric path,
                                    const ompl::base::GoalPtr& goal, const Stop& stop);

}  // namespace bqsa::baselines
