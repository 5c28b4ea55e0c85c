/// @file
/// Orocos KDL tracking a path without obstacles, as whoever uses it writes a control loop: forward
/// kinematics, the tip's error, a velocity step by `ChainIkSolverVel_wdls`.
#pragma once

#include <memory>

#include "bqsa/problem.hpp"

namespace bqsa::harness {

/// What KDL is asked for.
enum class KdlTask {
  kPosition,  ///< the tip's position; rows of the other directions have weight 0 and cost as much
  kPose,      ///< position, and orientation as at the start: all six rows
};

/// The arm executes what the solver answers, as in a ControlLoop.
class KdlControlLoop {
 public:
  /// @param problem  repeats itself after kBystanderPeriod ticks; its obstacles are not seen
  KdlControlLoop(const Problem& problem, KdlTask task);
  ~KdlControlLoop();

  /// Runs on for so many ticks.
  void run(int ticks);

  double tip_error() const;   ///< distance of the tip from its desired position now [m]
  double turn_error() const;  ///< angle between the tip's orientation and that at the start [rad]

 private:
  struct Solvers;
  std::unique_ptr<Solvers> solvers_;
};

}  // namespace bqsa::harness
