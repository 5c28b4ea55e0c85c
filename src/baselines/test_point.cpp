#include "baselines/test_point.hpp"

#include "baselines/closest/test_point_search.hpp"
#include "baselines/null_space_avoidance.hpp"

namespace bqsa::baselines {
namespace {

// Of the two settings that solve most in results/gain_sweep (tools/sweep_gains.py) with the law of
// Maciejewski and Klein, the one whose influence suits gradient projection too.
constexpr AvoidanceSettings kDefaults{.influence = 0.034,
                                      .full_distance = 0.0044,
                                      .escape_velocity = 0.21,
                                      .regularization = 3e-6,
                                      .gradient_gain = 600,
                                      .exempt_length = 0.063};

std::vector<ParameterDeclaration> parameters() {
  std::vector<ParameterDeclaration> declared = {
      integer_parameter("n", "-", 25, 2, 10000, "test points a link, N"),
      integer_parameter("m", "-", 240, 3, 100000, "test points an obstacle, M"),
      choice_parameter("law", {"maciejewski_klein", "gradient_projection"},
                       "what is done with the closest point"),
  };
  const auto of_laws = avoidance_parameters(
      kDefaults, {AvoidanceLaw::kMaciejewskiKlein, AvoidanceLaw::kGradientProjection});
  declared.insert(declared.end(), of_laws.begin(), of_laws.end());
  return declared;
}

std::unique_ptr<Method> make(const ParameterValues& values) {
  const AvoidanceLaw law = values.choice("law") == "maciejewski_klein"
                               ? AvoidanceLaw::kMaciejewskiKlein
                               : AvoidanceLaw::kGradientProjection;
  const TestPointCounts counts{.link = values.integer("n"), .obstacle = values.integer("m")};
  AvoidanceSettings settings = kDefaults;
  settings.law = law;
  return std::make_unique<NullSpaceAvoidance>(read_avoidance(values, settings),
                                              std::make_unique<TestPointSearch>(counts));
}

}  // namespace

MethodEntry test_point_method() {
  return {.name = "test_point",
          .summary = "closest pair of N x M test points, Maciejewski-Klein or gradient projection",
          .source =
              "Maciejewski and Klein: Obstacle Avoidance for Kinematically Redundant "
              "Manipulators in Dynamically Varying Environments, Int. J. of Robotics Research "
              "4(3), 1985",
          .capabilities = {.planar = true, .spatial = true, .moving = true},
          .parameters = parameters(),
          .make = make};
}

}  // namespace bqsa::baselines
