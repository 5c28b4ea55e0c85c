#include "bqsa/joint_limit_clamp.hpp"

#include <algorithm>
#include <cmath>

namespace bqsa {
namespace {

/// Part of the largest step that may be used: the rest is for what corrects the tip afterwards.
constexpr double kShare = 0.95;

}  // namespace

bool clamp_at_limits(const Problem& problem, const JointLimitClamp& clamp, const JointVector& q,
                     JointVector& phi) {
  phi.setZero(q.size());
  const JointLimits& limits = problem.limits;
  if (!(clamp.band > 0) || limits.lower.size() == 0 || limits.upper.size() == 0) return false;
  const double gain = std::min(clamp.gain, 1 / problem.dt);
  bool any = false;
  for (int j = 0; j < q.size(); ++j) {
    const double width = clamp.band * (limits.upper(j) - limits.lower(j));
    if (!std::isfinite(width)) continue;
    const double above_lower = q(j) - limits.lower(j);
    const double below_upper = limits.upper(j) - q(j);
    if (above_lower < width) phi(j) = gain * (width - above_lower);
    if (below_upper < width) phi(j) = -gain * (width - below_upper);
    any = any || phi(j) != 0;
  }
  return any;
}

double part_within_steps(const Problem& problem, const JointVector& q_dot,
                         const JointVector& self_motion) {
  double part = 1;
  for (int j = 0; j < q_dot.size(); ++j) {
    if (self_motion(j) == 0) continue;
    const double fastest = kShare * problem.max_step(j) / problem.dt;
    const double towards = std::copysign(1.0, self_motion(j)) * q_dot(j);
    part = std::min(part, (fastest - towards) / std::abs(self_motion(j)));
  }
  return std::max(part, 0.0);
}

}  // namespace bqsa
