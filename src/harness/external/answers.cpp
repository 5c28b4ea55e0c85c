#include "harness/external/answers.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "harness/external/answer_value.hpp"
#include "harness/external/external_process.hpp"
#include "harness/external/requests.hpp"
#include "harness/methods.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

constexpr int kMost = std::numeric_limits<int>::max();

/// The answer as JSON, an object by which the method does not say that it failed.
nlohmann::json parse(std::string_view line) {
  nlohmann::json json = nlohmann::json::parse(line, nullptr, /* allow_exceptions = */ false);
  if (!json.is_object()) {
    throw AnswerError(
        fmt::format("expected one line that is a JSON object, got '{}'", excerpt(line)));
  }
  const AnswerValue answer(json);
  if (answer.has("error")) throw AnswerError("it failed: " + answer["error"].text());
  return json;
}

ParameterDeclaration choice_of(const AnswerValue& value) {
  value.expect_keys({"name", "choices", "default", "meaning"});
  std::vector<std::string> choices;
  for (const AnswerValue& choice : value["choices"].list()) {
    const std::string name = choice.text();
    if (name.empty() || name.find_first_of(",=") != std::string::npos) {
      choice.refuse("a name without , and =");
    }
    choices.push_back(name);
  }
  if (choices.empty()) value["choices"].refuse("at least one name");
  ParameterDeclaration parameter = choice_parameter("", choices, "");
  if (!value.has("default")) return parameter;
  const auto chosen = std::find(choices.begin(), choices.end(), value["default"].text());
  if (chosen == choices.end()) value["default"].refuse("one of the choices");
  parameter.default_value = static_cast<double>(chosen - choices.begin());
  return parameter;
}

ParameterDeclaration number_of(const AnswerValue& value) {
  value.expect_keys({"name", "unit", "default", "minimum", "maximum", "integer", "meaning"});
  ParameterDeclaration parameter;
  parameter.unit = value.has("unit") ? value["unit"].text() : "-";
  parameter.default_value = value["default"].number();
  parameter.minimum = value["minimum"].number();
  parameter.maximum = value["maximum"].number();
  parameter.integer = value.boolean_or("integer", false);
  for (const char* key : {"default", "minimum", "maximum"}) {
    if (parameter.integer) value[key].integer(-kMost, kMost);
  }
  if (parameter.default_value < parameter.minimum || parameter.default_value > parameter.maximum) {
    value["default"].refuse(
        fmt::format("a number from {} to {}", parameter.minimum, parameter.maximum));
  }
  return parameter;
}

std::vector<ParameterDeclaration> parameters_of(const AnswerValue& list) {
  std::vector<ParameterDeclaration> parameters;
  std::set<std::string> names;
  for (const AnswerValue& value : list.list()) {
    ParameterDeclaration parameter = value.has("choices") ? choice_of(value) : number_of(value);
    parameter.name = value["name"].text();
    if (!is_method_name(parameter.name)) value["name"].refuse("a name [a-z][a-z0-9_]*");
    if (!names.insert(parameter.name).second) value["name"].refuse("a name that is given once");
    parameter.meaning = value["meaning"].text();
    parameters.push_back(parameter);
  }
  return parameters;
}

/// Those not named are those that a Capabilities object has by default, but for prismatic joints: a
/// program that turns all joints would be wrong, and not refuse.
Capabilities capabilities_of(const AnswerValue& value) {
  value.expect_keys({"planar", "spatial", "link_radius", "margin", "moving", "prismatic",
                     "orientation", "keeps_limits"});
  Capabilities can;
  can.planar = value.boolean_or("planar", can.planar);
  can.spatial = value.boolean_or("spatial", can.spatial);
  can.link_radius = value.boolean_or("link_radius", can.link_radius);
  can.margin = value.boolean_or("margin", can.margin);
  can.moving = value.boolean_or("moving", can.moving);
  can.prismatic = value.boolean_or("prismatic", false);
  can.orientation = value.boolean_or("orientation", can.orientation);
  can.keeps_limits = value.boolean_or("keeps_limits", can.keeps_limits);
  if (!can.planar && !can.spatial) value.refuse("planar, spatial or both to be true");
  return can;
}

template <typename Enums>
auto named(const AnswerValue& value, const Enums& known) -> typename Enums::value_type {
  const std::string text = value.text();
  std::string names;
  for (const auto one : known) {
    if (text == name_of(one)) return one;
    names += fmt::format("{}'{}'", names.empty() ? "" : ", ", name_of(one));
  }
  value.refuse("one of " + names);
}

void read_counters(const AnswerValue& answer, WorkCounters& counters) {
  if (!answer.has("counters")) return;
  const AnswerValue value = answer["counters"];
  value.expect_keys({"quadratics", "bounds", "point_pairs", "distance_queries", "kinematics",
                     "jacobians", "linear_solves", "iterations"});
  const auto read = [&value](const char* key, std::uint64_t& count) {
    if (value.has(key)) count = value[key].count();
  };
  read("quadratics", counters.quadratics);
  read("bounds", counters.bounds);
  read("point_pairs", counters.point_pairs);
  read("distance_queries", counters.distance_queries);
  read("kinematics", counters.kinematics);
  read("jacobians", counters.jacobians);
  read("linear_solves", counters.linear_solves);
  read("iterations", counters.iterations);
}

void read_clamps(const AnswerValue& clamps, int obstacles, StepOutput& output) {
  const std::vector<AnswerValue> list = clamps.list();
  if (list.size() > StepOutput::kMaxClamps) {
    clamps.refuse(fmt::format("at most {} clamps", StepOutput::kMaxClamps));
  }
  for (const AnswerValue& value : list) {
    value.expect_keys({"link", "obstacle", "anchor", "offset", "increments"});
    record_clamp({.link = value["link"].integer(1, kMaxLinks),
                  .obstacle = value["obstacle"].integer(0, obstacles - 1),
                  .anchor = value.integer_or("anchor", 0, kMaxJoints, 0),
                  .offset = value.has("offset") ? value["offset"].number() : 0,
                  .increments = value.integer_or("increments", 0, kMost, 0)},
                 output);
  }
}

constexpr std::array kStates{TickState::kFree, TickState::kClamped, TickState::kUnclaimed,
                             TickState::kInfeasible};
constexpr std::array kReasons{Infeasible::kNoFreeConfiguration, Infeasible::kNoFreeMotion,
                              Infeasible::kStepTooLarge, Infeasible::kJointLimit,
                              Infeasible::kDiverged};

}  // namespace

MethodEntry read_describe_answer(std::string_view line) {
  const nlohmann::json json = parse(line);
  const AnswerValue answer(json);
  if (const std::string version = answer["protocol"].text(); version != kMethodProtocol) {
    answer["protocol"].refuse(fmt::format("\"{}\"", kMethodProtocol));
  }
  answer.expect_keys(
      {"protocol", "name", "summary", "source", "kind", "capabilities", "parameters"});
  MethodEntry entry;
  if (answer.has("name")) entry.name = answer["name"].text();
  entry.summary = answer["summary"].text();
  entry.source = answer["source"].text();
  entry.capabilities = capabilities_of(answer["capabilities"]);
  const std::string kind = answer["kind"].text();
  if (kind != "reactive" && kind != "planning") answer["kind"].refuse("'reactive' or 'planning'");
  entry.capabilities.plans = kind == "planning";
  if (answer.has("parameters")) entry.parameters = parameters_of(answer["parameters"]);
  return entry;
}

void read_prepare_answer(std::string_view line) {
  const nlohmann::json json = parse(line);
  if (!json.empty()) AnswerValue(json).refuse("an object without keys");
}

void read_step_answer(std::string_view line, const StepInput& input, int obstacles,
                      StepOutput& output, WorkCounters& counters) {
  const nlohmann::json json = parse(line);
  const AnswerValue answer(json);
  answer.expect_keys({"tick", "q", "state", "reason", "link", "obstacle", "clamps", "counters"});
  // A line too many would else stand for the answer to the next request, and so on to the end.
  if (answer["tick"].integer(0, kMost) != input.tick) {
    answer["tick"].refuse(fmt::format("{}, the tick that was asked for", input.tick));
  }
  output = {};
  read_counters(answer, counters);
  output.state = named(answer["state"], kStates);
  if (output.state == TickState::kInfeasible) {
    hold(input.q, named(answer["reason"], kReasons), answer.integer_or("link", 0, kMaxLinks, 0),
         answer.integer_or("obstacle", -1, obstacles - 1, -1), output);
    return;
  }
  for (const char* key : {"reason", "link", "obstacle"}) {
    if (answer.has(key)) answer[key].refuse("no such key but for the state 'infeasible'");
  }
  output.q = answer["q"].angles(static_cast<int>(input.q.size()));
  if (answer.has("clamps")) read_clamps(answer["clamps"], obstacles, output);
}

std::size_t longest_plan_answer(int ticks, int joints) {
  constexpr std::size_t kBytesOfANumber = 32;
  return ExternalRequest::kLongestAnswer + kBytesOfANumber * (static_cast<std::size_t>(ticks) + 1) *
                                               (static_cast<std::size_t>(joints) + 1);
}

PlanningMethod::Plan read_plan_answer(std::string_view line, int joints, WorkCounters& counters) {
  const nlohmann::json json = parse(line);
  const AnswerValue answer(json);
  answer.expect_keys({"solved", "trajectory", "counters"});
  read_counters(answer, counters);
  PlanningMethod::Plan plan;
  plan.solved = answer["solved"].boolean();
  if (!plan.solved && !answer.has("trajectory")) return plan;
  const AnswerValue trajectory = answer["trajectory"];
  trajectory.expect_keys({"t", "q"});
  for (const AnswerValue& t : trajectory["t"].list()) plan.trajectory.t.push_back(t.number());
  for (const AnswerValue& q : trajectory["q"].list()) {
    plan.trajectory.q.push_back(q.angles(joints));
  }
  if (plan.trajectory.t.size() != plan.trajectory.q.size()) {
    trajectory["q"].refuse(
        fmt::format("as many rows as there are times, {}", plan.trajectory.t.size()));
  }
  return plan;
}

}  // namespace bqsa::harness
