// Deliberately bad external methods, each put through the whole pipeline (own process, judge, record,
// table row) and each caught with its own verdict and message.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <thread>
#include <vector>

#include "harness/external/external_method.hpp"
#include "harness/judge/judge.hpp"
#include "harness/program/test_methods.hpp"
#include "harness/results/pair_run.hpp"
#include "harness/results/table_row.hpp"
#include "harness/temporary_directory.hpp"
#include "running_process.hpp"

namespace bqsa::harness {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;

constexpr double kWallLimit = 1.5;  // [s]; where a run has to be stopped
constexpr double kEnoughTime = 60;  // [s]; where it has to end by itself
constexpr std::uint64_t kMemoryLimit = 256U << 20U;

const std::string kFaulty =
    "/usr/bin/python3 " BQSA_SOURCE_DIR "/tests/harness/external/faulty_method.py";

std::string faulty(const std::string& fault, const std::string& place) {
  return kFaulty + " " + fault + " " + place;
}

MethodSpec external(const std::string& command) {
  return with_defaults(external_method("faulty=" + command));
}

std::string refusal(const std::string& name_and_command) {
  try {
    external_method(name_and_command);
  } catch (const InputError& error) {
    return error.what();
  }
  return "not refused";
}

class ExternalCanaries : public ::testing::Test {
 protected:
  /// Runs a method like `bqsa-bench run` does, and after it an honest one: whatever the first has
  /// done, the second must be judged a success.
  TableRow run(const MethodSpec& spec, double wall_limit = kEnoughTime) {
    const TableRow row = run_once(spec, wall_limit);
    const TableRow honest = run_once(external(faulty("none", "step")), kEnoughTime);
    EXPECT_TRUE(honest.success) << "the run after: " << honest.claim_detail;
    EXPECT_TRUE(honest.claim_holds);
    return row;
  }

  TableRow run(const std::string& fault, const std::string& place, double wall = kEnoughTime) {
    return run(external(faulty(fault, place)), wall);
  }

  /// A method that describes itself as it should and then does something wrong when it is started.
  TableRow run_second_start(const std::string& fault, double wall_limit = kEnoughTime) {
    return run(external(faulty(fault, "start") + " '" + mark().string() + "'"), wall_limit);
  }

  static void expect_caught(const TableRow& row, Failure verdict) {
    EXPECT_FALSE(row.success);
    ASSERT_FALSE(row.failures.empty());
    EXPECT_EQ(row.failures.front(), name_of(verdict)) << row.claim_detail;
    EXPECT_TRUE(std::isnan(row.step_median_s)) << "a bad run must not yield a time";
    EXPECT_TRUE(std::isnan(row.plan_s));
  }

  std::filesystem::path mark() const { return directory_.path() / "started before"; }

  Scenario scenario_ = quiet_scenario();
  TemporaryDirectory directory_;

 private:
  TableRow run_once(const MethodSpec& spec, double wall_limit) {
    ResultStore store(directory_.path() / "results");
    const Judge judge(scenario_.problem);
    const Circumstances circumstances{
        .settings = {},
        .command_line = "test",
        .limits = {.wall_s = wall_limit, .memory_bytes = kMemoryLimit}};
    return parse_run_record(run_pair(scenario_, judge, spec, circumstances, store).record);
  }
};

TEST_F(ExternalCanaries, AnHonestMethodIsNotCaught) {
  const TableRow row = run("none", "step");
  EXPECT_TRUE(row.success) << row.claim_detail;
  EXPECT_EQ(row.claim, "success");
  EXPECT_GT(row.step_median_s, 0);
  EXPECT_TRUE(row.includes_pipe);
}

TEST_F(ExternalCanaries, AnHonestPlannerIsNotCaught) {
  const TableRow row = run("none", "plan");
  EXPECT_TRUE(row.success) << row.claim_detail;
  EXPECT_EQ(row.claim, "success");
  EXPECT_GT(row.plan_s, 0);
}

TEST_F(ExternalCanaries, AnswersThatCannotBeUsedAreNamed) {
  const std::vector<std::pair<std::string, std::string>> faults{
      {"garbage", "expected one line that is a JSON object, got 'hello'"},
      {"binary", "expected one line that is a JSON object, got '\\x07\\x1b[31m'"},
      {"a_list", "expected one line that is a JSON object, got '[1, 2]'"},
      {"other_tick", "tick: expected 4, the tick that was asked for, got 5"},
      {"missing_key", "expected a key 'q', got none"},
      {"wrong_type", "q: expected a list of 2 joint angles [rad], got \"straight on\""},
      {"three_joints", "q: expected a list of 2 joint angles [rad], got a list of 3"},
      {"null", "q[0]: expected a finite number, got null"},
      {"not_a_number",
       "expected one line that is a JSON object, got '{\"tick\": 4, \"q\": [NaN, 0.5]"},
      {"text_for_number", "q[0]: expected a finite number, got \"0.1\""},
      {"unknown_key",
       "expected no keys but tick, q, state, reason, link, obstacle, clamps, counters, got 'Q'"},
      {"unknown_state",
       "state: expected one of 'free', 'clamped', 'unclaimed', 'infeasible', got \"fine\""},
      {"fails", "it failed: lost my way"},
      {"two_lines", "expected one line, got '{\"tick\": 4, \"q\": [0.12, 0.5]"},
      {"long_line", "expected a line of at most 1 MiB, got a longer one"},
      {"endless_line", "expected a line of at most 1 MiB, got a longer one"}};
  for (const auto& [fault, message] : faults) {
    const TableRow row = run(fault, "step");
    expect_caught(row, Failure::kIncomplete);
    EXPECT_EQ(row.claim, "crashed at tick 4") << fault;
    EXPECT_THAT(row.claim_detail,
                HasSubstr(faulty(fault, "step") + "', asked to step 4: " + message));
    EXPECT_EQ(row.rows, 4) << fault << ": what it did before is kept";
  }
}

TEST_F(ExternalCanaries, ProgramsThatEndOrCloseTheirStreamsHaveCrashed) {
  const std::vector<std::pair<std::string, std::string>> faults{
      {"exits", "ended its process with exit status 3: the elbow fell off"},
      {"killed", "killed by signal 11 (Segmentation fault): the elbow fell off"},
      {"closes_stdout", "its standard output was closed, the program lives on"}};
  for (const auto& [fault, message] : faults) {
    const TableRow row = run(fault, "step");
    expect_caught(row, Failure::kIncomplete);
    EXPECT_EQ(row.claim, "crashed at tick 4") << fault;
    EXPECT_THAT(row.claim_detail,
                HasSubstr("asked to step 4: expected one line, got none: " + message));
    EXPECT_EQ(row.rows, 4) << fault;
  }
  const TableRow row = run("closes_stdin", "step");
  expect_caught(row, Failure::kIncomplete);
  EXPECT_EQ(row.claim, "crashed at tick 5") << "the answer before was right";
  EXPECT_THAT(row.claim_detail, HasSubstr("its standard input was closed, the program lives on"));
}

TEST_F(ExternalCanaries, ASecondLineThatComesLateIsNoAnswerToTheNextRequest) {
  const TableRow row = run("two_lines_apart", "step");
  expect_caught(row, Failure::kIncomplete);
  EXPECT_EQ(row.claim, "crashed at tick 5");
  // The answer that was asked for may have come with it.
  EXPECT_THAT(row.claim_detail,
              AnyOf(HasSubstr("tick: expected 5, the tick that was asked for, got 4"),
                    HasSubstr("expected one line, got '")));
  EXPECT_EQ(row.rows, 5);
}

TEST_F(ExternalCanaries, ProgramsThatDoNotAnswerAreStopped) {
  for (const char* fault : {"hangs", "late"}) {
    const TableRow row = run(fault, "step", kWallLimit);
    expect_caught(row, Failure::kTimedOut);
    EXPECT_EQ(row.claim, "timed out at tick 4") << fault;
    EXPECT_EQ(row.claim_detail,
              "stopped after 1.500000 s, '" + faulty(fault, "step") + "' being asked to step");
    EXPECT_EQ(row.rows, 4) << fault;
  }
  const TableRow row = run("hangs", "prepare", kWallLimit);
  expect_caught(row, Failure::kTimedOut);
  EXPECT_EQ(row.claim, "timed out");
  EXPECT_THAT(row.claim_detail, HasSubstr("being asked to prepare"));
}

TEST_F(ExternalCanaries, APlanMayComeTooLate) {
  const RunOutcome outcome =
      run_isolated(scenario_.problem, external_method("slow=" + faulty("late", "plan")),
                   ParameterValues({}), {.plan_budget_s = 0.01}, RunLimits{});
  EXPECT_EQ(outcome.claim, Claim::kTimedOut);
}

TEST_F(ExternalCanaries, AProgramThatReadsNothingIsStopped) {
  // More than a pipe holds: not even the request can be sent.
  scenario_.problem.ticks = 5000;
  scenario_.problem.dt = 1e-4;
  const TableRow row = run_second_start("hangs", kWallLimit);
  expect_caught(row, Failure::kTimedOut);
  EXPECT_EQ(row.claim, "timed out");
}

TEST_F(ExternalCanaries, WhatIsWrittenUnaskedIsNoAnswer) {
  const TableRow row = run_second_start("garbage");
  expect_caught(row, Failure::kIncomplete);
  EXPECT_EQ(row.claim, "crashed");
  EXPECT_THAT(row.claim_detail, HasSubstr("asked to prepare: expected one line"));
  EXPECT_THAT(row.claim_detail, HasSubstr("hello"));
}

TEST_F(ExternalCanaries, AProgramMayFailOnlyWhenItIsStartedAgain) {
  const TableRow row = run_second_start("exits");
  expect_caught(row, Failure::kIncomplete);
  EXPECT_THAT(
      row.claim_detail,
      HasSubstr("asked to prepare: expected one line, got none: ended its process with exit "
                "status 3: the elbow fell off"));

  const std::filesystem::path program = directory_.path() / "my method.sh";
  std::ofstream(program) << "#!/bin/sh\nexec " << faulty("none", "step") << '\n';
  chmod(program.c_str(), S_IRWXU);
  const MethodSpec spec = external("'" + program.string() + "'");
  std::filesystem::remove(program);
  const TableRow vanished = run(spec);
  expect_caught(vanished, Failure::kIncomplete);
  EXPECT_EQ(vanished.claim, "crashed");
  EXPECT_THAT(vanished.claim_detail, HasSubstr("No such file or directory"));
}

TEST_F(ExternalCanaries, AFloodedStandardErrorDoesNotBlock) {
  const TableRow row = run("floods_stderr", "step");
  EXPECT_TRUE(row.success) << row.claim << row.claim_detail;
}

TEST_F(ExternalCanaries, ItsOwnWorkIsNotHidden) {
  const TableRow row = run("works_alone", "step");
  EXPECT_TRUE(row.success) << row.failures.front();
  EXPECT_GE(row.slowest_s, 0.5);
}

TEST_F(ExternalCanaries, WorkOfSeveralAtOnceIsHidden) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "needs two processors";
  for (const char* fault : {"works_in_others", "works_in_orphans"}) {
    const TableRow row = run(fault, "step");
    expect_caught(row, Failure::kWorkHidden);
    EXPECT_FALSE(row.claim_holds) << fault;
  }
}

TEST_F(ExternalCanaries, MemoryIsCountedWhereverItIs) {
  for (const char* fault : {"grows", "grows_in_child"}) {
    const TableRow row = run(fault, "step");
    expect_caught(row, Failure::kOutOfMemory);
    EXPECT_EQ(row.claim, "out of memory at tick 4") << fault << ": " << row.claim_detail;
    EXPECT_EQ(row.rows, 4) << fault;
  }
}

TEST_F(ExternalCanaries, MemoryThatIsOnlyReservedDoesNotCount) {
  const TableRow row = run("reserves_memory", "step");
  EXPECT_TRUE(row.success) << row.claim_detail;
}

/// Ids of the processes that a method was, as it left them in a file.
std::vector<pid_t> started(const std::filesystem::path& mark) {
  std::vector<pid_t> list;
  std::ifstream in(mark);
  for (pid_t process = 0; in >> process;) list.push_back(process);
  return list;
}

TEST_F(ExternalCanaries, NothingIsLeftRunning) {
  for (const auto& [fault, wall_limit] :
       {std::pair("none", kEnoughTime), std::pair("hangs", kWallLimit)}) {
    std::filesystem::remove(mark());
    run(external(faulty(fault, "step") + " '" + mark().string() + "'"), wall_limit);
    const std::vector<pid_t> processes = started(mark());
    EXPECT_EQ(processes.size(), 2u) << "to describe itself, and for its run";
    for (const pid_t process : processes) {
      EXPECT_TRUE(within_a_minute([process] { return !runs(process); })) << fault;
    }
  }
}

TEST_F(ExternalCanaries, WithoutAProcessOfItsOwnARunIsTheSame) {
  const MethodEntry entry = external_method("honest=" + faulty("none", "step"));
  const RunOutcome here = run_method(scenario_.problem, entry, ParameterValues({}));
  const RunOutcome apart = run_isolated(scenario_.problem, entry, ParameterValues({}), {}, {});
  EXPECT_EQ(here.claim, Claim::kSuccess) << here.message;
  EXPECT_EQ(here.trajectory.q, apart.trajectory.q);
  EXPECT_GT(apart.times.cpu_s, here.times.cpu_s) << "only there the program's own counts";
}

TEST(ExternalDescription, LeavesNothingRunning) {
  const TemporaryDirectory directory;
  const std::string mark = (directory.path() / "mark").string();
  // The program describes itself as it should, and leaves another one in a session of its own.
  external_method("leaves=sh -c \"setsid sleep 1000 > /dev/null 2>&1 & echo \\$! > '" + mark +
                  "'; exec " + faulty("none", "step") + "\"");
  const std::vector<pid_t> processes = started(mark);
  ASSERT_EQ(processes.size(), 1U);
  EXPECT_FALSE(runs(processes.front()));
}

TEST(ExternalDescription, WhatCannotBeStartedIsRefused) {
  EXPECT_EQ(
      refusal("x=/no/such/program --fast"),
      "--external x: '/no/such/program --fast': cannot start /no/such/program: No such file or "
      "directory");
  EXPECT_THAT(refusal("x=" BQSA_SOURCE_DIR "/README.md"), HasSubstr("Permission denied"));
  EXPECT_EQ(refusal("x=false"),
            "--external x: 'false', asked to describe: expected one line, got "
            "none: ended its process with exit status 1");
  EXPECT_THAT(refusal("x=" + faulty("exits", "start")),
              HasSubstr("exit status 3: the elbow fell off"));
  EXPECT_THAT(refusal("x='unended"), HasSubstr("--external x: expected a character or ' after '"));
  EXPECT_THAT(refusal("x= "), HasSubstr("expected a command line, got nothing"));
  for (const char* name : {"X=true", "=true", "true", "a b=true", "a:b=true"}) {
    EXPECT_THAT(refusal(name), HasSubstr("expected NAME=COMMAND")) << name;
  }
}

TEST(ExternalDescription, WhatDescribesItselfWronglyIsRefused) {
  EXPECT_THAT(
      refusal("x=" + faulty("other_protocol", "describe")),
      HasSubstr("asked to describe: protocol: expected \"bqsa-method/1\", got \"bqsa-method/2\""));
  EXPECT_THAT(refusal("x=" + faulty("other_kind", "describe")),
              HasSubstr("kind: expected 'reactive' or 'planning', got \"telepathic\""));
  EXPECT_THAT(refusal("x=" + faulty("garbage", "describe")), HasSubstr("got 'hello'"));
  EXPECT_THAT(refusal("x=" + faulty("garbage", "start")), HasSubstr("hello"));
  EXPECT_THAT(refusal("x=" + faulty("fails", "describe")), HasSubstr("it failed: lost my way"));
  EXPECT_THAT(refusal("x=" + faulty("endless_line", "describe")), HasSubstr("of at most 1 MiB"));
}

}  // namespace
}  // namespace bqsa::harness
