/// @file
/// A planner that needs no library: a population of motions along the path, spread over self-motions.
#pragma once

#include "bqsa/method.hpp"

namespace bqsa::baselines {

/// `self_motion_search`: all motions of a population follow the path together, in layers of a few
/// ticks. Each layer grows every survivor by random self-motions; what leaves limits or is not
/// certified free is dropped, and of the rest the ones that differ most are kept. A population that
/// dies out starts again, twice as large, until the time is up. Of the motions that reach the end,
/// the one that moved its joints least is the plan. Every row is on the path and every motion between
/// two rows is certified, so that a plan claimed as solved needs no further check.
MethodEntry self_motion_search_method();

}  // namespace bqsa::baselines
