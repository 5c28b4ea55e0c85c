#include "mixes/bqsa_escape.hpp"

#include <algorithm>

#include "baselines/closest/arm_surroundings.hpp"
#include "baselines/closest/exact_distance_search.hpp"
#include "baselines/limited_step.hpp"
#include "baselines/null_space_avoidance.hpp"
#include "baselines/self_motions.hpp"
#include "bqsa/exact_search.hpp"

namespace bqsa::mixes {
namespace {

using baselines::ArmSurroundings;
using baselines::AvoidanceLaw;
using baselines::AvoidanceSettings;
using baselines::Escape;

// The gains are the best of results/gain_sweep (tools/sweep_gains.py).
constexpr AvoidanceSettings kDefaults{.law = AvoidanceLaw::kMaciejewskiKlein,
                                      .influence = 0.14,
                                      .full_distance = 0.017,
                                      .escape_velocity = 0.022,
                                      .regularization = 3.6e-3,
                                      .exempt_length = 0.033,
                                      .all_pairs = true,
                                      .obstacle_velocity = true};

class BqsaEscape final : public ReactiveMethod {
 public:
  explicit BqsaEscape(const AvoidanceSettings& settings)
      : settings_(settings), surroundings_(std::make_unique<baselines::ExactDistanceSearch>()) {}

  void prepare(const Problem& problem) override {
    problem_ = &problem;
    counters_ = {};
    escape_counters_ = {};
    upright_ = JointVector::Zero(problem.chain.joints());
    surroundings_.assign(problem,
                         {.influence = settings_.influence,
                          .exempt_length = settings_.exempt_length,
                          .all_pairs = settings_.all_pairs,
                          .obstacle_velocity = settings_.obstacle_velocity},
                         escape_counters_);
    search_ = make_exact_search(problem, {});
    search_->prepare(problem);
  }

  void step(const StepInput& input, StepOutput& output) override {
    surroundings_.look(input.tick, input.q);
    search_->lean(surroundings_.escapes().empty() ? upright_ : escape_velocity(input));
    search_->step(input, output);
    counters_ = search_->counters() + escape_counters_;
  }

 private:
  /// As much of the law's self-motion as the joints' limits leave room for.
  JointVector escape_velocity(const StepInput& input) {
    const JointVector& tracking = surroundings_.track(input);
    self_motions_.assign(surroundings_.task_jacobian());
    JointVector velocity = upright_;
    for (const Escape& escape : surroundings_.escapes()) {
      velocity +=
          self_motion_away(escape.clearance, settings_.escape_velocity + escape.approach, escape.j0,
                           self_motions_.project(escape.j0), tracking, settings_);
    }
    const double part = baselines::fitting_part(*problem_, input.q, problem_->dt * tracking,
                                                problem_->dt * velocity);
    return std::max(part, 0.0) * velocity;
  }

  AvoidanceSettings settings_;
  ArmSurroundings surroundings_;
  std::unique_ptr<BackwardSearch> search_;
  const Problem* problem_ = nullptr;
  WorkCounters escape_counters_;
  JointVector upright_;  ///< no leaning [rad/s]
  baselines::SelfMotions self_motions_;
};

}  // namespace

MethodEntry bqsa_escape_method() {
  std::vector<ParameterDeclaration> declared =
      baselines::avoidance_parameters(kDefaults, {kDefaults.law});
  declared.push_back(baselines::acting_points_parameter(kDefaults.all_pairs));
  return {.name = "bqsa_escape",
          .summary = "mix: BQSA leaning along Maciejewski and Klein's escape velocities",
          .source = "this project; built on the methods of the entries bqsa and maciejewski_klein",
          .capabilities = {.planar = true,
                           .spatial = true,
                           .link_radius = true,
                           .margin = true,
                           .moving = true,
                           .orientation = true},
          .parameters = declared,
          .make = [](const ParameterValues& values) -> std::unique_ptr<Method> {
            AvoidanceSettings settings = baselines::read_avoidance(values, kDefaults);
            settings.all_pairs = baselines::read_all_pairs(values);
            return std::make_unique<BqsaEscape>(settings);
          }};
}

}  // namespace bqsa::mixes
