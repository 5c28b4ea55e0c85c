/// @file
/// Tracking without avoidance: the control that shows which links would hit what.
#pragma once

#include "bqsa/method.hpp"

namespace bqsa::baselines {

/// `none`: the hybrid inverse kinematics with W = I and phi = 0, closed over the tip error. It
/// never looks at the obstacles.
MethodEntry plain_tracking_method();

}  // namespace bqsa::baselines
