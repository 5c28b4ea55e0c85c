#include "harness/runner.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>

namespace bqsa::harness {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Ticks in which each link-obstacle pair was cleared; storage for all pairs is taken at once.
class PairTally {
 public:
  explicit PairTally(std::size_t obstacles)
      : obstacles_(obstacles), cells_((kMaxLinks + 1) * obstacles) {}

  /// A pair named twice in a tick counts once.
  void add(const Clamp& clamp, int tick) {
    Cell& cell = cells_[static_cast<std::size_t>(clamp.link) * obstacles_ +
                        static_cast<std::size_t>(clamp.obstacle)];
    if (cell.last_tick != tick) ++cell.ticks;
    cell.last_tick = tick;
  }

  std::vector<ClampedPair> pairs() const {
    std::vector<ClampedPair> list;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (cells_[i].ticks == 0) continue;
      list.push_back(
          {static_cast<int>(i / obstacles_), static_cast<int>(i % obstacles_), cells_[i].ticks});
    }
    return list;
  }

 private:
  struct Cell {
    int ticks = 0;
    int last_tick = 0;
  };
  std::size_t obstacles_;
  std::vector<Cell> cells_;
};

/// Why the answer of a step cannot be used; empty if it can.
std::string fault_of(const StepOutput& output, const Problem& problem) {
  const int obstacles = static_cast<int>(problem.obstacles.size());
  if (output.clamp_count < 0 || output.clamp_count > StepOutput::kMaxClamps) {
    return "returned " + std::to_string(output.clamp_count) + " clamps";
  }
  for (int i = 0; i < output.clamp_count; ++i) {
    const Clamp& clamp = output.clamps[static_cast<std::size_t>(i)];
    if (clamp.link < 1 || clamp.link > kMaxLinks || clamp.obstacle < 0 ||
        clamp.obstacle >= obstacles) {
      return "clamped link " + std::to_string(clamp.link) + " and obstacle " +
             std::to_string(clamp.obstacle) + ", which do not exist";
    }
  }
  if (output.state == TickState::kInfeasible) {
    return output.obstacle < obstacles ? "" : "named an obstacle that does not exist";
  }
  if (output.q.size() != problem.chain.joints()) {
    return "returned " + std::to_string(output.q.size()) + " joint angles, expected " +
           std::to_string(problem.chain.joints());
  }
  return output.q.allFinite() ? "" : "returned a joint angle that is not finite";
}

/// Summary of the step times of the ticks 1, 2, ...
void summarize(const std::vector<double>& step_s, RunTimes& times) {
  if (step_s.empty()) return;
  times.first_step_s = step_s.front();
  std::vector<double> warm(step_s.begin() + 1, step_s.end());
  if (warm.empty()) return;
  const auto slowest = std::max_element(warm.begin(), warm.end());
  constexpr int kFirstWarmTick = 2;
  times.warm_steps = static_cast<int>(warm.size());
  times.warm_max_s = *slowest;
  times.warm_max_tick = kFirstWarmTick + static_cast<int>(slowest - warm.begin());

  std::sort(warm.begin(), warm.end());
  const std::size_t half = warm.size() / 2;
  times.warm_median_s = warm.size() % 2 == 1 ? warm[half] : (warm[half - 1] + warm[half]) / 2;
  const double rank = std::ceil(0.99 * static_cast<double>(warm.size()));
  times.warm_p99_s = warm[static_cast<std::size_t>(rank) - 1];
}

void count(TickState state, RunOutcome& outcome) {
  switch (state) {
    case TickState::kFree:
      ++outcome.free_ticks;
      break;
    case TickState::kClamped:
      ++outcome.clamped_ticks;
      break;
    case TickState::kUnclaimed:
      ++outcome.unclaimed_ticks;
      break;
    case TickState::kInfeasible:
      break;
  }
}

/// The control loop; `outcome.tick` is the tick in progress.
void follow(ReactiveMethod& method, const Problem& problem, RunOutcome& outcome,
            std::vector<double>& step_s, PairTally& tally) {
  Trajectory& trajectory = outcome.trajectory;
  StepInput input;
  StepOutput output;
  for (int tick = 1; tick <= problem.ticks; ++tick) {
    outcome.tick = tick;
    input.tick = tick;
    input.t = problem.time(tick);
    input.p_WT_desired = problem.desired_tip(input.t);
    input.q = trajectory.q.back();
    output = {};

    const Clock::time_point start = Clock::now();
    method.step(input, output);
    step_s.push_back(seconds_since(start));

    outcome.message = fault_of(output, problem);
    const bool usable = outcome.message.empty();
    if (usable && output.state == TickState::kInfeasible) {
      outcome.claim = Claim::kInfeasible;
      outcome.reason = output.reason;
      outcome.link = output.link;
      outcome.obstacle = output.obstacle;
      return;
    }
    if (output.q.size() == problem.chain.joints()) {
      trajectory.t.push_back(input.t);
      trajectory.q.push_back(output.q);
    }
    if (!usable) {
      outcome.claim = Claim::kCrashed;
      return;
    }
    count(output.state, outcome);
    if (output.guard_fired) ++outcome.guard_fired;
    for (int i = 0; i < output.clamp_count; ++i) {
      const Clamp& clamp = output.clamps[static_cast<std::size_t>(i)];
      tally.add(clamp, tick);
      outcome.increments_total += clamp.increments;
      outcome.increments_max = std::max(outcome.increments_max, clamp.increments);
    }
  }
  outcome.tick = 0;
  outcome.claim = outcome.unclaimed_ticks > 0 ? Claim::kNothing : Claim::kSuccess;
}

void make_and_run(const Problem& problem, const MethodEntry& entry,
                  const ParameterValues& parameters, const RunSettings& settings,
                  std::unique_ptr<Method>& method, RunOutcome& outcome, std::vector<double>& step_s,
                  PairTally& tally) {
  Clock::time_point start = Clock::now();
  method = entry.make(parameters);
  outcome.times.construct_s = seconds_since(start);

  start = Clock::now();
  method->prepare(problem);
  outcome.times.prepare_s = seconds_since(start);

  if (auto* planner = dynamic_cast<PlanningMethod*>(method.get())) {
    start = Clock::now();
    PlanningMethod::Plan plan = planner->plan(settings.plan_budget_s, settings.seed);
    outcome.times.plan_s = seconds_since(start);
    outcome.claim = plan.solved ? Claim::kSuccess : Claim::kUnsolved;
    outcome.trajectory = std::move(plan.trajectory);
  } else {
    follow(dynamic_cast<ReactiveMethod&>(*method), problem, outcome, step_s, tally);
  }
}

}  // namespace

RunTimes::RunTimes()
    : construct_s(kNone),
      prepare_s(kNone),
      plan_s(kNone),
      first_step_s(kNone),
      warm_median_s(kNone),
      warm_p99_s(kNone),
      warm_max_s(kNone) {}

RunOutcome run_method(const Problem& problem, const MethodEntry& entry,
                      const ParameterValues& parameters, const RunSettings& settings) {
  // The control loop takes no memory of its own: everything it fills is reserved here.
  const auto ticks = static_cast<std::size_t>(problem.ticks);
  RunOutcome outcome;
  outcome.trajectory.t.reserve(ticks + 1);
  outcome.trajectory.q.reserve(ticks + 1);
  outcome.trajectory.t.push_back(0);
  outcome.trajectory.q.push_back(problem.start);
  std::vector<double> step_s;
  step_s.reserve(ticks);
  PairTally tally(problem.obstacles.size());

  std::unique_ptr<Method> method;
  try {
    make_and_run(problem, entry, parameters, settings, method, outcome, step_s, tally);
  } catch (const std::exception& error) {
    outcome.claim = Claim::kCrashed;
    outcome.message = error.what();
  } catch (...) {
    outcome.claim = Claim::kCrashed;
    outcome.message = "threw something that is not a std::exception";
  }
  if (method) outcome.counters = method->counters();
  outcome.clamped_pairs = tally.pairs();
  summarize(step_s, outcome.times);
  return outcome;
}

bool claim_holds(Claim claim, bool judged_success) {
  return claim == Claim::kNothing || (claim == Claim::kSuccess) == judged_success;
}

const char* name_of(Claim claim) {
  switch (claim) {
    case Claim::kSuccess:
      return "success";
    case Claim::kNothing:
      return "nothing";
    case Claim::kInfeasible:
      return "infeasible";
    case Claim::kUnsolved:
      return "unsolved";
    case Claim::kCrashed:
      return "crashed";
  }
  return "?";
}

}  // namespace bqsa::harness
