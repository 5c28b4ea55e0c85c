/// @file
/// Planners of the Open Motion Planning Library as methods.
#pragma once

#include "bqsa/method.hpp"

namespace bqsa::baselines {

/// `ompl`: KPIECE1 on the manifold of the postures with the tip on the path, or RRT and EST with
/// joint velocities as controls. Time is a coordinate, so that obstacles may move and joints have
/// their velocity limits. Claims success when the trajectory at the ticks passed a check of its own.
MethodEntry ompl_method();

/// `ompl_joint`: RRTConnect in joint space from the start to a posture with the tip at the end of the
/// path, evenly timed. What OMPL does out of the box; it does not follow the path and says so: it
/// claims success only should the tip happen to be on the path at all ticks.
MethodEntry ompl_joint_method();

}  // namespace bqsa::baselines
