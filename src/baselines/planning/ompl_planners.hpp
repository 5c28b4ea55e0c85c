/// @file
/// The planners of OMPL as this project uses them. No header of OMPL is needed to call them.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "baselines/planning/planning_scene.hpp"

namespace bqsa::baselines {

/// Time to stop; asked again and again.
using Stop = std::function<bool()>;

/// Seeds the generator from which all random numbers of OMPL come, and silences its messages. To be
/// called before anything of OMPL is made; the same seed gives the same plans.
void start_ompl(std::uint64_t seed);

enum class Hops {
  kDelta,  ///< a motion is traced in steps of `delta`, as ProjectedStateSpace does it
  kTick,   ///< a motion is traced from tick to tick: what it passes are rows of the trajectory
};

enum class Sampling {
  kForward,  ///< near states: later, and within reach of the joint velocities
  kNear,     ///< near states: anywhere in the box around, as ProjectedStateSpace does it
};

/// Of planning in (W s, q), s = t / duration.
struct ConstrainedSettings {
  Hops hops = Hops::kDelta;
  Sampling sampling = Sampling::kForward;
  double time_scale = 2;    ///< W: what the whole duration counts in distances [rad]
  double range = 0.6;       ///< of one motion [rad]
  double delta = 0.05;      ///< step on the manifold, of Hops::kDelta [rad]
  double cell_time = 0.05;  ///< size of a projection cell along the path, as a part of it [-]
  double cell_joint = 0.3;  ///< size of a projection cell in joints 1 and 2 [rad]
  bool simplify = true;
};

/// KPIECE1 on the manifold of the postures whose tips are on the path at their time
/// (ompl::base::ProjectedStateSpace).
/// @param first  where the way begins, on the path and allowed
/// @return postures on the path up to the last tick, all motions between them allowed by the scene;
///   empty if none was found
std::vector<TimedPosture> plan_on_manifold(PlanningScene& scene, const TimedPosture& first,
                                           const ConstrainedSettings& settings, const Stop& stop);

enum class ControlPlanner { kRrt, kEst };

/// Of planning with joint velocities as controls, in (W s, q) too.
struct ControlSettings {
  ControlPlanner planner = ControlPlanner::kRrt;
  double time_scale = 10;   ///< W [rad]
  double cell_time = 0.05;  ///< as above, of EST [-]
  double cell_joint = 0.3;  ///< as above, of EST [rad]
  double self_motion = 1;   ///< largest joint velocity of a control, within the limits [rad/s]
  int hold_ticks = 30;      ///< longest time for which a control is held [ticks]
};

/// A control-based planner: controls are joint velocities, of which the part that moves the tip is
/// removed; the tip is put onto the path at every tick.
/// @return as plan_on_manifold(): one posture a tick
std::vector<TimedPosture> plan_with_controls(PlanningScene& scene, const TimedPosture& first,
                                             const ControlSettings& settings, const Stop& stop);

/// RRTConnect in joint space, obstacles as they are at t = 0, from the problem's start to a free
/// posture with the tip at the end of the path. On its way the tip is wherever the joints have it.
/// @param range  of one motion [rad]; 0 for OMPL's own choice
/// @return corner postures, straight motions between them free; empty if none were found
std::vector<JointVector> plan_in_joint_space(PlanningScene& scene, double range, const Stop& stop);

}  // namespace bqsa::baselines
