#include "harness/runner.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <ctime>
#include <exception>
#include <limits>
#include <memory>
#include <new>

#include "harness/fingerprint.hpp"
#include "harness/tick_log.hpp"

namespace bqsa::harness {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double cpu_seconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Processor time of the process and of this thread from here on.
class CpuMeter {
 public:
  double of_all_threads() const { return cpu_seconds(CLOCK_PROCESS_CPUTIME_ID) - process_; }
  double of_this_thread() const { return cpu_seconds(CLOCK_THREAD_CPUTIME_ID) - thread_; }

 private:
  double process_ = cpu_seconds(CLOCK_PROCESS_CPUTIME_ID);
  double thread_ = cpu_seconds(CLOCK_THREAD_CPUTIME_ID);
};

/// Other threads may use as much, for the clocks of process and thread are not read at once.
bool is_hidden(double other_threads_s, double all_threads_s) {
  constexpr double kUnnoticed = 0.01;       // [s]
  constexpr double kUnnoticedShare = 0.02;  // of all threads
  return other_threads_s > kUnnoticed + kUnnoticedShare * all_threads_s;
}

bool same(const StepInput& a, const StepInput& b) {
  return a.tick == b.tick && a.t == b.t && a.p_WT_desired == b.p_WT_desired &&
         a.R_WT_desired == b.R_WT_desired && a.q.size() == b.q.size() && a.q == b.q;
}

constexpr int kMostIncrements = 10'000'000;  // of one clamp; those of a tick can be added up

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
    if (clamp.increments < 0 || clamp.increments > kMostIncrements) {
      return "returned a clamp of " + std::to_string(clamp.increments) + " increments";
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
void follow(ReactiveMethod& method, const Problem& problem, JointSensors& sensors,
            RunOutcome& outcome, TickLog& log, RunProgress* progress) {
  Trajectory& trajectory = outcome.trajectory;
  StepInput input;
  StepInput given;
  StepOutput output;
  for (int tick = 1; tick <= problem.ticks; ++tick) {
    outcome.tick = tick;
    input.tick = tick;
    input.t = problem.time(tick);
    input.p_WT_desired = problem.desired_tip(input.t);
    input.R_WT_desired = problem.rotation_at(input.t);
    input.q = sensors.reading(trajectory.q);
    given = input;
    output = {};
    if (progress) progress->begin_tick(tick);

    const Clock::time_point start = Clock::now();
    method.step(given, output);
    log.add_step(input, seconds_since(start));
    if (!same(given, input)) outcome.inputs_changed = true;

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
      trajectory.q.push_back(sensors.executed(output.q));
      if (progress) progress->add_row(trajectory.q.back());
    }
    if (!usable) {
      outcome.claim = Claim::kCrashed;
      return;
    }
    count(output.state, outcome);
    if (output.guard_fired) ++outcome.guard_fired;
    log.add_clamps(output, tick);
  }
  outcome.tick = 0;
  outcome.claim = outcome.unclaimed_ticks > 0 ? Claim::kNothing : Claim::kSuccess;
}

void make_and_run(const Problem& problem, const MethodEntry& entry,
                  const ParameterValues& parameters, const RunSettings& settings,
                  std::unique_ptr<Method>& method, RunOutcome& outcome, TickLog& log,
                  RunProgress* progress) {
  Clock::time_point start = Clock::now();
  method = entry.make(parameters);
  outcome.times.construct_s = seconds_since(start);

  start = Clock::now();
  method->prepare(problem);
  outcome.times.prepare_s = seconds_since(start);

  if (entry.capabilities.plans) {
    assert(!settings.disturbance.on());
    start = Clock::now();
    PlanningMethod::Plan plan =
        dynamic_cast<PlanningMethod&>(*method).plan(settings.plan_budget_s, settings.seed);
    outcome.times.plan_s = seconds_since(start);
    outcome.claim = plan.solved ? Claim::kSuccess : Claim::kUnsolved;
    outcome.trajectory = std::move(plan.trajectory);
    const double spent_s = outcome.times.prepare_s + outcome.times.plan_s;
    if (spent_s > settings.plan_budget_s + RunSettings::kPlanGrace) {
      outcome.claim = Claim::kTimedOut;
      outcome.message = "prepared and planned for " + std::to_string(spent_s) +
                        " s, allowed were " + std::to_string(settings.plan_budget_s) + " s";
    }
  } else {
    JointSensors sensors(settings.disturbance, settings.seed, problem.name);
    follow(dynamic_cast<ReactiveMethod&>(*method), problem, sensors, outcome, log, progress);
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
      warm_p999_s(kNone),
      warm_max_s(kNone),
      run_s(kNone),
      cpu_s(kNone),
      hidden_cpu_s(kNone) {}

TickIncrements::TickIncrements() : mean(kNone), median(kNone), p99(kNone) {}

RunOutcome run_method(const Problem& problem, const MethodEntry& entry,
                      const ParameterValues& parameters, const RunSettings& settings,
                      RunProgress* progress) {
  // The control loop takes no memory of its own: everything it fills is reserved here.
  const auto ticks = static_cast<std::size_t>(problem.ticks);
  RunOutcome outcome;
  outcome.trajectory.t.reserve(ticks + 1);
  outcome.trajectory.q.reserve(ticks + 1);
  outcome.trajectory.t.push_back(0);
  outcome.trajectory.q.push_back(problem.start);
  TickLog log(problem);
  const std::uint64_t problem_before = fingerprint(problem);

  std::unique_ptr<Method> method;
  const CpuMeter cpu;
  const Clock::time_point start = Clock::now();
  try {
    make_and_run(problem, entry, parameters, settings, method, outcome, log, progress);
  } catch (const std::bad_alloc&) {
    outcome.claim = Claim::kOutOfMemory;
    outcome.message = "asked for more memory than there was";
  } catch (const MethodKilled& killed) {
    outcome.claim = Claim::kCrashed;
    outcome.message = killed.what();
    outcome.killed = true;
  } catch (const std::exception& error) {
    outcome.claim = Claim::kCrashed;
    outcome.message = error.what();
  } catch (...) {
    outcome.claim = Claim::kCrashed;
    outcome.message = "threw something that is not a std::exception";
  }
  outcome.times.run_s = seconds_since(start);
  outcome.times.cpu_s = cpu.of_all_threads();
  outcome.times.hidden_cpu_s = std::max(outcome.times.cpu_s - cpu.of_this_thread(), 0.0);
  outcome.work_hidden = is_hidden(outcome.times.hidden_cpu_s, outcome.times.cpu_s);
  if (fingerprint(problem) != problem_before) outcome.inputs_changed = true;
  if (method) outcome.counters = method->counters();
  log.summarize(outcome);
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
    case Claim::kTimedOut:
      return "timed out";
    case Claim::kOutOfMemory:
      return "out of memory";
  }
  return "?";
}

}  // namespace bqsa::harness
