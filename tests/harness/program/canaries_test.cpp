// Deliberately bad methods, each put through the whole pipeline (own process, judge, record, table row)
// and each caught with its own verdict.

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "harness/judge/judge.hpp"
#include "harness/methods.hpp"
#include "harness/results/pair_run.hpp"
#include "harness/results/table_row.hpp"
#include "harness/temporary_directory.hpp"
#include "test_methods.hpp"

namespace bqsa::harness {
namespace {

constexpr double kWallLimit = 4;  // [s]; most canaries need milliseconds, on a loaded machine more

/// Runs a method like `bqsa-bench run` does, and after it an honest one: whatever the first has done,
/// the second must be judged a success.
class Canaries : public ::testing::Test {
 protected:
  TableRow run(const MethodSpec& spec) { return run(scenario_, spec); }

  TableRow run(const Scenario& scenario, const MethodSpec& spec) {
    const TableRow row = run_once(scenario, spec);
    const TableRow honest = run_once(quiet_, scripted("honest", follow));
    EXPECT_TRUE(honest.success) << "the run after " << spec.entry.name;
    EXPECT_TRUE(honest.claim_holds);
    return row;
  }

  /// One line a canary, so that a reader of the output sees what caught it.
  static void expect_caught(const TableRow& row, Failure verdict, bool claim_holds) {
    EXPECT_FALSE(row.success);
    ASSERT_FALSE(row.failures.empty());
    EXPECT_EQ(row.failures.front(), name_of(verdict));
    EXPECT_EQ(row.claim_holds, claim_holds);
    EXPECT_TRUE(std::isnan(row.step_median_s)) << "a bad run must not yield a time";
    EXPECT_TRUE(std::isnan(row.plan_s));
    std::printf("canary %-24s %-16s %s\n", row.variant.c_str(), row.failures.front().c_str(),
                row.claim.c_str());
  }

  Scenario scenario_ = quiet_scenario();

 private:
  TableRow run_once(const Scenario& scenario, const MethodSpec& spec) {
    ResultStore store(directory_.path());
    const Judge judge(scenario.problem);
    const Circumstances circumstances{
        .settings = {},
        .command_line = "test",
        .limits = {.wall_s = kWallLimit, .memory_bytes = 256U << 20U}};
    const StoredRun run = run_pair(scenario, judge, spec, circumstances, store);
    EXPECT_EQ(run.trajectory_error, "");
    return parse_run_record(run.record);
  }

  const Scenario quiet_ = quiet_scenario();
  TemporaryDirectory directory_;
};

TEST_F(Canaries, AnHonestMethodIsNotCaught) {
  const TableRow row = run(scripted("honest", follow));
  EXPECT_TRUE(row.success);
  EXPECT_EQ(row.claim, "success");
  EXPECT_GT(row.step_median_s, 0);
}

TEST_F(Canaries, Number01CollidesAtTicks) {
  ChainPose pose;
  scenario_.problem.chain.forward(Eigen::Vector2d(0.3, 0.5), pose);
  const Eigen::Vector2d on_link = (pose.p_WO.col(0) + pose.p_WO.col(1)).head<2>() / 2;
  scenario_.problem.obstacles = {{"post", embedded(rotated_ellipse(on_link, {0.02, 0.02}, 0))}};
  const TableRow row = run(scripted("collides", follow));
  expect_caught(row, Failure::kCollision, /* claim_holds = */ false);
  EXPECT_EQ(row.collided, std::vector<std::string>{"(1, post)"});
}

TEST_F(Canaries, Number02TunnelsThroughAThinWallBetweenTicks) {
  // A sheet of 0.02 mm across the first link's way, in the middle of a tick of 1.7 degrees.
  const double angle = 0.6 * 10.5 * scenario_.problem.dt;
  const Eigen::Vector2d on_link = 0.25 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  scenario_.problem.obstacles = {
      {"sheet", embedded(rotated_ellipse(on_link, {0.05, 1e-5}, angle))}};
  const Problem& problem = scenario_.problem;
  const Judge judge(problem);
  Trajectory at_ticks;
  for (int tick = 0; tick <= problem.ticks; ++tick) {
    at_ticks.t.push_back(problem.time(tick));
    at_ticks.q.push_back(Eigen::Vector2d(0.6 * problem.time(tick), 0.5));
  }
  const Judgement judgement = judge.judge(at_ticks);
  ASSERT_EQ(judgement.contacts.size(), 1u);
  EXPECT_FALSE(judgement.contacts.front().at_tick) << "or it would be the canary before";
  EXPECT_EQ(judgement.contacts.front().first_tick, 11);

  const TableRow row = run(scripted("tunnels", follow));
  expect_caught(row, Failure::kCollision, /* claim_holds = */ false);
}

TEST_F(Canaries, Number03Teleports) {
  // The elbow on the other side has the tip in the same place.
  const TableRow row = run(scripted("teleports", [](const StepInput& input, StepOutput& output) {
    follow(input, output);
    if (input.tick > 10) output.q = Eigen::Vector2d(output.q(0) + 0.5, -0.5);
  }));
  expect_caught(row, Failure::kJump, /* claim_holds = */ false);
}

TEST_F(Canaries, Number04ReturnsNotANumber) {
  const TableRow row = run(scripted("not_a_number", [](const StepInput& input, StepOutput& output) {
    follow(input, output);
    if (input.tick == 7) output.q(1) = std::numeric_limits<double>::quiet_NaN();
  }));
  expect_caught(row, Failure::kNotFinite, /* claim_holds = */ true);
  EXPECT_EQ(row.claim, "crashed at tick 7");
}

TEST_F(Canaries, Number05StandsStillAndClaimsSuccess) {
  const TableRow row = run(scripted("stands_still", stand_still));
  expect_caught(row, Failure::kDrift, /* claim_holds = */ false);
  EXPECT_EQ(row.claim, "success");
}

TEST_F(Canaries, Number06DriftsAMillimetreBeyondTheTolerance) {
  const TableRow row = run(scripted("drifts", [this](const StepInput& input, StepOutput& output) {
    follow(input, output);
    ChainPose pose;
    scenario_.problem.chain.forward(output.q, pose);
    output.q(0) +=
        (scenario_.problem.tolerance + 1e-3) / pose.tip().norm() * std::min(1.0, input.tick / 5.0);
    output.state = TickState::kUnclaimed;
  }));
  expect_caught(row, Failure::kDrift, /* claim_holds = */ true);
  EXPECT_NEAR(row.tip_error_at_ticks_m, scenario_.problem.tolerance + 1e-3, 1e-6);
}

TEST_F(Canaries, Number07SleepsPastTheDeadline) {
  const TableRow row = run(scripted("sleeps", [](const StepInput& input, StepOutput& output) {
    if (input.tick == 13) std::this_thread::sleep_for(std::chrono::hours(1));
    follow(input, output);
  }));
  expect_caught(row, Failure::kTimedOut, /* claim_holds = */ true);
  EXPECT_EQ(row.claim, "timed out at tick 13");
  EXPECT_EQ(row.rows, 13) << "what it did before is kept";
}

TEST_F(Canaries, Number07PlansPastItsBudget) {
  static constexpr double kBudget = 0.01;
  class Slow final : public PlanningMethod {
   public:
    explicit Slow(bool to_prepare) : to_prepare_(to_prepare) {}
    void prepare(const Problem& problem) override {
      problem_ = &problem;
      if (to_prepare_) waste();
    }
    Plan plan(double, std::uint64_t) override {
      if (!to_prepare_) waste();
      Plan plan{.solved = true, .trajectory = {}};
      for (int tick = 0; tick <= problem_->ticks; ++tick) {
        plan.trajectory.t.push_back(problem_->time(tick));
        plan.trajectory.q.push_back(Eigen::Vector2d(0.6 * problem_->time(tick), 0.5));
      }
      return plan;
    }

   private:
    static void waste() {
      std::this_thread::sleep_for(
          std::chrono::duration<double>(kBudget + RunSettings::kPlanGrace + 0.1));
    }
    bool to_prepare_;
    const Problem* problem_ = nullptr;
  };
  for (const bool to_prepare : {false, true}) {
    MethodEntry entry = entry_of("slow", [to_prepare](const ParameterValues&) {
      return std::make_unique<Slow>(to_prepare);
    });
    entry.capabilities.plans = true;
    const RunOutcome outcome = run_isolated(scenario_.problem, entry, ParameterValues({}),
                                            {.plan_budget_s = kBudget}, RunLimits{});
    EXPECT_EQ(outcome.claim, Claim::kTimedOut) << to_prepare;
  }
}

TEST_F(Canaries, Number08Crashes) {
  const std::map<std::string, std::function<void()>> ways{
      {"crashes_by_segfault", [] { raise(SIGSEGV); }},
      {"crashes_by_abort", [] { abort(); }},
      {"crashes_by_exit", [] { _exit(0); }},
      {"crashes_by_exception", [] { throw std::runtime_error("lost my way"); }},
      {"crashes_by_any_throw", [] { throw 42; }}};
  for (const auto& [name, crash] : ways) {
    const TableRow row =
        run(scripted(name, [crash = crash](const StepInput& input, StepOutput& output) {
          if (input.tick == 4) crash();
          follow(input, output);
        }));
    expect_caught(row, Failure::kIncomplete, /* claim_holds = */ true);
    EXPECT_EQ(row.claim, "crashed at tick 4") << name;
    EXPECT_FALSE(row.claim_detail.empty()) << name;
    EXPECT_EQ(row.rows, 4) << name;
  }
}

TEST_F(Canaries, Number08CrashesAfterAFaultlessTrajectory) {
  class CrashesInTheEnd final : public ReactiveMethod {
   public:
    ~CrashesInTheEnd() override { _exit(0); }
    void prepare(const Problem&) override {}
    void step(const StepInput& input, StepOutput& output) override { follow(input, output); }
  };
  const TableRow row = run(with_defaults(entry_of("crashes_in_the_end", [](const ParameterValues&) {
    return std::make_unique<CrashesInTheEnd>();
  })));
  EXPECT_FALSE(row.success);
  EXPECT_TRUE(row.claim.starts_with("crashed"));
}

TEST_F(Canaries, Number09AllocatesWithoutEnd) {
  const TableRow row = run(scripted("allocates", [](const StepInput& input, StepOutput& output) {
    static std::vector<std::unique_ptr<char[]>> kept;
    while (input.tick == 3) {
      constexpr std::size_t kPiece = 1U << 20U;
      kept.push_back(std::make_unique<char[]>(kPiece));  // zeroed, and so resident
    }
    follow(input, output);
  }));
  expect_caught(row, Failure::kOutOfMemory, /* claim_holds = */ true);
  EXPECT_EQ(row.claim, "out of memory at tick 3");
  EXPECT_EQ(row.rows, 3);
}

TEST_F(Canaries, Number10LiesAboutItsTime) {
  const TableRow row = run(scripted("lies", [](const StepInput& input, StepOutput& output) {
    if (input.tick == 1) {
      std::thread([] {
        volatile bool working = true;
        while (working) {
        }
      }).detach();
    }
    // As if it were quick: the work is done elsewhere, while the processor seems to rest.
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    follow(input, output);
  }));
  expect_caught(row, Failure::kWorkHidden, /* claim_holds = */ false);
}

TEST_F(Canaries, Number11WritesIntoTheProblem) {
  class Vandal final : public ReactiveMethod {
   public:
    void prepare(const Problem& problem) override {
      // The post that stands in the way is gone, as far as this process is concerned.
      const_cast<Problem&>(problem).obstacles.clear();
    }
    void step(const StepInput& input, StepOutput& output) override { follow(input, output); }
  };
  const TableRow row = run(with_defaults(entry_of(
      "changes_problem", [](const ParameterValues&) { return std::make_unique<Vandal>(); })));
  expect_caught(row, Failure::kInputsChanged, /* claim_holds = */ false);
  EXPECT_EQ(scenario_.problem.obstacles.size(), 1u) << "ours is another one";
}

TEST_F(Canaries, Number11WritesIntoWhatAStepIsTold) {
  const TableRow row =
      run(scripted("changes_input", [](const StepInput& input, StepOutput& output) {
        follow(input, output);
        if (input.tick == 5) const_cast<StepInput&>(input).q(0) += 1e-9;
      }));
  expect_caught(row, Failure::kInputsChanged, /* claim_holds = */ false);
}

TEST_F(Canaries, Number12ReturnsTooFewRows) {
  PlanningMethod::Plan plan{.solved = true, .trajectory = {}};
  for (int tick = 0; tick < scenario_.problem.ticks; ++tick) {
    plan.trajectory.t.push_back(scenario_.problem.time(tick));
    plan.trajectory.q.push_back(Eigen::Vector2d(0.6 * scenario_.problem.time(tick), 0.5));
  }
  const TableRow row = run(planned("too_few_rows", plan));
  expect_caught(row, Failure::kIncomplete, /* claim_holds = */ false);
}

TEST_F(Canaries, WhatAMethodPrintsIsNotInTheResultsNorOnTheStandardOutput) {
  testing::internal::CaptureStdout();
  const TableRow row = run(scripted("noisy", [](const StepInput& input, StepOutput& output) {
    std::printf("{\"schema\": \"bqsa-run/1\"}\n");
    std::fflush(stdout);
    for (int i = 0; i < 10000; ++i) std::fputs("noise ", stderr);
    follow(input, output);
  }));
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_TRUE(row.success);
}

TEST_F(Canaries, TheEndOfTheStandardErrorIsInTheMessageOfACrash) {
  const TableRow row = run(scripted("says_why", [](const StepInput&, StepOutput&) {
    std::fputs("some line\nthe elbow fell off\n", stderr);
    std::_Exit(3);
  }));
  EXPECT_EQ(row.claim_detail, "ended its process with exit status 3: the elbow fell off");
}

/// Whether a run has ended all that its first tick left behind, in a session of its own. What comes after it is
/// up to the method.
void expect_ended(const std::function<void(const MethodSpec&)>& run_it,
                  void (*then)(const StepInput&, StepOutput&)) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  run_it(scripted("forks", [then](const StepInput& input, StepOutput& output) {
    if (input.tick == 1 && fork() == 0) {
      setsid();
      std::this_thread::sleep_for(std::chrono::hours(1));
      _exit(0);
    }
    then(input, output);
  }));
  close(ends[1]);
  char byte = 0;
  EXPECT_EQ(read(ends[0], &byte, 1), 0) << "nobody else has the pipe open any more";
  close(ends[0]);
}

TEST_F(Canaries, AProcessLeftBehindIsEnded) {
  expect_ended([this](const MethodSpec& spec) { run(spec); }, follow);
}

TEST_F(Canaries, AProcessLeftBehindByACrashIsEnded) {
  expect_ended([this](const MethodSpec& spec) { run(spec); },
               [](const StepInput& input, StepOutput& output) {
                 if (input.tick == 2) std::abort();
                 follow(input, output);
               });
}

TEST_F(Canaries, AProcessLeftBehindByAHangIsEnded) {
  expect_ended([this](const MethodSpec& spec) { run(spec); },
               [](const StepInput& input, StepOutput& output) {
                 if (input.tick == 2) std::this_thread::sleep_for(std::chrono::hours(1));
                 follow(input, output);
               });
}

}  // namespace
}  // namespace bqsa::harness
