#include "baselines/qp/qp_methods.hpp"

#include "baselines/closest/exact_distance_search.hpp"
#include "baselines/qp/qp_avoidance.hpp"

namespace bqsa::baselines {
namespace {

constexpr Capabilities kEverything{.planar = true,
                                   .spatial = true,
                                   .link_radius = true,
                                   .margin = true,
                                   .moving = true,
                                   .orientation = true};

// The gains are the best of results/gain_sweep (tools/sweep_gains.py).
const QpAvoidanceSettings kQp{.solver = QpSolver::kActiveSet,
                              .rows = {.approach = ApproachLimit::kDamped,
                                       .safe_distance = 0.018,
                                       .gain = 2.8,
                                       .max_velocity = 1.5},
                              .influence = 0.072,
                              .exempt_length = 0.063,
                              .all_pairs = true};
const QpAvoidanceSettings kCompactQp{
    .solver = QpSolver::kCompact,
    .rows = {.safe_distance = 0.019, .gain = 4.2, .max_velocity = 1.3, .drift_gain = 0.3},
    .influence = 0.096,
    .exempt_length = 0.023,
    .all_pairs = false};

/// What both have.
std::vector<ParameterDeclaration> common_parameters(const QpAvoidanceSettings& defaults) {
  return {{"influence", "m", defaults.influence, 1e-6, 10,
           "clearance below which an obstacle constrains the links"},
          {"safe_distance", "m", defaults.rows.safe_distance, 0, 10,
           "clearance at which links come no closer, d_s (below influence)"},
          {"gain", "1/s", defaults.rows.gain, 0, 1e4,
           "of the velocity damper: a link may approach at gain (d - d_s)"},
          {"max_velocity", "rad/s", defaults.rows.max_velocity, 1e-3, 1e3,
           "of every joint, beside the problem's limits; the tip's task goes first"},
          exempt_length_parameter(defaults.exempt_length),
          {"slack_weight", "rad^2/m^2", defaults.rows.slack_weight, 1, 1e6,
           "of squared violations where the obstacles' constraints cannot be kept"},
          acting_points_parameter(defaults.all_pairs)};
}

/// @throws ParameterError if safe_distance is not below influence
QpAvoidanceSettings read(const ParameterValues& values, QpAvoidanceSettings settings) {
  settings.influence = values.number("influence");
  settings.rows.safe_distance = values.number("safe_distance");
  settings.rows.gain = values.number("gain");
  settings.rows.max_velocity = values.number("max_velocity");
  settings.exempt_length = values.number("exempt_length");
  settings.rows.slack_weight = values.number("slack_weight");
  settings.all_pairs = read_all_pairs(values);
  if (!(settings.rows.safe_distance < settings.influence)) {
    throw ParameterError("parameter 'safe_distance': expected less than 'influence'");
  }
  return settings;
}

std::unique_ptr<Method> make(const QpAvoidanceSettings& settings) {
  return std::make_unique<QpAvoidance>(settings, std::make_unique<ExactDistanceSearch>());
}

}  // namespace

MethodEntry qp_method() {
  std::vector<ParameterDeclaration> declared = common_parameters(kQp);
  declared.push_back(choice_parameter(
      "approach", {"damped", "none"},
      "how fast a link may come closer: by the velocity damper, or within influence not at all"));
  declared.push_back(choice_parameter("solver", {"active_set", "dual_network"},
                                      "Goldfarb and Idnani, or the dual neural network"));
  declared.push_back({"network_tolerance", "m/s, rad/s", kQp.network.tolerance, 1e-12, 1,
                      "largest residual of a row at which the network has settled"});
  declared.push_back(integer_parameter("network_steps", "-", kQp.network.max_iterations, 1,
                                       100000000, "after which the network is read out"));
  return {.name = "qp",
          .summary = "least joint velocity with obstacles and limits as inequalities",
          .source =
              "Zhang and Wang: Obstacle Avoidance for Kinematically Redundant Manipulators Using a "
              "Dual Neural Network, IEEE Trans. Systems, Man, and Cybernetics B 34(1), 2004; "
              "velocity damper: Faverjon and Tournassoud 1987",
          .capabilities = kEverything,
          .parameters = declared,
          .make = [](const ParameterValues& values) -> std::unique_ptr<Method> {
            QpAvoidanceSettings settings = read(values, kQp);
            if (values.choice("approach") == "none") settings.rows.approach = ApproachLimit::kNone;
            if (values.choice("solver") == "dual_network") {
              settings.solver = QpSolver::kDualNetwork;
            }
            settings.network.tolerance = values.number("network_tolerance");
            settings.network.max_iterations = values.integer("network_steps");
            return make(settings);
          }};
}

MethodEntry compact_qp_method() {
  std::vector<ParameterDeclaration> declared = common_parameters(kCompactQp);
  declared.push_back({"drift_gain", "1/s", kCompactQp.rows.drift_gain, 0, 1e3,
                      "pull back to the start posture, mu"});
  declared.push_back(choice_parameter(
      "constraints", {"inequality", "equality"},
      "escape velocities of links: bounds, or closer than safe_distance exact values"));
  return {.name = "compact_qp",
          .summary = "drift-free criterion, tip task eliminated, obstacles as inequalities",
          .source =
              "Cheng, Chen and Sun: Resolving Manipulator Redundancy Under Inequality Constraints, "
              "IEEE Trans. Robotics and Automation 10(1), 1994",
          .capabilities = kEverything,
          .parameters = declared,
          .make = [](const ParameterValues& values) -> std::unique_ptr<Method> {
            QpAvoidanceSettings settings = read(values, kCompactQp);
            settings.rows.drift_gain = values.number("drift_gain");
            settings.rows.equalities = values.choice("constraints") == "equality";
            return make(settings);
          }};
}

}  // namespace bqsa::baselines
