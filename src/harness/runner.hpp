/// @file
/// Runs one method on one problem, keeps what it did and takes the time. Judges nothing.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "bqsa/method.hpp"
#include "harness/disturbance.hpp"
#include "harness/log_histogram.hpp"
#include "harness/run_progress.hpp"

namespace bqsa::harness {

/// What the method itself says of its run.
enum class Claim {
  kSuccess,     ///< every tick free or clamped, or a plan claimed as solved
  kNothing,     ///< went to the end, with ticks whose motion it does not claim to be free
  kInfeasible,  ///< a reactive method gave up at a tick
  kUnsolved,    ///< a planning method found no plan
  kCrashed,     ///< an exception, a signal, or an answer that cannot be used
  kTimedOut,    ///< it had to be stopped, or its plan came too late
  kOutOfMemory,
};

/// Thrown by a method whose own process was ended by SIGKILL.
struct MethodKilled : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct RunSettings {
  std::uint64_t seed = 1;     ///< of all randomness: of a planning method, of the noise
  double plan_budget_s = 10;  ///< wall time that a planning method may use, `prepare` included [s]

  /// A plan that takes this much longer than its budget is too late [s].
  static constexpr double kPlanGrace = 1;

  Disturbance disturbance = {};  ///< of reactive methods; planning methods must not be run with one
};

/// Wall times, by a monotonic clock that the method does not see. Not a number where there was
/// none.
struct RunTimes {
  double construct_s;
  double prepare_s;
  double plan_s;        ///< planning methods only
  double first_step_s;  ///< the cold step of tick 1; reactive methods only, like all below
  int warm_steps = 0;   ///< steps of the ticks from 2 on
  double warm_median_s;
  double warm_p99_s;   ///< smallest step time that at least 99 % of the warm steps do not exceed
  double warm_p999_s;  ///< likewise 99.9 %
  double warm_max_s;
  int warm_max_tick = 0;
  JointVector warm_max_q;       ///< StepInput::q of that tick [rad]
  LogHistogram warm_histogram;  ///< of all warm steps; its unit is kHistogramUnit
  double run_s;                 ///< from the construction to the last answer
  double cpu_s;                 ///< processor time of all threads in that time
  double hidden_cpu_s;          ///< of it, that of threads other than the one that was asked

  static constexpr double kHistogramUnit = 1e-9;  ///< [s]

  RunTimes();
};

/// Clamping increments of the ticks in which a link was cleared, summed over the clamps of a tick.
/// Not a number if there was none.
struct TickIncrements {
  double mean;
  double median;
  double p99;  ///< smallest number that at least 99 % of these ticks do not exceed
  int max = 0;
  LogHistogram histogram;  ///< its unit is one increment

  TickIncrements();
};

/// A link-obstacle pair that the method cleared.
struct ClampedPair {
  int link = 0;
  int obstacle = 0;  ///< index into Problem::obstacles
  int ticks = 0;     ///< number of ticks in which it was cleared
};

struct RunOutcome {
  Claim claim = Claim::kSuccess;
  int tick = 0;  ///< infeasible or crashed: the tick at which; 0 if before the first
  Infeasible reason = Infeasible::kNot;
  int link = 0;         ///< infeasible: the link that could not be freed, else 0
  int obstacle = -1;    ///< infeasible: index of its obstacle, else -1
  std::string message;  ///< crashed, timed out or out of memory: what happened

  bool inputs_changed = false;  ///< the method wrote into the problem or into what a step was told
  bool work_hidden = false;     ///< it used the processor beyond what its times show

  /// Crashed: by SIGKILL from outside, as the kernel sends it when memory runs out.
  bool killed = false;

  int free_ticks = 0;
  int clamped_ticks = 0;
  int unclaimed_ticks = 0;
  int guard_fired = 0;                     ///< ticks in which the paper variant fell back
  std::vector<ClampedPair> clamped_pairs;  ///< by link, then obstacle
  int clamp_starts = 0;  ///< times that a pair was cleared that had not been in the tick before
  std::int64_t increments_total = 0;  ///< clamping increments of all ticks
  int increments_max = 0;             ///< of one clamp
  TickIncrements increments;

  WorkCounters counters;
  RunTimes times;
  Trajectory
      trajectory;  ///< from the start to the last tick answered; the last safe part if infeasible
};

/// Constructs, prepares and runs the method. A reactive method is given its own last joint angles,
/// as the sensors show them, and x_d(t) tick by tick until the first infeasible tick or unusable
/// answer (wrong number of joint angles, one that is not finite, a link or obstacle that does not
/// exist); a row with joint angles that are not finite is kept for the judge. The trajectory is what
/// the arm executed. A plan is kept as it is. Exceptions of the method end up in the outcome.
/// Whatever the method does to the problem, the path that the harness asks for is read from it: run
/// untrusted methods by run_isolated().
/// @param progress  if given, told of every tick
RunOutcome run_method(const Problem& problem, const MethodEntry& method,
                      const ParameterValues& parameters, const RunSettings& settings = {},
                      RunProgress* progress = nullptr);

/// Whether the claim and the verdict agree; a method that claims nothing is never wrong.
bool claim_holds(Claim claim, bool judged_success);

const char* name_of(Claim claim);

}  // namespace bqsa::harness
