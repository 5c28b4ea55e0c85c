/// @file
/// Figs. 10 to 12 and 17 to 19 of the paper: how well the tip follows its path, and the joint angles.
#pragma once

#include "harness/figures/figure.hpp"
#include "harness/figures/judged_run.hpp"

namespace bqsa::harness {

/// Figs. 10 and 17: desired and actual path of the tip, and the deviation enlarged, of two methods side
/// by side. Paths in the plane of x and y in a planar scenario, of y and z in space.
Figure planar_trajectory(const JudgedRun& first, const JudgedRun& second);
Figure spatial_trajectory(const JudgedRun& first, const JudgedRun& second);

/// Figs. 11 and 18: the tip error along each axis over time, at ticks and between them. The start is
/// left out: it is off the path by what the scenario says, not by what the method does.
Figure planar_errors(const JudgedRun& first, const JudgedRun& second);
Figure spatial_errors(const JudgedRun& first, const JudgedRun& second);

/// Figs. 12 and 19: joint angles over time, and below them the joint velocities of each tick.
Figure planar_joint_angles(const JudgedRun& first, const JudgedRun& second);
Figure spatial_joint_angles(const JudgedRun& first, const JudgedRun& second);

}  // namespace bqsa::harness
