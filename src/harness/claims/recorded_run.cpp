#include "harness/claims/recorded_run.hpp"

#include <fmt/core.h>

#include <utility>

namespace bqsa::harness::claims {
namespace {

std::unique_ptr<ReactiveMethod> prepared(const Problem& problem, const MethodSpec& spec) {
  const std::string why = why_not_applicable(spec.entry.capabilities, problem);
  if (!why.empty()) {
    throw InputError(fmt::format("{}: expected a method for problem {}, got one for which {}",
                                 spec.entry.name, problem.name, why));
  }
  std::unique_ptr<Method> method = spec.entry.make(spec.parameters);
  std::unique_ptr<ReactiveMethod> owned(dynamic_cast<ReactiveMethod*>(method.get()));
  if (owned == nullptr) {
    throw InputError(fmt::format("{}: expected a reactive method, got a planner", spec.entry.name));
  }
  static_cast<void>(method.release());  // now owned
  owned->prepare(problem);
  return owned;
}

}  // namespace

RecordedRun record_run(Problem problem, const MethodSpec& spec) {
  RecordedRun run{std::move(problem), {}, {}};
  const std::unique_ptr<ReactiveMethod> method = prepared(run.problem, spec);
  run.trajectory.t.push_back(0);
  run.trajectory.q.push_back(run.problem.start);
  for (int tick = 1; tick <= run.problem.ticks; ++tick) {
    const double t = run.problem.time(tick);
    StepOutput output;
    method->step({.tick = tick,
                  .t = t,
                  .p_WT_desired = run.problem.desired_tip(t),
                  .R_WT_desired = run.problem.rotation_at(t),
                  .q = run.trajectory.q.back()},
                 output);
    run.ticks.push_back({output.state,
                         output.reason,
                         {output.clamps.begin(), output.clamps.begin() + output.clamp_count},
                         output.guard_fired});
    if (output.state == TickState::kInfeasible) break;
    run.trajectory.t.push_back(t);
    run.trajectory.q.push_back(output.q);
  }
  return run;
}

StepOutput single_step(const Problem& problem, const MethodSpec& spec, const StepInput& input) {
  StepOutput output;
  prepared(problem, spec)->step(input, output);
  return output;
}

}  // namespace bqsa::harness::claims
