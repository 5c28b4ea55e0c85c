/// @file
/// A run of a reactive method with all that it did, tick by tick.
#pragma once

#include <memory>
#include <vector>

#include "bqsa/method.hpp"
#include "harness/method_spec.hpp"

namespace bqsa::harness::claims {

struct RecordedTick {
  TickState state;
  Infeasible reason;
  std::vector<Clamp> clamps;
  bool guard_fired;
};

struct RecordedRun {
  Problem problem;
  Trajectory trajectory;            ///< row 0 is the start; up to the last tick answered
  std::vector<RecordedTick> ticks;  ///< ticks[k - 1] is tick k; one more if that was infeasible

  int rows() const { return static_cast<int>(trajectory.q.size()); }
};

/// The method on the problem, in this process, to the end or the first infeasible tick.
/// @throws InputError if the method does not apply to the problem
RecordedRun record_run(Problem problem, const MethodSpec& method);

/// One tick of a method freshly prepared.
StepOutput single_step(const Problem& problem, const MethodSpec& method, const StepInput& input);

}  // namespace bqsa::harness::claims
