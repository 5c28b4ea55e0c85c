#include "baselines/potential_field.hpp"

#include <algorithm>

#include "baselines/closest/exact_distance_search.hpp"

namespace bqsa::baselines {
namespace {

// The best of results/gain_sweep (tools/sweep_gains.py).
constexpr PotentialFieldSettings kDefaults{
    .influence = 0.14, .gain = 8.9e-5, .floor = 0.011, .exempt_length = 0.077, .all_pairs = false};

PotentialFieldSettings read(const ParameterValues& values) {
  PotentialFieldSettings settings{.influence = values.number("influence"),
                                  .gain = values.number("gain"),
                                  .floor = values.number("floor"),
                                  .exempt_length = values.number("exempt_length"),
                                  .all_pairs = read_all_pairs(values),
                                  .where = values.choice("where") == "task"
                                               ? RepulsionSpace::kTask
                                               : RepulsionSpace::kNullSpace,
                                  .step_limit = read_step_limit(values)};
  if (!(settings.floor < settings.influence)) {
    throw ParameterError("parameter 'floor': expected less than 'influence'");
  }
  return settings;
}

}  // namespace

double repulsive_force(double clearance, const PotentialFieldSettings& settings) {
  const double d = std::max(clearance, settings.floor);
  return d < settings.influence ? (1 / d - 1 / settings.influence) / (d * d) : 0;
}

void PotentialField::prepare(const Problem& problem) {
  problem_ = &problem;
  counters_ = {};
  surroundings_.assign(problem,
                       {.influence = settings_.influence,
                        .exempt_length = settings_.exempt_length,
                        .all_pairs = settings_.all_pairs},
                       counters_);
}

void PotentialField::step(const StepInput& input, StepOutput& output) {
  output = {};
  surroundings_.look(input.tick, input.q);
  const JointVector& tracking = surroundings_.track(input);
  JointVector repulsion = JointVector::Zero(input.q.size());
  for (const Escape& escape : surroundings_.escapes()) {
    repulsion += settings_.gain * repulsive_force(escape.clearance, settings_) * escape.j0;
    surroundings_.record(escape, output);
  }
  if (settings_.where == RepulsionSpace::kNullSpace && !surroundings_.escapes().empty()) {
    self_motions_.assign(surroundings_.task_jacobian());
    repulsion = self_motions_.project(repulsion);
  }
  make_step(*problem_, input, tracking, repulsion, settings_.step_limit, output);
}

MethodEntry potential_field_method() {
  return {
      .name = "potential_field",
      .summary = "repulsive potential of Khatib, on the self-motions or as it is",
      .source =
          "Khatib: Real-Time Obstacle Avoidance for Manipulators and Mobile Robots, Int. J. of "
          "Robotics Research 5(1), 1986",
      .capabilities = {.planar = true,
                       .spatial = true,
                       .link_radius = true,
                       .margin = true,
                       .moving = true,
                       .orientation = true},
      .parameters = {choice_parameter("where", {"null_space", "task"},
                                      "where the repulsion acts: self-motions only, or all joints"),
                     {"influence", "m", kDefaults.influence, 1e-6, 10,
                      "clearance below which an obstacle repels, d0"},
                     {"gain", "rad m^2/s", kDefaults.gain, 0, 1e9, "gain of the repulsion, eta"},
                     {"floor", "m", kDefaults.floor, 1e-6, 10,
                      "clearance below which the repulsion grows no more (below d0)"},
                     exempt_length_parameter(kDefaults.exempt_length),
                     acting_points_parameter(kDefaults.all_pairs),
                     step_limit_parameter()},
      .make = [](const ParameterValues& values) -> std::unique_ptr<Method> {
        return std::make_unique<PotentialField>(read(values),
                                                std::make_unique<ExactDistanceSearch>());
      }};
}

}  // namespace bqsa::baselines
