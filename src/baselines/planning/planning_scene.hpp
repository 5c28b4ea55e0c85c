/// @file
/// What every planner asks about one problem, and what it may claim in the end.
#pragma once

#include <vector>

#include "baselines/planning/motion_check.hpp"
#include "baselines/planning/path_task.hpp"
#include "bqsa/method.hpp"
#include "bqsa/problem.hpp"
#include "bqsa/work_counters.hpp"

namespace bqsa::baselines {

/// A posture at a time.
struct TimedPosture {
  double t = 0;   ///< [s]
  JointVector q;  ///< [rad]
};

/// What planners keep beyond what the problem asks for. Solutions need not keep it.
struct PlanningReserve {
  double clearance = 0;  ///< added to margin and link radius [m]
  double speed = 1;      ///< share of the joint velocity limits that may be used [-]
};

/// The path task, the collision check and the limits of one problem, the counters shared.
class PlanningScene {
 public:
  /// Problem and counters must outlive the scene.
  PlanningScene(const Problem& problem, const PlanningReserve& reserve, WorkCounters& counters);
  PlanningScene(const PlanningScene&) = delete;
  PlanningScene& operator=(const PlanningScene&) = delete;

  const Problem& problem() const { return problem_; }
  WorkCounters& counters() { return counters_; }
  PathTask& task() { return task_; }

  /// Largest way of joint j in `ticks` control periods, a whole number or not [rad].
  double largest_way(int joint, double ticks) const {
    return reserve_.speed * problem_.max_step(joint) * ticks;
  }

  /// Whether no joint has to be faster than allowed to get from one posture to a later one.
  bool in_time(const TimedPosture& from, const TimedPosture& to) const;

  /// Whether the posture keeps joint limits and clearance.
  bool allows(const TimedPosture& posture);

  /// Whether the straight joint motion between two postures is in time and free, and ends within the
  /// joint limits.
  bool allows(const TimedPosture& from, const TimedPosture& to);

  /// Whether the straight joint motion is free of the obstacles as they are at t = 0.
  bool is_free_at_rest(const JointVector& q0, const JointVector& q1) {
    return with_reserve_.is_free(0, q0, 0, q1);
  }

  /// Where planning begins: the first tick, at which the start's own tip error is gone.
  /// @return whether the motion to it is allowed
  bool first_tick(TimedPosture& first);

  /// Joint angles at all ticks of a way that begins at the first tick: interpolated between its
  /// postures and put onto the path. Row 0 is the problem's start.
  /// @return whether all of them could be put there
  bool at_ticks(const std::vector<TimedPosture>& way, Trajectory& trajectory);

  /// Whether the trajectory solves the problem itself, without reserve: rows from the start to the
  /// last tick, tips within tolerance, steps and joint limits kept, motions between ticks free.
  bool solves(const Trajectory& trajectory);

 private:
  const Problem& problem_;
  const Problem roomier_;  ///< the problem with the reserve's clearance in its margin
  PlanningReserve reserve_;
  WorkCounters& counters_;
  PathTask task_;
  MotionCheck with_reserve_;
  MotionCheck plain_;
};

}  // namespace bqsa::baselines
