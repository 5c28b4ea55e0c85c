/// @file
/// The quadratic-programming rivals.
#pragma once

#include "bqsa/method.hpp"

namespace bqsa::baselines {

/// `qp`: least joint velocity, obstacles as inequalities (Zhang and Wang), by an active set or their dual
/// neural network.
MethodEntry qp_method();

/// `compact_qp`: the drift-free criterion with the tip task eliminated (Cheng, Chen and Sun).
MethodEntry compact_qp_method();

}  // namespace bqsa::baselines
