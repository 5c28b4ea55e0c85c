#include "baselines/null_space_avoidance.hpp"

#include <algorithm>

namespace bqsa::baselines {

double influence_gain(double clearance, const AvoidanceSettings& s) {
  return std::clamp((s.influence - clearance) / (s.influence - s.full_distance), 0.0, 1.0);
}

JointVector self_motion_away(double clearance, double speed, const JointVector& j0,
                             const JointVector& projected, const JointVector& tracking,
                             const AvoidanceSettings& settings) {
  if (settings.law == AvoidanceLaw::kGradientProjection) {
    return settings.gradient_gain * (settings.influence - clearance) * projected;
  }
  const double alpha = influence_gain(clearance, settings);
  const double wanted = alpha * speed - j0.dot(tracking);
  return alpha * wanted / (j0.dot(projected) + settings.regularization) * projected;
}

void NullSpaceAvoidance::prepare(const Problem& problem) {
  problem_ = &problem;
  counters_ = {};
  surroundings_.assign(problem,
                       {.influence = settings_.influence,
                        .exempt_length = settings_.exempt_length,
                        .all_pairs = settings_.all_pairs,
                        .obstacle_velocity = settings_.obstacle_velocity},
                       counters_);
}

void NullSpaceAvoidance::step(const StepInput& input, StepOutput& output) {
  output = {};
  surroundings_.look(input.tick, input.q);

  const JointVector& tracking = surroundings_.track(input);
  const std::vector<Escape>& escapes = surroundings_.escapes();
  if (!escapes.empty()) self_motions_.assign(surroundings_.task_jacobian());
  JointVector avoidance = JointVector::Zero(input.q.size());
  for (const Escape& escape : escapes) {
    avoidance += self_motion_away(escape.clearance, settings_.escape_velocity + escape.approach,
                                  escape.j0, self_motions_.project(escape.j0), tracking, settings_);
    surroundings_.record(escape, output);
  }
  make_step(*problem_, input, tracking, avoidance, settings_.step_limit, output);
}

std::vector<ParameterDeclaration> avoidance_parameters(const AvoidanceSettings& defaults,
                                                       std::initializer_list<AvoidanceLaw> laws) {
  const auto has = [&laws](AvoidanceLaw law) { return std::ranges::find(laws, law) != laws.end(); };
  std::vector<ParameterDeclaration> declared = {
      {"influence", "m", defaults.influence, 1e-6, 10, "radius of the sphere of influence, d_m"}};
  if (has(AvoidanceLaw::kMaciejewskiKlein)) {
    declared.insert(declared.end(), {{"full_distance", "m", defaults.full_distance, 0, 10,
                                      "distance at which the gains reach 1, d_o (below d_m)"},
                                     {"escape_velocity", "m/s", defaults.escape_velocity, 0, 100,
                                      "speed away from the obstacle, v_0"},
                                     {"regularization", "m^2", defaults.regularization, 1e-12, 1,
                                      "regularization of the 1-D pseudo-inverse, delta"}});
  }
  if (has(AvoidanceLaw::kGradientProjection)) {
    declared.push_back({"gradient_gain", "rad/(s m^2)", defaults.gradient_gain, 0, 1e9,
                        "gain of gradient projection, mu"});
  }
  declared.push_back(exempt_length_parameter(defaults.exempt_length));
  return declared;
}

AvoidanceSettings read_avoidance(const ParameterValues& values, AvoidanceSettings settings) {
  settings.influence = values.number("influence");
  settings.exempt_length = values.number("exempt_length");
  if (settings.law == AvoidanceLaw::kGradientProjection) {
    settings.gradient_gain = values.number("gradient_gain");
    return settings;
  }
  settings.full_distance = values.number("full_distance");
  settings.escape_velocity = values.number("escape_velocity");
  settings.regularization = values.number("regularization");
  if (!(settings.full_distance < settings.influence)) {
    throw ParameterError("parameter 'full_distance': expected less than 'influence'");
  }
  return settings;
}

}  // namespace bqsa::baselines
