/// @file
/// Figs. 10 and 17 of the paper: the path of the tip.
#pragma once

#include "harness/figures/figure.hpp"
#include "harness/figures/judged_run.hpp"

namespace bqsa::harness {

/// Figs. 10 and 17: desired and actual path of the tip, and the deviation enlarged, of two methods side
/// by side. Paths in the plane of x and y in a planar scenario, of y and z in space.
Figure planar_trajectory(const JudgedRun& first, const JudgedRun& second);
Figure spatial_trajectory(const JudgedRun& first, const JudgedRun& second);

}  // namespace bqsa::harness
