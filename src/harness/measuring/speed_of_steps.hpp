/// @file
/// Times of whole control steps beside those of the kinematics that no step can do without: the sweep
/// `speed_steps`. An arm goes to and fro among obstacles that it does not come near (bystanders.hpp).
#pragma once

#include <string_view>

#include "harness/measuring/contest.hpp"
#include "harness/measuring/sweep.hpp"

namespace bqsa::harness {

inline constexpr std::string_view kSpeedOfSteps = "speed_steps";

/// Series `ARM:WHAT`, ARM being `planar_7r` or `puma560`:
/// - `kinematics`: forward kinematics of all end-points and the tip's Jacobian;
/// - `plain_kinematics`: the same as textbooks have it (plain_kinematics.hpp);
/// - `bqsa_8`, `bqsa_64`: a control step of `bqsa` among so many obstacles;
/// - `bqsa_8_once`, `bqsa_64_once`: the same with one correction of the tip's error at most;
/// - `bqsa_paper_8`, `bqsa_paper_64`, of planar_7r: the paper's own step, of first order: it does not correct
///   the tip, nor looks at the motion between ticks;
/// - `kdl`: a step of Orocos KDL (kdl_control_loop.hpp), without obstacles: with two task rows of weight 1
///   for planar_7r, with the full task of six rows for puma560.
/// @param sweep  named, empty
/// @throws std::runtime_error if a loop does not follow its path
void measure_speed_of_steps(const ContestSettings& settings, Sweep& sweep);

}  // namespace bqsa::harness
