/// @file
/// A collision-free motion between two configurations, with times: the reference that a tracking
/// problem's path is taken from.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "bqsa/method.hpp"
#include "bqsa/problem.hpp"

namespace bqsa::harness {

/// Whether a straight joint motion collides with nothing; the same configuration twice asks for it
/// alone.
using FreeMotion = std::function<bool(const JointVector& from, const JointVector& to)>;

struct ReferenceSettings {
  std::uint64_t seed = 1;
  long most_checks = 20'000;  ///< of motions, until the planner gives up
  double speed = 0.5;         ///< largest joint speed, as a part of the limit [-]
  double tick = 0.02;         ///< control period, at most [s]
};

/// The straight motion where it is free, else RRT-Connect (Kuffner and LaValle, ICRA 2000) as OMPL
/// has it, its path shortened and smoothed by OMPL's PathSimplifier. Corners of the path, the first
/// `start`, the last one of the goals; every straight motion between them was free.
///
/// The same seed gives the same corners: effort is limited by counting, not by a clock.
/// @param limits  a joint without may make a turn beyond start and goals
/// @return empty if none was found
std::vector<JointVector> plan_reference(const JointVector& start,
                                        const std::vector<JointVector>& goals,
                                        const JointLimits& limits, const FreeMotion& is_free,
                                        const ReferenceSettings& settings);

/// The corners with times, rows at the ticks: the way along them as a quintic of time (10 s³ - 15 s⁴ + 6
/// s⁵), at rest at both ends, so slow that no joint exceeds its part of the speed limit on the way
/// from one corner to the next. Steps may cut corners.
/// @param limits  with finite largest velocities for all joints
Trajectory timed_reference(const std::vector<JointVector>& corners, const JointLimits& limits,
                           const ReferenceSettings& settings);

}  // namespace bqsa::harness
