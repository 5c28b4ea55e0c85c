/// @file
/// Figs. 8, 14, 15 and 20 of the paper: the arm on its way among the obstacles.
#pragma once

#include "harness/figures/figure.hpp"
#include "harness/figures/judged_run.hpp"

namespace bqsa::harness {

/// Fig. 8: postures in the plane, of two methods side by side.
/// @param first, second  runs of the same planar scenario
Figure planar_configurations(const JudgedRun& first, const JudgedRun& second);

/// Fig. 14: the same in space, projected on the plane XOZ, the obstacles as their shadows.
Figure projected_configurations(const JudgedRun& first, const JudgedRun& second);

/// Fig. 15: postures in space, the obstacles as wireframes.
Figure spatial_configurations(const JudgedRun& first, const JudgedRun& second);

/// Fig. 20: the same at the wall.
Figure wall_configurations(const JudgedRun& first, const JudgedRun& second);

}  // namespace bqsa::harness
