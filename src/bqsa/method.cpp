#include "bqsa/method.hpp"

#include <algorithm>
#include <cmath>

namespace bqsa {

std::string why_not_applicable(const Capabilities& capabilities, const Problem& problem) {
  if (problem.dimension() == 2 && !capabilities.planar) return "planar problems not supported yet";
  if (problem.dimension() == 3 && !capabilities.spatial)
    return "spatial problems not supported yet";
  if (problem.link_radius > 0 && !capabilities.link_radius) return "link_radius not supported yet";
  if (problem.margin > 0 && !capabilities.margin) return "margin not supported yet";
  const bool moving = std::any_of(problem.obstacles.begin(), problem.obstacles.end(),
                                  [](const Obstacle& obstacle) { return obstacle.moves(); });
  if (moving && !capabilities.moving) return "moving obstacles not supported yet";
  if (problem.chain.has_prismatic_joints() && !capabilities.prismatic)
    return "prismatic joints not supported yet";
  if (problem.has_orientation() && !capabilities.orientation)
    return "orientation tasks not supported yet";
  return {};
}

void clear(StepOutput& output) {
  output.state = TickState::kFree;
  output.reason = Infeasible::kNot;
  output.link = 0;
  output.obstacle = -1;
  output.clamp_count = 0;
  output.guard_fired = false;
}

void copy(const StepOutput& from, StepOutput& to) {
  to.q = from.q;
  to.state = from.state;
  to.reason = from.reason;
  to.link = from.link;
  to.obstacle = from.obstacle;
  to.clamp_count = from.clamp_count;
  std::copy_n(from.clamps.begin(), from.clamp_count, to.clamps.begin());
  to.guard_fired = from.guard_fired;
}

void hold(const JointVector& q_last, Infeasible reason, int link, int obstacle,
          StepOutput& output) {
  output.clamp_count = 0;
  output.guard_fired = false;
  output.q = q_last;
  output.state = TickState::kInfeasible;
  output.reason = reason;
  output.link = link;
  output.obstacle = obstacle;
}

void record_clamp(const Clamp& clamp, StepOutput& output) {
  if (output.clamp_count == StepOutput::kMaxClamps) return;
  output.clamps[static_cast<std::size_t>(output.clamp_count++)] = clamp;
}

Infeasible forbidden_step(const Problem& problem, const JointVector& q_last, const JointVector& q) {
  if (!problem.within_limits(q)) return Infeasible::kJointLimit;
  const bool by_default =
      problem.limits.max_velocity.size() == 0 && !problem.chain.has_prismatic_joints();
  for (int j = 0; j < problem.chain.joints(); ++j) {
    const double most = by_default ? kDefaultMaxStep : problem.max_step(j);
    if (!(std::abs(q(j) - q_last(j)) <= most)) return Infeasible::kStepTooLarge;
  }
  return Infeasible::kNot;
}

const char* name_of(TickState state) {
  switch (state) {
    case TickState::kFree:
      return "free";
    case TickState::kClamped:
      return "clamped";
    case TickState::kUnclaimed:
      return "unclaimed";
    case TickState::kInfeasible:
      return "infeasible";
  }
  return "?";
}

const char* name_of(Infeasible reason) {
  switch (reason) {
    case Infeasible::kNot:
      return "feasible";
    case Infeasible::kNoFreeConfiguration:
      return "no free configuration";
    case Infeasible::kNoFreeMotion:
      return "no free motion";
    case Infeasible::kStepTooLarge:
      return "joint step too large";
    case Infeasible::kJointLimit:
      return "joint limit";
    case Infeasible::kDiverged:
      return "diverged";
  }
  return "?";
}

}  // namespace bqsa
