#include "harness/external/external_method.hpp"

#include <fmt/core.h>

#include <functional>
#include <string>
#include <utility>

#include "harness/external/answers.hpp"
#include "harness/external/command_words.hpp"
#include "harness/external/external_process.hpp"
#include "harness/external/requests.hpp"
#include "harness/input_error.hpp"
#include "harness/methods.hpp"
#include "harness/stray_processes.hpp"

namespace bqsa::harness {
namespace {

/// A running program that speaks the protocol.
class Program {
 public:
  explicit Program(const std::string& command) : process_(command) {}
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program() {
    if (!failed_) process_.say_goodbye(quit_request());
  }

  /// @param read  reads the answer, and throws AnswerError if it cannot be used
  void ask(const ExternalRequest& request, const std::function<void(const std::string&)>& read) {
    failed_ = true;  // until it has answered
    const std::string line = process_.ask(request);
    try {
      read(line);
    } catch (const AnswerError& error) {
      throw process_.fault(request, error.what());
    }
    failed_ = false;
  }

 private:
  ExternalProcess process_;
  bool failed_ = false;
};

/// What both kinds of methods are made of.
struct Made {
  Program program;
  std::vector<ParameterDeclaration> declared;
  ParameterValues values;

  void prepare(const Problem& problem) {
    program.ask({.name = "prepare", .line = prepare_request(problem, declared, values)},
                read_prepare_answer);
  }
};

class ExternalReactive final : public ReactiveMethod {
 public:
  ExternalReactive(const std::string& command, const std::vector<ParameterDeclaration>& declared,
                   const ParameterValues& values)
      : made_{Program(command), declared, values} {}

  void prepare(const Problem& problem) override {
    counters_ = {};
    obstacles_ = static_cast<int>(problem.obstacles.size());
    turned_ = problem.has_orientation();
    made_.prepare(problem);
  }

  void step(const StepInput& input, StepOutput& output) override {
    made_.program.ask(
        {.name = fmt::format("step {}", input.tick), .line = step_request(input, turned_)},
        [&](const std::string& line) {
          read_step_answer(line, input, obstacles_, output, counters_);
        });
  }

 private:
  Made made_;
  int obstacles_ = 0;
  bool turned_ = false;
};

class ExternalPlanner final : public PlanningMethod {
 public:
  ExternalPlanner(const std::string& command, const std::vector<ParameterDeclaration>& declared,
                  const ParameterValues& values)
      : made_{Program(command), declared, values} {}

  void prepare(const Problem& problem) override {
    counters_ = {};
    joints_ = problem.chain.joints();
    ticks_ = problem.ticks;
    made_.prepare(problem);
  }

  Plan plan(double budget_s, std::uint64_t seed) override {
    Plan plan;
    made_.program.ask(
        {.name = "plan",
         .line = plan_request(budget_s, seed),
         .longest_answer = longest_plan_answer(ticks_, joints_)},
        [&](const std::string& line) { plan = read_plan_answer(line, joints_, counters_); });
    return plan;
  }

 private:
  Made made_;
  int joints_ = 0;
  int ticks_ = 0;
};

/// What the program says of itself.
MethodEntry described(const std::string& command) {
  MethodEntry entry;
  const StrayProcesses left_behind;
  Program program(command);
  program.ask({.name = "describe", .line = describe_request(), .limit_s = kDescribeLimit},
              [&entry](const std::string& line) { entry = read_describe_answer(line); });
  if (!entry.name.empty()) entry.summary = fmt::format("{}: {}", entry.name, entry.summary);
  return entry;
}

}  // namespace

MethodEntry external_method(std::string_view name_and_command) {
  const std::size_t equals = name_and_command.find('=');
  const std::string name(name_and_command.substr(0, equals));
  if (equals == std::string_view::npos || !is_method_name(name)) {
    throw InputError(
        fmt::format("--external: expected NAME=COMMAND with a NAME [a-z][a-z0-9_]*, got '{}'",
                    name_and_command));
  }
  const std::string command(name_and_command.substr(equals + 1));
  MethodEntry entry;
  try {
    entry = described(command);
  } catch (const std::exception& error) {
    throw InputError(fmt::format("--external {}: {}", name, error.what()));
  }
  entry.name = name;
  entry.external = command;
  const auto make = [command, plans = entry.capabilities.plans,
                     declared = entry.parameters](const ParameterValues& values) {
    return plans ? std::unique_ptr<Method>(
                       std::make_unique<ExternalPlanner>(command, declared, values))
                 : std::make_unique<ExternalReactive>(command, declared, values);
  };
  entry.make = make;
  return entry;
}

}  // namespace bqsa::harness
