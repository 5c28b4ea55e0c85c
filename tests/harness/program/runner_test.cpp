#include "harness/runner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "harness/judge/judge_kinematics.hpp"
#include "harness/methods.hpp"
#include "support/allocation_guard.hpp"
#include "test_methods.hpp"

namespace bqsa::harness {
namespace {

class Runner : public ::testing::Test {
 protected:
  RunOutcome run(const MethodSpec& spec) {
    return run_method(problem_, spec.entry, spec.parameters);
  }

  const Problem problem_ = planar_scenario().problem;
  const int ticks_ = problem_.ticks;
};

TEST_F(Runner, FeedsAMethodItsOwnJointAnglesAndTheDesiredTipAtTheEndOfEachTick) {
  int calls = 0;
  JointVector expected = problem_.start;
  const RunOutcome outcome =
      run(scripted("counting", [&](const StepInput& input, StepOutput& output) {
        ++calls;
        EXPECT_EQ(input.tick, calls);
        EXPECT_EQ(input.t, calls * problem_.dt) << "tick " << calls;
        EXPECT_EQ(input.q, expected) << "tick " << calls;
        EXPECT_EQ(input.p_WT_desired, problem_.desired_tip(input.t)) << "tick " << calls;
        expected = input.q.array() + 1e-4 * calls;
        output.q = expected;
      }));
  EXPECT_EQ(calls, ticks_);
  EXPECT_EQ(outcome.claim, Claim::kSuccess);
  EXPECT_EQ(outcome.tick, 0);
  EXPECT_EQ(outcome.free_ticks, ticks_);
  EXPECT_EQ(outcome.counters.iterations, static_cast<std::uint64_t>(ticks_));
  ASSERT_EQ(outcome.trajectory.q.size(), static_cast<std::size_t>(ticks_) + 1);
  EXPECT_EQ(outcome.trajectory.q.front(), problem_.start);
  EXPECT_EQ(outcome.trajectory.q.back(), expected);
  EXPECT_EQ(outcome.trajectory.t.back(), problem_.time(ticks_));
}

TEST_F(Runner, TakesNoMemoryBetweenTheFirstAndTheLastStep) {
  if (!test_support::kCountsAllocations) return;
  std::optional<test_support::AllocationGuard> guard;
  std::uint64_t allocations = 0;
  int steps = 0;
  run(scripted("clamping", [&](const StepInput& input, StepOutput& output) {
    if (!guard) guard.emplace();
    stand_still(input, output);
    output.clamp_count = 1;
    output.clamps[0] = {.link = 7, .obstacle = 1};
    allocations = guard->allocations();
    ++steps;
  }));
  EXPECT_EQ(allocations, 0u);
  EXPECT_EQ(steps, ticks_);
}

TEST_F(Runner, GivesEveryTickAFreshOutput) {
  run(scripted("leaving traces", [](const StepInput& input, StepOutput& output) {
    EXPECT_EQ(output.clamp_count, 0) << "tick " << input.tick;
    EXPECT_EQ(output.q.size(), 0) << "tick " << input.tick;
    EXPECT_FALSE(output.guard_fired) << "tick " << input.tick;
    output.q = input.q;
    output.clamp_count = 1;
    output.clamps[0] = {.link = 1, .obstacle = 0};
    output.guard_fired = true;
  }));
}

TEST_F(Runner, StopsAtTheFirstInfeasibleTickAndKeepsTheLastSafePart) {
  const RunOutcome outcome = run(scripted("gives up", [](const StepInput& input, StepOutput& out) {
    stand_still(input, out);
    if (input.tick < 23) return;
    out.state = TickState::kInfeasible;
    out.reason = Infeasible::kNoFreeMotion;
    out.link = 6;
    out.obstacle = 1;
  }));
  EXPECT_EQ(outcome.claim, Claim::kInfeasible);
  EXPECT_EQ(outcome.tick, 23);
  EXPECT_EQ(outcome.reason, Infeasible::kNoFreeMotion);
  EXPECT_EQ(outcome.link, 6);
  EXPECT_EQ(outcome.obstacle, 1);
  EXPECT_EQ(outcome.trajectory.q.size(), 23u);
  EXPECT_EQ(outcome.trajectory.t.size(), 23u);
  EXPECT_EQ(outcome.free_ticks, 22);
}

TEST_F(Runner, CountsHowOftenAPairBeginsToBeCleared) {
  const RunOutcome outcome =
      run(scripted("on and off", [](const StepInput& input, StepOutput& output) {
        stand_still(input, output);
        const bool first = input.tick <= 3 || input.tick == 5 || input.tick == 9;
        const bool second = input.tick == 5 || input.tick == 6;
        if (first) record_clamp({.link = 7, .obstacle = 0}, output);
        if (first) record_clamp({.link = 7, .obstacle = 0}, output);
        if (second) record_clamp({.link = 7, .obstacle = 1}, output);
      }));
  EXPECT_EQ(outcome.clamp_starts, 3 + 1);
}

TEST_F(Runner, CountsClampsByPairAndTick) {
  const RunOutcome outcome =
      run(scripted("clamping", [](const StepInput& input, StepOutput& output) {
        stand_still(input, output);
        if (input.tick > 10) return;
        output.state = TickState::kClamped;
        output.guard_fired = input.tick % 2 == 0;
        output.clamp_count = 3;  // the same pair twice in a tick counts once
        output.clamps[0] = {.link = 7, .obstacle = 0, .increments = 2};
        output.clamps[1] = {.link = 7, .obstacle = 0, .increments = 5};
        output.clamps[2] = {.link = 6, .obstacle = 1, .increments = 1};
        if (input.tick > 4) output.clamp_count = 1;
      }));
  EXPECT_EQ(outcome.clamped_ticks, 10);
  EXPECT_EQ(outcome.free_ticks, ticks_ - 10);
  EXPECT_EQ(outcome.guard_fired, 5);
  ASSERT_EQ(outcome.clamped_pairs.size(), 2u);
  EXPECT_EQ(outcome.clamped_pairs[0].link, 6);
  EXPECT_EQ(outcome.clamped_pairs[0].obstacle, 1);
  EXPECT_EQ(outcome.clamped_pairs[0].ticks, 4);
  EXPECT_EQ(outcome.clamped_pairs[1].link, 7);
  EXPECT_EQ(outcome.clamped_pairs[1].obstacle, 0);
  EXPECT_EQ(outcome.clamped_pairs[1].ticks, 10);
  EXPECT_EQ(outcome.clamp_starts, 2);
  EXPECT_EQ(outcome.increments_total, 4 * (2 + 5 + 1) + 6 * 2);
  EXPECT_EQ(outcome.increments_max, 5);
}

TEST_F(Runner, SummarizesIncrementsOfTheTicksInWhichLinksWereCleared) {
  const RunOutcome outcome =
      run(scripted("clamping", [](const StepInput& input, StepOutput& output) {
        stand_still(input, output);
        if (input.tick > 101) return;
        output.clamp_count = 2;  // together as many as the tick, but 1000 in the last
        output.clamps[0] = {.link = 7, .obstacle = 0, .increments = 1};
        output.clamps[1] = {.link = 6, .obstacle = 1, .increments = input.tick - 1};
        if (input.tick == 101) output.clamps[1].increments = 999;
      }));
  const TickIncrements& increments = outcome.increments;
  EXPECT_NEAR(increments.mean, (5050 + 1000) / 101.0, 1e-12);
  EXPECT_EQ(increments.median, 51);
  EXPECT_EQ(increments.p99, 100);
  EXPECT_EQ(increments.max, 1000);
  EXPECT_EQ(increments.histogram.total(), 101);
  EXPECT_EQ(outcome.increments_total, 5050 + 1000);

  const RunOutcome still = run(scripted("still", stand_still));
  EXPECT_TRUE(std::isnan(still.increments.mean));
  EXPECT_EQ(still.increments.histogram.total(), 0);
}

TEST_F(Runner, KeepsTheStateOfTheSlowestTick) {
  std::vector<JointVector> told;
  const RunOutcome outcome = run(scripted("moving", [&](const StepInput& input, StepOutput& out) {
    told.push_back(input.q);
    out.q = input.q.array() + 1e-4;
  }));
  const RunTimes& times = outcome.times;
  ASSERT_GE(times.warm_max_tick, 2);
  EXPECT_EQ(times.warm_max_q, told.at(static_cast<std::size_t>(times.warm_max_tick) - 1));
}

TEST_F(Runner, RecordsAnExceptionOfTheMethodWithItsTick) {
  const RunOutcome outcome = run(scripted("throws", [](const StepInput& input, StepOutput& output) {
    if (input.tick == 5) throw std::runtime_error("out of ideas");
    stand_still(input, output);
  }));
  EXPECT_EQ(outcome.claim, Claim::kCrashed);
  EXPECT_EQ(outcome.tick, 5);
  EXPECT_EQ(outcome.message, "out of ideas");
  EXPECT_EQ(outcome.trajectory.q.size(), 5u);
}

TEST_F(Runner, RecordsExceptionsOfAnyTypeAndOfTheConstruction) {
  const RunOutcome strange = run(scripted("strange", [](const auto&, auto&) { throw 42; }));
  EXPECT_EQ(strange.claim, Claim::kCrashed);
  EXPECT_EQ(strange.tick, 1);
  EXPECT_FALSE(strange.message.empty());

  const RunOutcome unmade =
      run(with_defaults(entry_of("unmade", [](const ParameterValues&) -> std::unique_ptr<Method> {
        throw std::runtime_error("cannot be made");
      })));
  EXPECT_EQ(unmade.claim, Claim::kCrashed);
  EXPECT_EQ(unmade.tick, 0);
  EXPECT_EQ(unmade.message, "cannot be made");
  EXPECT_EQ(unmade.trajectory.q.size(), 1u);
}

struct BadAnswer {
  const char* name;
  std::function<void(StepOutput&)> spoil;
  std::size_t rows;  ///< rows of the trajectory if tick 5 is spoilt
};

void PrintTo(const BadAnswer& answer, std::ostream* out) { *out << answer.name; }

class RunnerOnBadAnswers : public Runner, public ::testing::WithParamInterface<BadAnswer> {};

TEST_P(RunnerOnBadAnswers, StopsThereAndShowsTheJudgeWhatItCan) {
  const RunOutcome outcome = run(scripted("spoilt", [](const StepInput& input, StepOutput& output) {
    stand_still(input, output);
    if (input.tick == 5) GetParam().spoil(output);
  }));
  EXPECT_EQ(outcome.claim, Claim::kCrashed);
  EXPECT_EQ(outcome.tick, 5);
  EXPECT_FALSE(outcome.message.empty());
  EXPECT_EQ(outcome.free_ticks, 4);
  EXPECT_EQ(outcome.trajectory.q.size(), GetParam().rows);
}

INSTANTIATE_TEST_SUITE_P(
    All, RunnerOnBadAnswers,
    ::testing::Values(
        BadAnswer{"NotANumber",
                  [](StepOutput& out) { out.q(3) = std::numeric_limits<double>::quiet_NaN(); }, 6},
        BadAnswer{"Infinite",
                  [](StepOutput& out) { out.q(0) = std::numeric_limits<double>::infinity(); }, 6},
        BadAnswer{"TooFewJoints", [](StepOutput& out) { out.q.resize(6); }, 5},
        BadAnswer{"NoJoints", [](StepOutput& out) { out.q.resize(0); }, 5},
        BadAnswer{"NegativeClampCount", [](StepOutput& out) { out.clamp_count = -1; }, 6},
        BadAnswer{"TooManyClamps",
                  [](StepOutput& out) { out.clamp_count = StepOutput::kMaxClamps + 1; }, 6},
        BadAnswer{"LinkThatDoesNotExist",
                  [](StepOutput& out) {
                    out.clamp_count = 1;
                    out.clamps[0] = {.link = 99, .obstacle = 0};
                  },
                  6},
        BadAnswer{"ObstacleThatDoesNotExist",
                  [](StepOutput& out) {
                    out.clamp_count = 1;
                    out.clamps[0] = {.link = 1, .obstacle = 2};
                  },
                  6}),
    [](const auto& tested) { return tested.param.name; });

TEST_F(Runner, KeepsAPlanAsItIs) {
  Trajectory odd;
  odd.t = {0, 7, 3};
  odd.q = {problem_.start, JointVector::Zero(2), problem_.start};
  const RunOutcome solved = run(planned("planner", {.solved = true, .trajectory = odd}));
  EXPECT_EQ(solved.claim, Claim::kSuccess);
  EXPECT_EQ(solved.trajectory.t, odd.t);
  EXPECT_EQ(solved.trajectory.q, odd.q);
  EXPECT_GE(solved.times.plan_s, 0);
  EXPECT_TRUE(std::isnan(solved.times.first_step_s));

  const RunOutcome unsolved = run(planned("planner", {.solved = false, .trajectory = {}}));
  EXPECT_EQ(unsolved.claim, Claim::kUnsolved);
  EXPECT_TRUE(unsolved.trajectory.q.empty());
}

TEST_F(Runner, TakesTheColdStepApartFromTheWarmOnes) {
  const RunOutcome outcome = run(scripted("still", stand_still));
  const RunTimes& times = outcome.times;
  EXPECT_GE(times.construct_s, 0);
  EXPECT_GE(times.prepare_s, 0);
  EXPECT_GE(times.first_step_s, 0);
  EXPECT_TRUE(std::isnan(times.plan_s));
  EXPECT_EQ(times.warm_steps, ticks_ - 1);
  EXPECT_LE(times.warm_median_s, times.warm_p99_s);
  EXPECT_LE(times.warm_p99_s, times.warm_p999_s);
  EXPECT_LE(times.warm_p999_s, times.warm_max_s);
  EXPECT_EQ(times.warm_histogram.total(), times.warm_steps);
  const double p99 = times.warm_histogram.quantile(0.99) * RunTimes::kHistogramUnit;
  EXPECT_NEAR(p99 / times.warm_p99_s, 1, 0.023);
  EXPECT_GE(times.run_s, times.warm_max_s);
  EXPECT_GE(times.warm_max_tick, 2);
  EXPECT_LE(times.warm_max_tick, ticks_);
}

TEST_F(Runner, HasNoWarmTimesWithoutWarmSteps) {
  const RunOutcome outcome = run(scripted("gives up", [](const StepInput& input, StepOutput& out) {
    stand_still(input, out);
    if (input.tick == 1) out.state = TickState::kInfeasible;
  }));
  EXPECT_GE(outcome.times.first_step_s, 0);
  EXPECT_EQ(outcome.times.warm_steps, 0);
  EXPECT_TRUE(std::isnan(outcome.times.warm_median_s));
  EXPECT_TRUE(std::isnan(outcome.times.warm_max_s));
}

/// Ticks from 1 on whose tip is further from its path than the tolerance.
int ticks_off_path(const Problem& problem, const Trajectory& trajectory) {
  const JudgeKinematics kinematics(problem.chain.description());
  PointPositions arm;
  int off = 0;
  for (std::size_t k = 1; k < trajectory.q.size(); ++k) {
    kinematics.place(trajectory.q[k], arm);
    off += (arm.tip() - problem.desired_tip(trajectory.t[k])).norm() > problem.tolerance;
  }
  return off;
}

/// The paper's first-order steps leave the path by what depends on their length: at some ticks more
/// than this tolerance, at some less.
TEST_F(Runner, BqsaPaperClaimsNothingOfTicksThatEndOffThePath) {
  Problem strict = problem_;
  strict.tolerance = 1e-5;
  for (const MethodEntry& method : methods()) {
    if (method.name != "bqsa" && method.name != "bqsa_paper") continue;
    const RunOutcome outcome = run_method(strict, method, ParameterValues(method.parameters));
    ASSERT_EQ(outcome.trajectory.q.size(), static_cast<std::size_t>(ticks_) + 1) << method.name;
    const int off = ticks_off_path(strict, outcome.trajectory);
    EXPECT_EQ(outcome.unclaimed_ticks, off) << method.name;
    if (method.name == "bqsa_paper") {
      EXPECT_GT(off, 20);
      EXPECT_LT(off, ticks_ - 20);
      EXPECT_GT(outcome.guard_fired, 0);
      EXPECT_EQ(outcome.claim, Claim::kNothing);
    } else {
      EXPECT_EQ(off, 0);
      EXPECT_EQ(outcome.claim, Claim::kSuccess);
    }
  }
}

}  // namespace
}  // namespace bqsa::harness
