/// @file
/// Joint limits as a clamping constraint of the hybrid inverse kinematics: what the paper expects of
/// its scheme (section 5) beside obstacles, with the clamping velocity of section 2.2.
#pragma once

#include "bqsa/problem.hpp"

namespace bqsa {

struct JointLimitClamp {
  double band =
      0;  ///< part of a joint's range at either end in which it is sent back; 0: never [-]
  double gain = 5;  ///< speed for each radian or metre into the band [1/s]
};

/// The clamping velocity phi [rad/s, m/s]: for every joint within the band of one of its limits
/// `gain` times the way into it, away from the limit, and at most what leaves the band in one tick; 0 for
/// all others, and for joints without two limits. False if it is 0 for all.
bool clamp_at_limits(const Problem& problem, const JointLimitClamp& clamp, const JointVector& q,
                     JointVector& phi);

/// The largest part, 0 to 1, of a self-motion that can be added to a velocity while every joint keeps
/// its largest step: of a velocity that already exceeds it, 0.
/// @param q_dot        [rad/s, m/s]
/// @param self_motion  [rad/s, m/s]
double part_within_steps(const Problem& problem, const JointVector& q_dot,
                         const JointVector& self_motion);

}  // namespace bqsa
