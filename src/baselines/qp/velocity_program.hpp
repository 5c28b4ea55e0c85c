/// @file
/// The joint velocity of one tick as a quadratic program: tip task, limits and obstacles as rows.
#pragma once

#include <array>
#include <vector>

#include "baselines/closest/arm_surroundings.hpp"
#include "baselines/qp/quadratic_program.hpp"

namespace bqsa::baselines {

/// How fast a link may come closer to an obstacle within influence.
enum class ApproachLimit {
  kDamped,  ///< gain (d - d_s): the velocity damper of Faverjon and Tournassoud (1987)
  kNone,    ///< not at all
};

struct VelocityProgramSettings {
  ApproachLimit approach = ApproachLimit::kDamped;
  double safe_distance = 0.005;  ///< d_s: clearance at which links come no closer [m]
  double gain = 10;              ///< of the damper [1/s]
  bool equalities = false;       ///< links closer than d_s escape just as fast as the damper asks
  double max_velocity = 10;      ///< of every joint, beside the problem's limits [rad/s]
  double drift_gain = 0;         ///< mu: pull back to the start [1/s]
  double slack_weight = 1e6;     ///< of the squared violation of escape rows [rad²/m²]
};

/// min 1/2 |q_dot + mu (q - q_start)|²  subject to, in this order of rows,
///
///   tip      J q_dot = J q_dot*, q_dot* the tracking velocity: the tip moves as it does without
///            obstacles, damped near singularities, and these rows never contradict each other;
///   joints   max(-v, (lower - q) / dt) <= q_dot <= min(v, (upper - q) / dt): limits of position turned
///            into limits of velocity, so that one tick never leaves the range. v is the smaller of
///            max_velocity and the problem's limit, but never refuses q_dot* where the problem permits
///            it: tip and joint rows contradict each other only if q_dot* breaks a limit of the problem;
///   escapes  j0 q_dot >= -(approach limit) + (speed of the obstacle), for every link and obstacle
///            within influence; of more than kMaxEscapeRows those with the least clearance.
class VelocityProgram {
 public:
  explicit VelocityProgram(const VelocityProgramSettings& settings) : settings_(settings) {}

  /// False if the limits of a joint leave nothing: it is so far out of its range that no tick brings it
  /// back. Does not allocate.
  bool assign(const Problem& problem, const JointVector& q, const JointVector& tracking,
              const TaskJacobian& J_tip, const std::vector<Escape>& escapes);

  const QuadraticProgram& program() const { return program_; }

  int escape_count() const { return escape_count_; }  ///< the last rows of the program
  const Escape& escape(int k) const { return *escapes_[static_cast<std::size_t>(k)]; }

  /// Gives each escape row, the last rows of this program or of one made from it, a slack: a further
  /// variable s with row + s / sqrt(slack_weight) within its bounds and s² / 2 in the criterion.
  void soften(QuadraticProgram& program) const;

 private:
  void choose(const std::vector<Escape>& escapes);
  bool limit_joints(const Problem& problem, const JointVector& q, const JointVector& tracking,
                    int first_row);

  VelocityProgramSettings settings_;
  QuadraticProgram program_;
  std::array<const Escape*, kMaxEscapeRows> escapes_{};
  int escape_count_ = 0;
};

}  // namespace bqsa::baselines
