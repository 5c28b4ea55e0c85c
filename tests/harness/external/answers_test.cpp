#include "harness/external/answers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <utility>
#include <vector>

namespace bqsa::harness {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string message_of(const std::function<void()>& read) {
  try {
    read();
  } catch (const AnswerError& error) {
    return error.what();
  }
  return "not refused";
}

std::string describe_fault(const std::string& line) {
  return message_of([&] { read_describe_answer(line); });
}

/// The answer to step 7, of two joints and three obstacles.
struct Step {
  StepOutput output;
  WorkCounters counters;

  explicit Step(const std::string& line) {
    StepInput input;
    input.tick = 7;
    input.q = Eigen::Vector2d(0.25, 0.5);
    read_step_answer(line, input, 3, output, counters);
  }
};

std::string step_fault(const std::string& line) {
  return message_of([&] { Step{line}; });
}

std::string plan_fault(const std::string& line) {
  WorkCounters counters;
  return message_of([&] { read_plan_answer(line, 2, counters); });
}

TEST(Answers, ADescriptionBecomesAnEntry) {
  const MethodEntry entry = read_describe_answer(
      R"({"protocol": "bqsa-method/1", "name": "Mine", "summary": "does it", "source": "me 2020",
          "kind": "planning", "capabilities": {"spatial": true, "moving": true, "orientation": true, "keeps_limits": false},
          "parameters": [
            {"name": "gain", "unit": "1/s", "default": 0.5, "minimum": 0, "maximum": 2, "meaning": "how much"},
            {"name": "n", "default": 3, "minimum": 1, "maximum": 9, "integer": true, "meaning": "points"},
            {"name": "law", "choices": ["a", "b"], "default": "b", "meaning": "which"}]})");
  EXPECT_EQ(entry.name, "Mine");
  EXPECT_EQ(entry.summary, "does it");
  EXPECT_EQ(entry.source, "me 2020");
  EXPECT_TRUE(entry.capabilities.plans);
  EXPECT_FALSE(entry.capabilities.planar);
  EXPECT_TRUE(entry.capabilities.spatial);
  EXPECT_TRUE(entry.capabilities.moving);
  EXPECT_FALSE(entry.capabilities.margin);
  EXPECT_TRUE(entry.capabilities.orientation);
  EXPECT_FALSE(entry.capabilities.keeps_limits);
  const ParameterValues values(entry.parameters);
  using Pair = std::pair<std::string, std::string>;
  EXPECT_EQ(values.as_text(), (std::vector<Pair>{{"gain", "0.5"}, {"n", "3"}, {"law", "b"}}));
  EXPECT_EQ(entry.parameters[0].unit, "1/s");
  EXPECT_EQ(entry.parameters[0].maximum, 2);
  EXPECT_EQ(entry.parameters[0].meaning, "how much");
  EXPECT_TRUE(entry.parameters[1].integer);
}

TEST(Answers, DescriptionsAreCheckedKeyByKey) {
  const std::string head =
      R"({"protocol": "bqsa-method/1", "summary": "s", "source": "s", "kind": "reactive", )";
  const std::string planar = head + R"("capabilities": {"planar": true}, "parameters": )";
  const auto parameter = [&planar](const std::string& rest) {
    return planar + R"([{"name": "p", "meaning": "m", )" + rest + "}]}";
  };
  EXPECT_NO_THROW(read_describe_answer(parameter(R"("default": 1, "minimum": 0, "maximum": 1)")));
  const std::vector<std::pair<std::string, std::string>> faults{
      {"{}", "expected a key 'protocol', got none"},
      {R"({"protocol": 1})", "protocol: expected a text, got 1"},
      {R"({"protocol": "bqsa-method/2", "news": 1})",
       R"(protocol: expected "bqsa-method/1", got "bqsa-method/2")"},
      {head + R"("capabilities": {}})",
       "capabilities: expected planar, spatial or both to be true, got an object"},
      {head + R"("capabilities": {"planar": 1}})",
       "capabilities.planar: expected true or false, got 1"},
      {head + R"("capabilities": {"plans": true}})",
       "capabilities: expected no keys but planar, spatial, link_radius, margin, moving, "
       "prismatic, orientation, keeps_limits, got 'plans'"},
      {planar + "{}}", "parameters: expected a list, got an object"},
      {planar + "[1]}", "parameters[0]: expected an object, got 1"},
      {parameter(R"("default": 1, "minimum": 2, "maximum": 3)"),
       "parameters[0].default: expected a number from 2 to 3, got 1"},
      {parameter(R"("default": 1.5, "minimum": 1, "maximum": 3, "integer": true)"),
       "parameters[0].default: expected a whole number from"},
      {parameter(R"("default": null, "minimum": 1, "maximum": 3)"),
       "parameters[0].default: expected a finite number, got null"},
      {parameter(R"("choices": [])"), "parameters[0].choices: expected at least one name"},
      {parameter(R"("choices": ["a,b"])"),
       "parameters[0].choices[0]: expected a name without , and ="},
      {parameter(R"("choices": ["a"], "default": "b")"),
       "parameters[0].default: expected one of the choices, got \"b\""},
      {planar + R"([{"name": "P", "meaning": "", "choices": ["a"]}]})",
       "parameters[0].name: expected a name [a-z][a-z0-9_]*, got \"P\""},
      {planar +
           R"([{"name": "p", "meaning": "", "choices": ["a"]}, {"name": "p", "meaning": "", "choices": ["a"]}]})",
       "parameters[1].name: expected a name that is given once, got \"p\""}};
  for (const auto& [line, message] : faults) EXPECT_THAT(describe_fault(line), StartsWith(message));
}

TEST(Answers, AStepIsRead) {
  const Step step(
      R"({"tick": 7, "q": [1, -2.5e-3], "state": "clamped",
          "clamps": [{"link": 2, "obstacle": 1}, {"link": 1, "obstacle": 0, "anchor": 1, "offset": -0.5, "increments": 7}],
          "counters": {"jacobians": 18446744073709551615, "iterations": 3}})");
  EXPECT_EQ(step.output.q, JointVector(Eigen::Vector2d(1, -2.5e-3)));
  EXPECT_EQ(step.output.state, TickState::kClamped);
  ASSERT_EQ(step.output.clamp_count, 2);
  EXPECT_EQ(step.output.clamps[0].link, 2);
  EXPECT_EQ(step.output.clamps[0].obstacle, 1);
  EXPECT_EQ(step.output.clamps[1].anchor, 1);
  EXPECT_EQ(step.output.clamps[1].offset, -0.5);
  EXPECT_EQ(step.output.clamps[1].increments, 7);
  EXPECT_EQ(step.counters.jacobians, ~std::uint64_t{0});
  EXPECT_EQ(step.counters.iterations, 3u);
  EXPECT_EQ(Step(R"({"tick": 7, "q": [0, 0], "state": "unclaimed"})").output.state,
            TickState::kUnclaimed);
}

TEST(Answers, AMethodMayGiveUp) {
  const Step step(
      R"({"tick": 7, "state": "infeasible", "reason": "no free motion", "link": 2, "obstacle": 1})");
  EXPECT_EQ(step.output.state, TickState::kInfeasible);
  EXPECT_EQ(step.output.reason, Infeasible::kNoFreeMotion);
  EXPECT_EQ(step.output.link, 2);
  EXPECT_EQ(step.output.obstacle, 1);
  EXPECT_EQ(step.output.q, JointVector(Eigen::Vector2d(0.25, 0.5))) << "the arm holds";
  const Step shorter(R"({"tick": 7, "state": "infeasible", "reason": "diverged"})");
  EXPECT_EQ(shorter.output.link, 0);
  EXPECT_EQ(shorter.output.obstacle, -1);
}

TEST(Answers, StepsAreCheckedKeyByKey) {
  const std::string head = R"({"tick": 7, "q": [0, 0], "state": "clamped", )";
  const std::vector<std::pair<std::string, std::string>> faults{
      {"", "expected one line that is a JSON object, got ''"},
      {"{} {}", "expected one line that is a JSON object, got '{} {}'"},
      {R"({"tick": 7, "q": [0, 1e999], "state": "free"})",
       "expected one line that is a JSON object"},
      {R"({"tick": 7, "q": [0, true], "state": "free"})",
       "q[1]: expected a finite number, got true"},
      {R"({"tick": 7, "q": {}, "state": "free"})",
       "q: expected a list of 2 joint angles [rad], got an object"},
      {R"({"tick": 7, "q": [0, 0]})", "expected a key 'state', got none"},
      {R"({"tick": 7, "state": "infeasible"})", "expected a key 'reason', got none"},
      {R"({"tick": 7, "state": "infeasible", "reason": "tired"})",
       "reason: expected one of 'no free configuration', 'no free motion', 'joint step too large', "
       "'joint limit', 'diverged', got \"tired\""},
      {R"({"tick": 7, "state": "infeasible", "reason": "diverged", "obstacle": 3})",
       "obstacle: expected a whole number from -1 to 2, got 3"},
      {head + R"("reason": "diverged"})", "reason: expected no such key but for the state"},
      {head + R"("clamps": [{"link": 0, "obstacle": 0}]})",
       "clamps[0].link: expected a whole number from 1 to 17, got 0"},
      {head + R"("clamps": [{"link": 1, "obstacle": 3}]})",
       "clamps[0].obstacle: expected a whole number from 0 to 2, got 3"},
      {head + R"("clamps": [{"link": 1.0, "obstacle": 0}]})",
       "clamps[0].link: expected a whole number from 1 to 17, got 1.0"},
      {head + R"("clamps": [{"link": 18446744073709551615, "obstacle": 0}]})",
       "clamps[0].link: expected a whole number from 1 to 17, got 18446744073709551615"},
      {head + R"("clamps": [{"link": 1}]})", "expected a key 'clamps[0].obstacle', got none"},
      {head + R"("counters": {"jacobians": -1}})",
       "counters.jacobians: expected a whole number from 0 on, got -1"},
      {head + R"("counters": {"guesses": 1}})", "counters: expected no keys but quadratics"},
      {R"({"q": [0, 0], "state": "free"})", "expected a key 'tick', got none"},
      {R"({"tick": 6, "q": [0, 0], "state": "free"})",
       "tick: expected 7, the tick that was asked for, got 6"},
      {R"({"error": "lost\nmy way"})", "it failed: lost my way"},
      {R"({"error": 1})", "error: expected a text, got 1"}};
  for (const auto& [line, message] : faults) EXPECT_THAT(step_fault(line), StartsWith(message));
  std::string many = head + R"("clamps": [)";
  for (int i = 0; i < 33; ++i) many += std::string(i > 0 ? "," : "") + R"({"link":1,"obstacle":0})";
  EXPECT_EQ(step_fault(many + "]}"), "clamps: expected at most 32 clamps, got a list of 33");
}

TEST(Answers, APlanIsRead) {
  WorkCounters counters;
  const PlanningMethod::Plan plan = read_plan_answer(
      R"({"solved": true, "trajectory": {"t": [0, 0.5], "q": [[1, 2], [3, 4]]}, "counters": {"kinematics": 2}})",
      2, counters);
  EXPECT_TRUE(plan.solved);
  EXPECT_EQ(plan.trajectory.t, (std::vector<double>{0, 0.5}));
  ASSERT_EQ(plan.trajectory.q.size(), 2u);
  EXPECT_EQ(plan.trajectory.q[1], JointVector(Eigen::Vector2d(3, 4)));
  EXPECT_EQ(counters.kinematics, 2u);
  EXPECT_FALSE(read_plan_answer(R"({"solved": false})", 2, counters).solved);

  EXPECT_EQ(plan_fault(R"({"solved": true})"), "expected a key 'trajectory', got none");
  EXPECT_EQ(plan_fault(R"({"solved": 1})"), "solved: expected true or false, got 1");
  EXPECT_EQ(plan_fault(R"({"solved": true, "trajectory": {"t": [0], "q": []}})"),
            "trajectory.q: expected as many rows as there are times, 1, got a list of 0");
  EXPECT_EQ(plan_fault(R"({"solved": true, "trajectory": {"t": [0], "q": [[1]]}})"),
            "trajectory.q[0]: expected a list of 2 joint angles [rad], got a list of 1");
  EXPECT_EQ(plan_fault(R"({"solved": true, "trajectory": {"t": [null], "q": [[1, 1]]}})"),
            "trajectory.t[0]: expected a finite number, got null");
}

TEST(Answers, APreparedMethodSaysNothing) {
  EXPECT_NO_THROW(read_prepare_answer("{}"));
  EXPECT_EQ(message_of([] { read_prepare_answer(R"({"ok": true})"); }),
            "expected an object without keys, got an object");
}

TEST(Answers, NestingWithoutEndIsRefusedAndNotFollowed) {
  EXPECT_THAT(step_fault(std::string(1'000'000, '[')), HasSubstr("expected one line that is"));
}

TEST(Answers, ThePlanOfAnyProblemFits) {
  // 17 digits, sign, point, exponent of three digits with its sign, and a comma, for each number.
  const std::size_t number = std::string("-1.2345678901234567e-300,").size();
  EXPECT_GT(longest_plan_answer(1'000'000, 16), 1'000'001 * (17 * number + 2));
}

}  // namespace
}  // namespace bqsa::harness
