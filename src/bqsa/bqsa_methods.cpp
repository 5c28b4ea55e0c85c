#include "bqsa/bqsa_methods.hpp"

#include "bqsa/bqsa_planar.hpp"
#include "bqsa/bqsa_spatial.hpp"

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
    if (problem.dimension() == 2) {
      variant_ = std::make_unique<BqsaPlanar>(PlanarVariant::kExact, settings_);
    } else {
      variant_ = std::make_unique<BqsaSpatial>(settings_);
    }
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

}  // namespace

MethodEntry bqsa_method() {
  return {.name = "bqsa",
          .summary = "backward quadratic search, exact variant, planar or 3-D by the problem",
          .source = kSource,
          .capabilities = {.planar = true, .spatial = true, .link_radius = true, .margin = true},
          .parameters = bqsa_parameters({}),
          .make = [](const ParameterValues& values) {
            return std::make_unique<Bqsa>(bqsa_settings(values));
          }};
}

MethodEntry bqsa_paper_method() {
  BqsaSettings as_the_paper;
  as_the_paper.settling = 0;
  return {.name = "bqsa_paper",
          .summary = "backward quadratic search as the paper steps, planar",
          .source = kSource,
          .capabilities = {.planar = true, .link_radius = true, .margin = true},
          .parameters = bqsa_parameters(as_the_paper),
          .make = [](const ParameterValues& values) {
            return std::make_unique<BqsaPlanar>(PlanarVariant::kPaper, bqsa_settings(values));
          }};
}

}  // namespace bqsa
