#include "bqsa/bqsa_methods.hpp"

#include "bqsa/bqsa_lookahead.hpp"
#include "bqsa/bqsa_planar.hpp"
#include "bqsa/bqsa_projection.hpp"
#include "bqsa/exact_search.hpp"

namespace bqsa {
namespace {

const char* const kSource =
    "Hu, Wang, Li and Qian: Obstacle Avoidance for Redundant Manipulators Utilizing a Backward "
    "Quadratic Search Algorithm, Int. J. of Advanced Robotic Systems, 2016, doi 10.5772/63934";

/// Chooses between the planar and the spatial variant when it sees the problem.
class Bqsa final : public ReactiveMethod {
 public:
  explicit Bqsa(const BqsaSettings& settings) : settings_(settings) {}

  void prepare(const Problem& problem) override {
    variant_ = make_exact_search(problem, settings_);
    variant_->prepare(problem);
    counters_ = {};
  }

  void step(const StepInput& input, StepOutput& output) override {
    variant_->step(input, output);
    counters_ = variant_->counters();
  }

 private:
  BqsaSettings settings_;
  std::unique_ptr<ReactiveMethod> variant_;
};

/// What the exact variants declare: the corrections besides what all variants do.
std::vector<ParameterDeclaration> exact_parameters() {
  const BqsaSettings defaults;
  std::vector<ParameterDeclaration> parameters = bqsa_parameters(defaults);
  parameters.push_back(
      integer_parameter("corrections", "-", defaults.corrections, 1, 100,
                        "Newton corrections of the predictor's tip error, at most"));
  parameters.push_back({"tip_tolerance", "m", defaults.tip_tolerance, 1e-12, 1e-2,
                        "tip error at which the corrections stop"});
  return parameters;
}

BqsaSettings exact_settings(const ParameterValues& values) {
  BqsaSettings settings;
  read_bqsa_parameters(values, settings);
  settings.corrections = values.integer("corrections");
  settings.tip_tolerance = values.number("tip_tolerance");
  return settings;
}

/// Exact variants that can free all links at once declare when they do; the first name is the
/// default.
std::vector<ParameterDeclaration> releasing_parameters(std::vector<std::string> releases) {
  std::vector<ParameterDeclaration> parameters = exact_parameters();
  parameters.push_back(choice_parameter(
      "release", std::move(releases),
      "all links are freed at once: where one after the other fails, always first, or never"));
  parameters.push_back({"contact_band", "m", BqsaSettings{}.contact_band, 0, 10,
                        "links this close to hitting take part when all are freed at once"});
  return parameters;
}

BqsaSettings releasing_settings(const ParameterValues& values) {
  BqsaSettings settings = exact_settings(values);
  const std::string& release = values.choice("release");
  settings.release = release == "first"   ? Release::kFirst
                     : release == "never" ? Release::kNever
                                          : Release::kLast;
  settings.contact_band = values.number("contact_band");
  return settings;
}

std::unique_ptr<Method> make_exact(const ParameterValues& values) {
  return std::make_unique<Bqsa>(releasing_settings(values));
}

/// `bqsa_lookahead` declares how far and how much it looks besides what `bqsa` does.
std::vector<ParameterDeclaration> lookahead_parameters() {
  const LookaheadSettings defaults;
  std::vector<ParameterDeclaration> parameters = releasing_parameters({"first", "last", "never"});
  parameters.push_back(integer_parameter("horizon", "-", defaults.horizon, 1, 100000,
                                         "ticks that are imagined ahead"));
  parameters.push_back(integer_parameter("branches", "-", defaults.branches, 0, 1000000,
                                         "ways around one dead end that are tried, at most"));
  parameters.push_back({"lean_turn", "rad", defaults.lean_turn, 1e-3, 3.15,
                        "turn of the fastest joint that leaning one way comes to"});
  return parameters;
}

std::unique_ptr<Method> make_lookahead(const ParameterValues& values) {
  LookaheadSettings settings;
  settings.bqsa = releasing_settings(values);
  settings.horizon = values.integer("horizon");
  settings.branches = values.integer("branches");
  settings.lean_turn = values.number("lean_turn");
  return std::make_unique<BqsaLookahead>(settings);
}

/// `bqsa_projection` declares the plane besides what `bqsa` does.
std::vector<ParameterDeclaration> projection_parameters() {
  std::vector<ParameterDeclaration> parameters = exact_parameters();
  parameters.push_back(
      choice_parameter("plane", {"auto", "xy", "yz", "zx"},
                       "coordinate plane in which links are turned; auto: the first with an exit"));
  return parameters;
}

std::unique_ptr<Method> make_projection(const ParameterValues& values) {
  const std::string& name = values.choice("plane");
  std::optional<CoordinatePlane> plane;
  if (name == "xy") plane = CoordinatePlane::kXy;
  if (name == "yz") plane = CoordinatePlane::kYz;
  if (name == "zx") plane = CoordinatePlane::kZx;
  return std::make_unique<BqsaProjection>(plane, exact_settings(values));
}

/// `bqsa_paper` declares the weight of clamped joints besides what all variants do.
std::vector<ParameterDeclaration> paper_parameters() {
  const BqsaSettings defaults = default_settings(PlanarVariant::kPaper);
  std::vector<ParameterDeclaration> parameters = bqsa_parameters(defaults);
  parameters.push_back({"clamped_weight", "-", defaults.clamped_weight, 1, 1e12,
                        "weight of the joints that must not move"});
  return parameters;
}

std::unique_ptr<Method> make_paper(const ParameterValues& values) {
  BqsaSettings settings = default_settings(PlanarVariant::kPaper);
  read_bqsa_parameters(values, settings);
  settings.clamped_weight = values.number("clamped_weight");
  return std::make_unique<BqsaPlanar>(PlanarVariant::kPaper, settings);
}

}  // namespace

MethodEntry bqsa_method() {
  return {.name = "bqsa",
          .summary = "backward quadratic search, exact variant, planar or 3-D by the problem",
          .source = kSource,
          .capabilities = {.planar = true,
                           .spatial = true,
                           .link_radius = true,
                           .margin = true,
                           .moving = true,
                           .orientation = true},
          .parameters = releasing_parameters({"last", "first", "never"}),
          .make = make_exact};
}

MethodEntry bqsa_lookahead_method() {
  return {.name = "bqsa_lookahead",
          .summary = "backward quadratic search that looks ahead along the path, beyond the paper",
          .source = "this project; built on the method of the entry bqsa",
          .capabilities = {.planar = true,
                           .spatial = true,
                           .link_radius = true,
                           .margin = true,
                           .moving = true,
                           .orientation = true},
          .parameters = lookahead_parameters(),
          .make = make_lookahead};
}

MethodEntry bqsa_paper_method() {
  return {.name = "bqsa_paper",
          .summary = "backward quadratic search as the paper steps, planar",
          .source = kSource,
          .capabilities = {.planar = true, .link_radius = true, .margin = true, .moving = true},
          .parameters = paper_parameters(),
          .make = make_paper};
}

MethodEntry bqsa_projection_method() {
  return {.name = "bqsa_projection",
          .summary = "backward quadratic search in space by projections, as the paper does",
          .source = kSource,
          .capabilities = {.spatial = true,
                           .link_radius = true,
                           .margin = true,
                           .moving = true,
                           .orientation = true},
          .parameters = projection_parameters(),
          .make = make_projection};
}

}  // namespace bqsa
