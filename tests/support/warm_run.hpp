/// @file
/// Counts what a control loop allocates, through ticks of every outcome.
#pragma once

#include "bqsa/method.hpp"
#include "support/allocation_guard.hpp"

namespace bqsa::test_support {

struct WarmRun {
  std::uint64_t allocations = 0;  ///< from the first tick on
  int free = 0;                   ///< ticks that ended so
  int clamped = 0;
  int infeasible = 0;
  int no_free_motion = 0;  ///< of the infeasible ones: all retries were used up
};

/// Steps through all ticks of the problem. At an infeasible tick the arm stands still while the
/// path goes on.
inline WarmRun warm_run(ReactiveMethod& method, const Problem& problem) {
  method.prepare(problem);
  WarmRun run;
  StepInput input;
  StepOutput output;
  input.q = problem.start;
  const AllocationGuard guard;
  for (input.tick = 1; input.tick <= problem.ticks; ++input.tick) {
    input.t = problem.time(input.tick);
    input.p_WT_desired = problem.desired_tip(input.t);
    input.R_WT_desired = problem.rotation_at(input.t);
    method.step(input, output);
    input.q = output.q;
    run.free += output.state == TickState::kFree;
    run.clamped += output.state == TickState::kClamped;
    run.infeasible += output.state == TickState::kInfeasible;
    run.no_free_motion += output.reason == Infeasible::kNoFreeMotion;
  }
  run.allocations = guard.allocations();
  return run;
}

}  // namespace bqsa::test_support
