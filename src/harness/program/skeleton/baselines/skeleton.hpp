/// @file
/// `skeleton`: closed-loop tracking, with links pushed away from obstacles that are near.
#pragma once

#include "bqsa/method.hpp"

namespace bqsa::baselines {

/// `skeleton`: the hybrid inverse kinematics, closed over the tip error, with self-motions away from
/// obstacles that are nearer than `influence`. Claims nothing.
MethodEntry skeleton_method();

}  // namespace bqsa::baselines
