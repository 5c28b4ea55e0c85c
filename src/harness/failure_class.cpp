#include "harness/failure_class.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "bqsa/exact_search.hpp"
#include "bqsa/joint_box.hpp"
#include "bqsa/obstacle_field.hpp"
#include "bqsa/tip_closure.hpp"
#include "harness/generator/random_stream.hpp"

namespace bqsa::harness {
namespace {

constexpr double kFullReach = 1;      ///< below it the singular threshold shrinks with the arm [m]
constexpr double kUnhurriedStep = 1;  ///< of a joint in one tick [rad, m]
constexpr int kPostures = 2000;
constexpr std::uint64_t kSeed = 2016;

constexpr double kUniform = std::numeric_limits<double>::infinity();
constexpr std::array kPerturbations{0.1, 0.3, 1.0, kUniform};  ///< of a joint [rad, m]

bool next_to_singular(const Problem& problem, const JointVector& q) {
  const SerialChain& chain = problem.chain;
  const int tip = chain.points() - 1;
  ChainPose pose;
  TaskJacobian J;
  chain.forward(q, pose);
  TipTask(problem).jacobian(pose, J);
  const double smallest = Eigen::JacobiSVD<TaskJacobian>(J).singularValues().minCoeff();
  const double scale = std::min(chain.reach(0, tip) / kFullReach, 1.0);
  return !(smallest >= scale * BqsaSettings{}.ik.singular_threshold);
}

StepInput input_of(const Problem& problem, int tick, const JointVector& q) {
  const double t = problem.time(tick);
  return {.tick = tick,
          .t = t,
          .p_WT_desired = problem.desired_tip(t),
          .R_WT_desired = problem.rotation_at(t),
          .q = q};
}

bool way_exists(const Problem& problem, const StepInput& input) {
  BqsaSettings settings;
  settings.release = Release::kFirst;
  const std::unique_ptr<BackwardSearch> search = make_exact_search(problem, settings);
  try {
    search->prepare(problem);
  } catch (const std::invalid_argument&) {
    return false;  // not an arm for this search
  }
  StepOutput output;
  search->step(input, output);
  return output.state == TickState::kFree || output.state == TickState::kClamped;
}

Problem unhurried(Problem problem) {
  JointVector max_velocity(problem.chain.joints());
  for (int j = 0; j < problem.chain.joints(); ++j) {
    max_velocity(j) = std::max(kUnhurriedStep, problem.max_step(j)) / problem.dt;
  }
  problem.limits.max_velocity = max_velocity;
  return problem;
}

bool limited(const Problem& problem) {
  return problem.limits.lower.size() > 0 && problem.limits.upper.size() > 0;
}

/// Where the joints of a random posture are drawn.
JointBox box_of(const Problem& problem, const JointVector& q, double perturbation) {
  if (!limited(problem)) {
    const double half = std::min(perturbation, std::numbers::pi);
    return {q.array() - half, q.array() + half};
  }
  const JointVector& lower = problem.limits.lower;
  const JointVector& upper = problem.limits.upper;
  JointBox box{(q.array() - perturbation).max(lower.array()).min(upper.array()),
               (q.array() + perturbation).min(upper.array()).max(lower.array())};
  for (Eigen::Index j = 0; j < q.size(); ++j) {  // joints without limits
    if (!std::isfinite(box.lower(j))) box.lower(j) = q(j) - std::numbers::pi;
    if (!std::isfinite(box.upper(j))) box.upper(j) = q(j) + std::numbers::pi;
  }
  return box;
}

/// Largest joint difference to the nearest free one of the random postures; none if none is free.
template <int Dim>
std::optional<double> nearest_free(const Problem& problem, const StepInput& input) {
  WorkCounters uncounted;
  ObstacleField<Dim> obstacles;
  obstacles.assign(problem, uncounted);
  obstacles.go_to(input.tick);
  obstacles.keep(problem.link_radius + problem.margin);

  const SerialChain& chain = problem.chain;
  const auto free = [&](const ChainPose& pose) {
    return std::all_of(chain.links().begin(), chain.links().end(),
                       [&](const Link& link) { return obstacles.first_hit(pose, link) < 0; });
  };
  BqsaSettings settings;
  settings.corrections = 30;
  settings.tip_tolerance = 1e-6;
  TipTask task(problem);
  task.turn_to(input.R_WT_desired);
  RandomStream random{kSeed};
  std::optional<double> nearest;
  ChainPose pose;
  for (int k = 0; k < kPostures; ++k) {
    const JointBox box = box_of(problem, input.q, kPerturbations[k % kPerturbations.size()]);
    JointVector q(chain.joints());
    for (int j = 0; j < chain.joints(); ++j) q(j) = random.uniform(box.lower(j), box.upper(j));
    chain.forward(q, pose);
    const double error =
        close_tip(task, input.p_WT_desired, problem.dt, settings, q, pose, uncounted);
    if (!(error <= TipTask::tolerance(problem)) || !problem.within_limits(q) || !free(pose))
      continue;
    const double difference = (q - input.q).cwiseAbs().maxCoeff();
    if (!nearest || difference < *nearest) nearest = difference;
  }
  return nearest;
}

}  // namespace

Diagnosis diagnose(const Problem& problem, int tick, Infeasible reason, const JointVector& q) {
  if (reason == Infeasible::kDiverged || next_to_singular(problem, q)) {
    return {FailureClass::kSingular};
  }
  const StepInput input = input_of(problem, tick, q);
  if (way_exists(problem, input)) return {FailureClass::kMissed};
  if (way_exists(unhurried(problem), input)) return {FailureClass::kLate};
  const std::optional<double> nearest =
      problem.dimension() == 2 ? nearest_free<2>(problem, input) : nearest_free<3>(problem, input);
  if (!nearest) return {FailureClass::kNoRoom};
  return {FailureClass::kBranch, *nearest};
}

const char* name_of(FailureClass failure) {
  switch (failure) {
    case FailureClass::kSingular:
      return "singular";
    case FailureClass::kMissed:
      return "missed";
    case FailureClass::kLate:
      return "late";
    case FailureClass::kNoRoom:
      return "no_room";
    case FailureClass::kBranch:
      return "branch";
  }
  return "?";
}

}  // namespace bqsa::harness
