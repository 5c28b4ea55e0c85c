/// @file
/// The closest-point rivals at their best: exact or library distances, moving obstacles' velocity,
/// link radius and margin.
#pragma once

#include "bqsa/method.hpp"

namespace bqsa::baselines {

/// `maciejewski_klein`: the law of Maciejewski and Klein on the closest points that `closest` finds:
/// the exact distance, test points (scalar or vectorised), or FCL.
MethodEntry maciejewski_klein_method();

/// `fcl_gp`: FCL's distances and nearest points with gradient projection.
MethodEntry fcl_gp_method();

}  // namespace bqsa::baselines
