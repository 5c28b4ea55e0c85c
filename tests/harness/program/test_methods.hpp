/// @file
/// Deliberately simple and deliberately bad methods, to see what the harness makes of them.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "bqsa/method.hpp"
#include "harness/method_spec.hpp"
#include "harness/scenario/scenario.hpp"

namespace bqsa::harness {

using Step = std::function<void(const StepInput&, StepOutput&)>;

/// A reactive method that does what a function says.
class ScriptedMethod final : public ReactiveMethod {
 public:
  explicit ScriptedMethod(Step step) : step_(std::move(step)) {}
  void prepare(const Problem&) override {}
  void step(const StepInput& input, StepOutput& output) override {
    ++counters_.iterations;
    step_(input, output);
  }

 private:
  Step step_;
};

/// A planning method that returns what it is given.
class ScriptedPlanner final : public PlanningMethod {
 public:
  explicit ScriptedPlanner(Plan plan) : plan_(std::move(plan)) {}
  void prepare(const Problem&) override {}
  Plan plan(double, std::uint64_t) override { return plan_; }

 private:
  Plan plan_;
};

inline MethodEntry entry_of(std::string name,
                            std::function<std::unique_ptr<Method>(const ParameterValues&)> make) {
  return {.name = std::move(name),
          .summary = "for tests",
          .source = "tests",
          .capabilities = {.planar = true, .spatial = true, .link_radius = true, .margin = true},
          .parameters = {},
          .make = std::move(make)};
}

inline MethodSpec scripted(std::string name, Step step) {
  return with_defaults(entry_of(std::move(name), [step](const ParameterValues&) {
    return std::make_unique<ScriptedMethod>(step);
  }));
}

inline MethodSpec planned(std::string name, PlanningMethod::Plan plan) {
  MethodEntry entry = entry_of(std::move(name), [plan](const ParameterValues&) {
    return std::make_unique<ScriptedPlanner>(plan);
  });
  entry.capabilities.plans = true;
  return with_defaults(entry);
}

/// Stays where it is and calls every tick free.
inline void stand_still(const StepInput& input, StepOutput& output) { output.q = input.q; }

inline Scenario planar_scenario() {
  return load_scenario(BQSA_SOURCE_DIR "/scenarios/planar_7r.yaml");
}

/// A straight motion of a two-link arm, free of everything but what a test adds.
inline Scenario quiet_scenario() {
  Scenario scenario{.file = "quiet.yaml",
                    .description = "",
                    .sha256 = "",
                    .problem = {"quiet", SerialChain(planar_chain({0.5, 0.5}))},
                    .truth = {},
                    .geometry = {}};
  Problem& problem = scenario.problem;
  problem.ticks = 20;
  problem.dt = 0.05;
  problem.start = Eigen::Vector2d(0, 0.5);
  problem.obstacles = {{"far", embedded(rotated_ellipse({-2, -2}, {0.1, 0.1}, 0))}};
  scenario.truth = ellipsoids_as_told(problem);
  const SerialChain chain = problem.chain;
  // The first joint turns by 0.6 rad in all, the second keeps still.
  problem.desired_tip = [chain](double t) -> Eigen::Vector3d {
    ChainPose pose;
    chain.forward(Eigen::Vector2d(0.6 * t, 0.5), pose);
    return pose.tip();
  };
  return scenario;
}

inline JointVector on_path(const StepInput& input) { return Eigen::Vector2d(0.6 * input.t, 0.5); }

inline void follow(const StepInput& input, StepOutput& output) { output.q = on_path(input); }

}  // namespace bqsa::harness
