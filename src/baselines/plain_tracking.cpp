#include "baselines/plain_tracking.hpp"

#include "bqsa/hybrid_ik.hpp"
#include "bqsa/tip_task.hpp"

namespace bqsa::baselines {
namespace {

class PlainTracking final : public ReactiveMethod {
 public:
  void prepare(const Problem& problem) override {
    problem_ = &problem;
    task_ = TipTask(problem);
    counters_ = {};
    no_weights_ = JointVector::Ones(problem.chain.joints());
    no_clamping_ = JointVector::Zero(problem.chain.joints());
  }

  void step(const StepInput& input, StepOutput& output) override {
    task_.turn_to(input.R_WT_desired);
    problem_->chain.forward(input.q, pose_);
    task_.jacobian(pose_, J_);
    const TaskVector x_dot = task_.error(pose_, input.p_WT_desired) / problem_->dt;
    solve_hybrid_ik(J_, x_dot, no_weights_, no_clamping_, {}, ik_);
    output.q = input.q + problem_->dt * ik_.q_dot;
    output.state = TickState::kUnclaimed;
    ++counters_.kinematics;
    ++counters_.jacobians;
    ++counters_.linear_solves;
  }

 private:
  const Problem* problem_ = nullptr;
  TipTask task_;
  JointVector no_weights_;
  JointVector no_clamping_;
  ChainPose pose_;
  TaskJacobian J_;
  HybridIkResult ik_;
};

}  // namespace

MethodEntry plain_tracking_method() {
  return {.name = "none",
          .summary = "closed-loop tracking without avoidance",
          .source = "hybrid inverse kinematics of the paper (section 2.2) with W = I, phi = 0",
          .capabilities = {.planar = true,
                           .spatial = true,
                           .link_radius = true,
                           .margin = true,
                           .moving = true,
                           .orientation = true,
                           .keeps_limits = false},
          .parameters = {},
          .make = [](const ParameterValues&) { return std::make_unique<PlainTracking>(); }};
}

}  // namespace bqsa::baselines
