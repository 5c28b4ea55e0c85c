/// @file
/// The tip task as planners see it: postures whose tip is on the path at a given time.
#pragma once

#include "bqsa/problem.hpp"
#include "bqsa/work_counters.hpp"

namespace bqsa::baselines {

/// Puts postures on the path of one problem and removes from joint velocities what moves the tip.
class PathTask {
 public:
  /// Tip error at which a posture counts as on the path [m].
  static constexpr double kOnPath = 1e-9;

  /// Problem and counters must outlive the task.
  void assign(const Problem& problem, WorkCounters& counters);

  /// Newton corrections of least norm, none larger than 0.2 rad a joint, until the tip of q [rad] is
  /// on x_d(t). Time stays as it is.
  /// @return whether it is; else q is unspecified. Limits are not looked at. Does not allocate.
  bool close(double t, JointVector& q);

  /// The part of a joint velocity that does not move the tip of q. Does not allocate.
  JointVector self_motion(const JointVector& q, const JointVector& velocity);

  /// Distance of the tip of q from x_d(t) [m].
  double error(double t, const JointVector& q);

 private:
  void look(const JointVector& q);
  void find_jacobian();

  const Problem* problem_ = nullptr;
  WorkCounters* counters_ = nullptr;
  ChainPose pose_;
  TaskJacobian J_;
};

}  // namespace bqsa::baselines
