/// @file
/// The paper's opponent: avoidance on the closest pair of test points (Maciejewski and Klein 1985).
#pragma once

#include "bqsa/method.hpp"

namespace bqsa::baselines {

/// `test_point`: every link carries N test points and every obstacle's surface M; each tick
/// searches all N x M pairs of each link and obstacle for the closest one by brute force, and
/// pushes the closest link point of each obstacle away within the null space of the tip task, by
/// Maciejewski and Klein's law or by gradient projection (parameter `law`). Of a moving obstacle it
/// takes the place at the start of the step, where the arm is too; the obstacle's velocity is not
/// used. Gives up where a joint's step would be too large.
MethodEntry test_point_method();

}  // namespace bqsa::baselines
