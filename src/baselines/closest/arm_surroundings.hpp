/// @file
/// The arm at one configuration, and how its links get away from the obstacles near it: what every
/// law of avoidance starts from.
#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "baselines/closest/closest_point_search.hpp"
#include "bqsa/hybrid_ik.hpp"
#include "bqsa/method.hpp"
#include "bqsa/tip_task.hpp"

namespace bqsa::baselines {

/// How a link gets away from an obstacle near it.
struct Escape {
  int link = 0;          ///< index into SerialChain::links
  int obstacle = 0;      ///< index into Problem::obstacles
  double clearance = 0;  ///< distance less link radius and margin [m]
  double approach = 0;   ///< speed at which the obstacle comes after the link [m/s]
  JointVector
      j0;  ///< uᵀJ0: j0 q_dot is the speed of the link's closest point, away from it [m/rad]
};

struct SurroundingsSettings {
  double influence = 0.05;         ///< d_m: clearance below which an obstacle counts as near [m]
  double exempt_length = 0.1;      ///< part of the last link, from the tip, that may be near [m]
  bool all_pairs = false;          ///< all pairs within influence, not each obstacle's closest
  bool obstacle_velocity = false;  ///< Escape::approach of moving obstacles, else 0
};

/// The length `exempt_length`.
ParameterDeclaration exempt_length_parameter(double default_value);

/// The choice `points` between `closest` and `all`.
ParameterDeclaration acting_points_parameter(bool all_pairs_by_default);
/// What was chosen.
bool read_all_pairs(const ParameterValues& values);

/// Nothing but `assign` allocates.
class ArmSurroundings {
 public:
  explicit ArmSurroundings(std::unique_ptr<ClosestPointSearch> search)
      : search_(std::move(search)) {}

  /// Problem and counters must outlive this.
  void assign(const Problem& problem, const SurroundingsSettings& settings, WorkCounters& counters);

  /// The arm is at q, the obstacles where they are at the start of this tick.
  void look(int tick, const JointVector& q);

  const ChainPose& pose() const { return pose_; }

  /// Rows of the tip's task (TipTask), or of a point of the chain; made once a look.
  const TaskJacobian& task_jacobian();
  const TaskJacobian& jacobian(int point);

  /// x_dot that brings the tip to where it is desired within the tick [m/s].
  TaskVector task_velocity(const StepInput& input);

  /// Je⁺ xe: joint velocity of plain tracking, the hybrid inverse kinematics with W = I and phi = 0,
  /// closed over the tip error; kept until the next call [rad/s].
  const JointVector& track(const StepInput& input);

  /// Of obstacles within influence, obstacle by obstacle and from base to tip.
  const std::vector<Escape>& escapes() const { return escapes_; }

  /// Adds a link and its obstacle to those that were moved apart in the tick.
  void record(const Escape& escape, StepOutput& output) const;

 private:
  void keep_closest_of_each_obstacle();
  double radius_of(const ClosestPoint& point) const {  // of its link [m]
    return problem_->radius_of(static_cast<std::size_t>(point.link));
  }
  Escape escape(const ClosestPoint& point, int tick);

  std::unique_ptr<ClosestPointSearch> search_;
  SurroundingsSettings settings_;
  const Problem* problem_ = nullptr;
  WorkCounters* counters_ = nullptr;
  std::vector<ClosestPoint> points_;
  std::vector<Escape> escapes_;
  ChainPose pose_;
  JointVector no_weights_;
  JointVector no_clamping_;
  HybridIkResult ik_;
  std::array<TaskJacobian, kMaxPoints> J_points_;  // valid where J_known_, since the last look
  std::array<bool, kMaxPoints> J_known_{};
  TipTask task_;
  TaskJacobian J_task_;  // of a task with an orientation; valid where known, since the last look
  bool J_task_known_ = false;
};

/// Velocity of the obstacle's material point that is at p [m] at tick - 1, over the tick [m/s].
Eigen::Vector3d velocity_at(const Obstacle& obstacle, int tick, double dt,
                            const Eigen::Vector3d& p);

}  // namespace bqsa::baselines
