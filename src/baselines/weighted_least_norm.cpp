#include "baselines/weighted_least_norm.hpp"

#include <algorithm>
#include <cmath>

#include "baselines/closest/exact_distance_search.hpp"
#include "baselines/limited_step.hpp"
#include "baselines/null_space_avoidance.hpp"

namespace bqsa::baselines {
namespace {

// The best of results/gain_sweep (tools/sweep_gains.py).
constexpr WeightedLeastNormSettings kDefaults{
    .influence = 0.16, .gain = 2.7, .decay = 2.3, .exponent = 0.75, .exempt_length = 0.19};

WeightedLeastNormSettings read(const ParameterValues& values) {
  return {
      .influence = values.number("influence"),
      .gain = values.number("gain"),
      .decay = values.number("decay"),
      .exponent = values.number("exponent"),
      .exempt_length = values.number("exempt_length"),
      .all_pairs = read_all_pairs(values),
      .motion = values.choice("motion") == "last" ? JudgedMotion::kLast : JudgedMotion::kPlanned};
}

}  // namespace

double limit_gradient(double q, double lower, double upper) {
  const double range = upper - lower;
  if (!(range > 0 && std::isfinite(range))) return 0;
  const double above = std::max(upper - q, 1e-6 * range);
  const double below = std::max(q - lower, 1e-6 * range);
  return range * range * (below - above) / (4 * above * above * below * below);
}

double collision_slope(double clearance, const WeightedLeastNormSettings& s) {
  const double d = std::max(clearance, 1e-5);
  const double f = s.gain * std::exp(-s.decay * d) * std::pow(d, -s.exponent);
  return -f * (s.decay + s.exponent / d);
}

void WeightedLeastNorm::prepare(const Problem& problem) {
  problem_ = &problem;
  counters_ = {};
  no_weights_ = JointVector::Ones(problem.chain.joints());
  no_clamping_ = JointVector::Zero(problem.chain.joints());
  q_before_ = problem.start;
  surroundings_.assign(problem,
                       {.influence = settings_.influence,
                        .exempt_length = settings_.exempt_length,
                        .all_pairs = settings_.all_pairs},
                       counters_);
}

void WeightedLeastNorm::step(const StepInput& input, StepOutput& output) {
  output = {};
  surroundings_.look(input.tick, input.q);
  const TaskVector x_dot = surroundings_.task_velocity(input);
  JointVector motion = (input.q - q_before_) / problem_->dt;
  if (settings_.motion == JudgedMotion::kPlanned) {
    solve(x_dot, no_weights_);
    motion = ik_.q_dot;
  }
  solve(x_dot, weights(input.q, motion));
  for (const Escape& escape : surroundings_.escapes()) {
    surroundings_.record(escape, output);
  }
  q_before_ = input.q;
  make_step(*problem_, input, ik_.q_dot, no_clamping_, StepLimit::kHold, output);
}

/// The weights of joints at q that move so [rad/s].
JointVector WeightedLeastNorm::weights(const JointVector& q, const JointVector& motion) const {
  JointVector w = no_weights_;
  const auto slow_down = [&w, &motion](Eigen::Index joint, double gradient) {
    if (gradient * motion(joint) >= 0) w(joint) += std::abs(gradient);
  };
  const JointLimits& limits = problem_->limits;
  const Eigen::Index limited = std::min(limits.lower.size(), limits.upper.size());
  for (Eigen::Index i = 0; i < limited; ++i) {
    slow_down(i, limit_gradient(q(i), limits.lower(i), limits.upper(i)));
  }
  for (const Escape& escape : surroundings_.escapes()) {
    const double slope = collision_slope(escape.clearance, settings_);
    for (Eigen::Index i = 0; i < w.size(); ++i) slow_down(i, slope * escape.j0(i));
  }
  return w;
}

/// Damped where the arm is nearly singular, not where weights alone make J W^{-1/2} small.
void WeightedLeastNorm::solve(const TaskVector& x_dot, const JointVector& weights) {
  const double scale = 1 / std::sqrt(weights.maxCoeff());
  HybridIkSettings settings;
  settings.singular_threshold *= scale;
  settings.lambda_max *= scale;
  solve_hybrid_ik(surroundings_.task_jacobian(), x_dot, weights, no_clamping_, settings, ik_);
  ++counters_.linear_solves;
}

MethodEntry weighted_least_norm_method() {
  return {.name = "weighted_least_norm",
          .summary = "slows joints that move towards limits or obstacles; pushes none away",
          .source =
              "Chan and Dubey: A Weighted Least-Norm Solution Based Scheme for Avoiding Joint "
              "Limits for Redundant Joint Manipulators, IEEE Trans. on Robotics and Automation "
              "11(2), 1995; obstacles as in Dariush et al.: Constrained Closed Loop Inverse "
              "Kinematics, ICRA 2010",
          .capabilities = {.planar = true,
                           .spatial = true,
                           .link_radius = true,
                           .margin = true,
                           .moving = true,
                           .orientation = true},
          .parameters = {{"influence", "m", kDefaults.influence, 1e-6, 10,
                          "clearance below which an obstacle has weight"},
                         {"gain", "m^beta", kDefaults.gain, 0, 1e9,
                          "factor of the collision function, rho"},
                         {"decay", "1/m", kDefaults.decay, 0, 1e6,
                          "exponential decay of the collision function, alpha"},
                         {"exponent", "-", kDefaults.exponent, 0, 10,
                          "exponent of the distance in the collision function, beta"},
                         exempt_length_parameter(kDefaults.exempt_length),
                         acting_points_parameter(kDefaults.all_pairs),
                         choice_parameter("motion", {"last", "planned"},
                                          "motion by which joints move towards something: the last "
                                          "tick's, or this one's without weights")},
          .make = [](const ParameterValues& values) -> std::unique_ptr<Method> {
            return std::make_unique<WeightedLeastNorm>(read(values),
                                                       std::make_unique<ExactDistanceSearch>());
          }};
}

}  // namespace bqsa::baselines
