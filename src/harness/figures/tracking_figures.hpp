/// @file
/// Figs. 11, 12, 18 and 19 of the paper: tip errors and joint angles over time.
#pragma once

#include "harness/figures/figure.hpp"
#include "harness/figures/judged_run.hpp"

namespace bqsa::harness {

/// Figs. 11 and 18: the tip error along each axis over time, at ticks and between them. The start is
/// left out: it is off the path by what the scenario says, not by what the method does.
Figure planar_errors(const JudgedRun& first, const JudgedRun& second);
Figure spatial_errors(const JudgedRun& first, const JudgedRun& second);

/// Figs. 12 and 19: joint angles over time, and below them the joint velocities of each tick.
Figure planar_joint_angles(const JudgedRun& first, const JudgedRun& second);
Figure spatial_joint_angles(const JudgedRun& first, const JudgedRun& second);

}  // namespace bqsa::harness
