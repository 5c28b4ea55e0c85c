#include "baselines/limited_step.hpp"

#include <algorithm>
#include <limits>

namespace bqsa::baselines {

ParameterDeclaration step_limit_parameter() {
  return choice_parameter(
      "step_limit", {"scale", "hold"},
      "if a joint's step is too large: make as much of the avoidance as fits, or give up");
}

StepLimit read_step_limit(const ParameterValues& values) {
  return values.choice("step_limit") == "scale" ? StepLimit::kScale : StepLimit::kHold;
}

double fitting_part(const Problem& problem, const JointVector& q, const JointVector& tracking,
                    const JointVector& avoidance) {
  double least = 0, most = 1;
  const auto keep = [&least, &most](double from, double by, double lower, double upper) {
    if (by == 0) {
      if (from < lower || from > upper) most = -1;
      return;
    }
    const double one = (lower - from) / by, other = (upper - from) / by;
    least = std::max(least, std::min(one, other));
    most = std::min(most, std::max(one, other));
  };
  for (int j = 0; j < problem.chain.joints(); ++j) {
    keep(tracking(j), avoidance(j), -problem.max_step(j), problem.max_step(j));
    const double from = q(j) + tracking(j);
    if (problem.limits.lower.size() > 0) {
      keep(from, avoidance(j), problem.limits.lower(j), std::numeric_limits<double>::infinity());
    }
    if (problem.limits.upper.size() > 0) {
      keep(from, avoidance(j), -std::numeric_limits<double>::infinity(), problem.limits.upper(j));
    }
  }
  return least <= most ? most : -1;
}

void make_step(const Problem& problem, const StepInput& input, const JointVector& tracking,
               const JointVector& avoidance, StepLimit step_limit, StepOutput& output) {
  const double dt = problem.dt;
  double part = 1;
  if (step_limit == StepLimit::kScale) {
    part = std::max(0.0, fitting_part(problem, input.q, dt * tracking, dt * avoidance));
    if (part < 1) part *= 1 - 1e-12;  // a rounding below the limit
  }
  const JointVector q = input.q + dt * (tracking + part * avoidance);
  const Infeasible forbidden = forbidden_step(problem, input.q, q);
  if (forbidden != Infeasible::kNot) return hold(input.q, forbidden, 0, -1, output);
  output.q = q;
  output.state = TickState::kUnclaimed;
}

}  // namespace bqsa::baselines
