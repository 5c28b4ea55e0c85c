/// @file
/// How good a motion is beyond success: figures of the joint trajectory alone, which decide nothing.
#pragma once

#include <limits>

#include "bqsa/method.hpp"
#include "bqsa/problem.hpp"

namespace bqsa::harness {

/// Figures of a motion, not a number where there is none. All but the drift are of the ticks from 1
/// on, as tip errors are: the motion to tick 1 leads from the start onto the path.
struct MotionQuality {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  /// Joint drift q(T) - q(0) after a closed path: not zero if the method resolves the redundancy in a
  /// way that is not repeatable (Klein and Huang 1983). A turn by 2 pi counts as one. Of runs with
  /// all ticks whose path is closed, x_d(T) = x_d(0), and begins at the start's tip, both within the
  /// tolerance. Its norm, and its largest joint [rad].
  double closed_path_drift = kNone;
  double closed_path_drift_joint = kNone;

  /// Manipulability sqrt(det(J J')) of the position Jacobian J (Yoshikawa 1985): the volume, but for
  /// a constant, of the tip velocities within reach of unit joint rates. Least and mean over the
  /// ticks [m², in space m³].
  double manipulability_min = kNone;
  double manipulability_mean = kNone;
  double singular_value_min = kNone;  ///< least singular value of J at a tick [m]

  /// Part of the joint motion that does not move the tip: sum |N dq|² / sum |dq|² over the steps dq
  /// from tick to tick, N = I - J^+ J at the middle of the step (q + dq / 2). Directions whose
  /// singular value is at most 1e-9 of the largest do not move the tip. None if nothing moves [-].
  double null_space_share = kNone;

  /// Root mean square, over joints and ticks, of the third difference of the joint angles over dt³:
  /// a measure of chattering. Needs four ticks [rad/s³].
  double jerk_rms = kNone;
};

/// Shares no code with src/bqsa but the plain data it reads.
/// @param rows  of the trajectory that can be judged, Judgement::rows
MotionQuality motion_quality(const Problem& problem, const Trajectory& trajectory, int rows);

}  // namespace bqsa::harness
