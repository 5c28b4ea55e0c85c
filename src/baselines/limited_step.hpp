/// @file
/// Steps that keep the limits of the joints, for laws that do not know of limits.
#pragma once

#include "bqsa/method.hpp"

namespace bqsa::baselines {

/// What is done if a joint's step of one tick would exceed its limit or leave its range.
enum class StepLimit {
  kHold,   ///< the method gives up
  kScale,  ///< only as much of the avoidance is made as fits: the tip stays on its path
};

/// The choice `step_limit` between `scale`, the default, and `hold`.
ParameterDeclaration step_limit_parameter();
StepLimit read_step_limit(const ParameterValues& values);

/// Largest k in [0, 1] for which the step tracking + k avoidance [rad] from q keeps the joint limits
/// and the largest steps; negative if none does.
double fitting_part(const Problem& problem, const JointVector& q, const JointVector& tracking,
                    const JointVector& avoidance);

/// Ends a tick: makes the step of both joint velocities [rad/s], or gives up. Claims nothing.
void make_step(const Problem& problem, const StepInput& input, const JointVector& tracking,
               const JointVector& avoidance, StepLimit step_limit, StepOutput& output);

}  // namespace bqsa::baselines
