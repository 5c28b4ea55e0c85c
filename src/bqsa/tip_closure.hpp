/// @file
/// Putting the tip back onto its path after a first-order step.
#pragma once

#include "bqsa/bqsa_settings.hpp"
#include "bqsa/tip_task.hpp"
#include "bqsa/work_counters.hpp"

namespace bqsa {

/// Newton corrections by the hybrid IK with W = I, phi = 0: the least-norm steps that bring the tip of
/// q to p_WT, turned as the task wants it. At most settings.corrections of them, until the error is below settings.tip_tolerance.
/// Damping may cost no more than that tolerance, or it would keep the last part of an error for ever.
/// While corrections are so small that the Jacobian hardly changes, they go on with the same one.
///
/// @param dt    control period, the time in which one correction is made [s]
/// @param ik    of the Jacobian at a configuration close to q, with which corrections start
/// @param error_before  of the tip at that configuration [m]
/// @param q     joint angles, changed in place [rad]
/// @param pose  of q before and after the call; before it may be of `forward_from`
/// @return the remaining tip error, TipTask::distance [m]
/// Does not allocate.
double close_tip(const TipTask& task, const Eigen::Vector3d& p_WT, double dt,
                 const BqsaSettings& settings, const TrackingIk& ik, double error_before,
                 JointVector& q, ChainPose& pose, WorkCounters& counters);

/// The same with nothing known.
double close_tip(const TipTask& task, const Eigen::Vector3d& p_WT, double dt,
                 const BqsaSettings& settings, JointVector& q, ChainPose& pose,
                 WorkCounters& counters);

}  // namespace bqsa
