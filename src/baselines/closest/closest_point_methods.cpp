#include "baselines/closest/closest_point_methods.hpp"

#include "baselines/closest/exact_distance_search.hpp"
#include "baselines/closest/fcl_distance_search.hpp"
#include "baselines/closest/test_point_search.hpp"
#include "baselines/closest/vectorized_test_point_search.hpp"
#include "baselines/null_space_avoidance.hpp"

namespace bqsa::baselines {
namespace {

constexpr Capabilities kEverything{.planar = true,
                                   .spatial = true,
                                   .link_radius = true,
                                   .margin = true,
                                   .moving = true,
                                   .orientation = true};

// The gains are the best of results/gain_sweep (tools/sweep_gains.py).
constexpr AvoidanceSettings kMaciejewskiKlein{.law = AvoidanceLaw::kMaciejewskiKlein,
                                              .influence = 0.031,
                                              .full_distance = 0.015,
                                              .escape_velocity = 0.5,
                                              .regularization = 1.6e-6,
                                              .exempt_length = 0.066,
                                              .obstacle_velocity = true,
                                              .step_limit = StepLimit::kScale};
constexpr AvoidanceSettings kGradientProjection{.law = AvoidanceLaw::kGradientProjection,
                                                .influence = 0.041,
                                                .gradient_gain = 970,
                                                .exempt_length = 0.078,
                                                .obstacle_velocity = true,
                                                .step_limit = StepLimit::kScale};

std::vector<ParameterDeclaration> fcl_parameters() {
  return {
      choice_parameter("solver", {"indep_mm", "libccd_mm", "libccd_m"},
                       "FCL at its best in millimetres, or as shipped in millimetres or metres"),
      choice_parameter("broadphase", {"off", "on"},
                       "FCL's tree over the obstacles, pruned at the sphere of influence")};
}

std::unique_ptr<ClosestPointSearch> fcl_search(const ParameterValues& values) {
  const std::string& name = values.choice("solver");
  const FclSolver solver = name == "indep_mm"    ? FclSolver::kIndepMillimetres
                           : name == "libccd_mm" ? FclSolver::kLibccdMillimetres
                                                 : FclSolver::kLibccdMetres;
  return std::make_unique<FclDistanceSearch>(solver, values.choice("broadphase") == "on");
}

std::unique_ptr<ClosestPointSearch> chosen_search(const ParameterValues& values) {
  const std::string& closest = values.choice("closest");
  const TestPointCounts counts{.link = values.integer("n"), .obstacle = values.integer("m")};
  if (closest == "exact") return std::make_unique<ExactDistanceSearch>();
  if (closest == "test_points") return std::make_unique<TestPointSearch>(counts);
  if (closest == "fcl") return fcl_search(values);
  return std::make_unique<VectorizedTestPointSearch>(counts);
}

/// Settings common to both: what the law and its parameters do not say.
AvoidanceSettings read(const ParameterValues& values, AvoidanceSettings settings) {
  settings.all_pairs = read_all_pairs(values);
  settings.step_limit = read_step_limit(values);
  return read_avoidance(values, settings);
}

void append(std::vector<ParameterDeclaration> more, std::vector<ParameterDeclaration>& declared) {
  declared.insert(declared.end(), more.begin(), more.end());
}

std::vector<ParameterDeclaration> common_parameters(const AvoidanceSettings& defaults) {
  std::vector<ParameterDeclaration> declared = avoidance_parameters(defaults, {defaults.law});
  declared.push_back(acting_points_parameter(defaults.all_pairs));
  declared.push_back(step_limit_parameter());
  return declared;
}

}  // namespace

MethodEntry maciejewski_klein_method() {
  std::vector<ParameterDeclaration> declared = {
      choice_parameter("closest", {"exact", "test_points", "test_points_vectorized", "fcl"},
                       "how the closest points are found")};
  append(common_parameters(kMaciejewskiKlein), declared);
  append({integer_parameter("n", "-", 25, 2, 10000, "test points a link, N"),
          integer_parameter("m", "-", 240, 3, 100000, "test points an obstacle, M")},
         declared);
  append(fcl_parameters(), declared);
  return {.name = "maciejewski_klein",
          .summary = "null-space escape velocity at the closest points, exact or otherwise",
          .source =
              "Maciejewski and Klein: Obstacle Avoidance for Kinematically Redundant "
              "Manipulators in Dynamically Varying Environments, Int. J. of Robotics Research "
              "4(3), 1985",
          .capabilities = kEverything,
          .parameters = declared,
          .make = [](const ParameterValues& values) -> std::unique_ptr<Method> {
            return std::make_unique<NullSpaceAvoidance>(read(values, kMaciejewskiKlein),
                                                        chosen_search(values));
          }};
}

MethodEntry fcl_gp_method() {
  std::vector<ParameterDeclaration> declared = common_parameters(kGradientProjection);
  append(fcl_parameters(), declared);
  return {.name = "fcl_gp",
          .summary = "FCL's closest points and gradient projection",
          .source =
              "Pan, Chitta, Manocha: FCL, A General Purpose Library for Collision and Proximity "
              "Queries, ICRA 2012; gradient projection: Liegeois 1977",
          .capabilities = kEverything,
          .parameters = declared,
          .make = [](const ParameterValues& values) -> std::unique_ptr<Method> {
            return std::make_unique<NullSpaceAvoidance>(read(values, kGradientProjection),
                                                        fcl_search(values));
          }};
}

}  // namespace bqsa::baselines
