#include "bqsa/bqsa_lookahead.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "bqsa/bqsa_planar.hpp"
#include "bqsa/bqsa_spatial.hpp"

namespace bqsa {
namespace {

constexpr double kUnhurriedStep = 1.0;  // largest joint step without hurry [rad]
constexpr double kSamePlace = 1e-9;     // joint angles this close are where the plan says [rad]
constexpr int kFirstLead = 4;           // ticks before a dead end at which a branch starts
constexpr int kPastDeadEnd = 5;         // ticks by which a branch must pass it
constexpr int kMaxBranchings = 16;      // dead ends that one tick may get past

std::unique_ptr<BackwardSearch> make_search(const Problem& problem, const BqsaSettings& settings) {
  if (problem.dimension() == 2) {
    return std::make_unique<BqsaPlanar>(PlanarVariant::kExact, settings);
  }
  return std::make_unique<BqsaSpatial>(settings);
}

/// Unit vectors across a link: two in the plane, four in space.
std::vector<Eigen::Vector3d> directions_across(const Eigen::Vector3d& along, int dimension) {
  if (dimension == 2) {
    const Eigen::Vector3d left = Eigen::Vector3d(-along.y(), along.x(), 0).normalized();
    return {left, -left};
  }
  const Eigen::Vector3d a = along.unitOrthogonal();
  const Eigen::Vector3d b = along.cross(a).normalized();
  return {a, -a, b, -b};
}

}  // namespace

BqsaLookahead::BqsaLookahead(const LookaheadSettings& settings) : settings_(settings) {}

void BqsaLookahead::prepare(const Problem& problem) {
  problem_ = &problem;
  counters_ = {};
  unhurried_ = problem;
  unhurried_->limits.max_velocity =
      JointVector::Constant(problem.chain.joints(), kUnhurriedStep / problem.dt);
  search_ = make_search(problem, settings_.bqsa);
  search_->prepare(problem);
  unhurried_search_ = make_search(problem, settings_.bqsa);
  unhurried_search_->prepare(*unhurried_);
  certificate_.assign(problem, problem.link_radius + problem.margin, counters_);
  plan_.clear();
  first_tick_ = 0;
  hopeless_ = 0;
}

void BqsaLookahead::step(const StepInput& input, StepOutput& output) {
  const bool as_planned = !plan_.empty() && first_tick_ == input.tick - 1 &&
                          (plan_[0].q - input.q).cwiseAbs().maxCoeff() <= kSamePlace;
  if (!as_planned) {
    plan_.assign(1, {});
    plan_[0].q = input.q;
    first_tick_ = input.tick - 1;
    hopeless_ = 0;
  }
  const int last = std::min(first_tick_ + settings_.horizon, problem_->ticks);
  for (int branchings = 0; !imagine(plan_, last); ++branchings) {  // 1
    const int dead_tick = last_tick(plan_) + 1;
    if (dead_tick == hopeless_) break;
    if (spread()) continue;                                     // 2
    if (branchings < kMaxBranchings && branch(last)) continue;  // 3
    hopeless_ = dead_tick;
    break;
  }
  if (plan_.size() == 1) {
    hold(input.q, dead_end_.reason, dead_end_.link, dead_end_.obstacle, output);
  } else {
    plan_.erase(plan_.begin());
    ++first_tick_;
    output = plan_.front();
  }
}

/// The input of the tick after the plan's last.
StepInput BqsaLookahead::input_after(const Plan& plan) const {
  const int tick = last_tick(plan) + 1;
  const double t = problem_->time(tick);
  return {.tick = tick, .t = t, .p_WT_desired = problem_->desired_tip(t), .q = plan.back().q};
}

/// Adds ticks to the plan up to `last`. False at a dead end.
bool BqsaLookahead::imagine(Plan& plan, int last) {
  StepOutput output;
  while (last_tick(plan) < last) {
    search_->step(input_after(plan), output);
    if (output.state == TickState::kInfeasible) {
      dead_end_ = output;
      return false;
    }
    plan.push_back(output);
  }
  return true;
}

/// Gets the next tick into the plan by starting its self-motion earlier.
bool BqsaLookahead::spread() {
  StepOutput reached;
  unhurried_search_->step(input_after(plan_), reached);
  if (reached.state == TickState::kInfeasible) return false;
  std::vector<JointVector> pulled = {reached.q};  // from the last tick back
  for (std::size_t row = plan_.size() - 1;; --row) {
    const JointVector& q_next = pulled.back();
    const int tick = first_tick_ + static_cast<int>(row);
    JointVector q = plan_[row].q;
    const bool met = forbidden_step(*problem_, q, q_next) == Infeasible::kNot &&
                     certificate_.certify(tick + 1, q, q_next).certified;
    if (met) break;
    if (row == 0 || !pull(tick, q_next, q)) return false;
    pulled.push_back(q);
  }
  const std::size_t first = plan_.size() + 1 - pulled.size();
  plan_.push_back(reached);
  for (std::size_t k = 0; k + 1 < pulled.size(); ++k) {
    plan_[first + k].q = pulled[pulled.size() - 1 - k];
    plan_[first + k].state = TickState::kClamped;
  }
  return true;
}

/// Moves q at `tick` to where q_next at the tick after is within reach.
bool BqsaLookahead::pull(int tick, const JointVector& q_next, JointVector& q) {
  const JointBox box = reachable_box(*problem_, q_next);
  const Eigen::Vector3d p_WT = problem_->desired_tip(problem_->time(tick));
  const JointVector q_before = q;
  double distance = settings_.bqsa.safety_offset;
  for (int attempt = 0; attempt <= settings_.bqsa.retries; ++attempt, distance *= 2) {
    q = q_before;
    if (!search_->fit(tick, p_WT, distance, box, q)) return false;
    if (certificate_.certify(tick + 1, q, q_next).certified) return true;
  }
  return false;
}

/// Leaves the plan for one that passes the dead end at its end.
bool BqsaLookahead::branch(int last) {
  const std::span<const Link> links = problem_->chain.links();
  std::vector<const Link*> order;
  for (const Link& link : links) order.push_back(&link);
  std::stable_sort(order.begin(), order.end(), [this](const Link* a, const Link* b) {
    return std::abs(a->number - dead_end_.link) < std::abs(b->number - dead_end_.link);
  });
  ChainPose pose;
  int tried = 0;
  for (std::size_t lead = kFirstLead;; lead *= 2) {
    const std::size_t row = plan_.size() - 1 - std::min(lead, plan_.size() - 1);
    problem_->chain.forward(plan_[row].q, pose);
    for (const Link* link : order) {
      const Eigen::Vector3d along = pose.p_WO.col(link->end) - pose.p_WO.col(link->start);
      for (const Eigen::Vector3d& across : directions_across(along, problem_->dimension())) {
        if (tried++ == settings_.branches) return false;
        if (lean(row, *link, across, last)) return true;
      }
    }
    if (row == 0) return false;
  }
}

/// From a row of the plan to the dead end, the middle of the link leans towards `direction`.
bool BqsaLookahead::lean(std::size_t row, const Link& link, const Eigen::Vector3d& direction,
                         int last) {
  const SerialChain& chain = problem_->chain;
  ChainPose pose;
  TaskJacobian J_start, J_end;
  chain.forward(plan_[row].q, pose);
  chain.jacobian(pose, link.start, J_start);
  chain.jacobian(pose, link.end, J_end);
  const TaskVector d = direction.head(chain.dimension());
  JointVector phi = (J_start + J_end).transpose() * d;
  const double ticks = static_cast<double>(plan_.size() - row);
  phi *= settings_.lean_turn / (ticks * problem_->dt * phi.cwiseAbs().maxCoeff());
  if (!phi.allFinite()) return false;

  const int dead_tick = last_tick(plan_) + 1;
  const JointVector upright = JointVector::Zero(chain.joints());
  const StepOutput dead_end = dead_end_;
  Plan plan(plan_.begin(), plan_.begin() + static_cast<std::ptrdiff_t>(row) + 1);
  StepOutput output;
  while (last_tick(plan) < dead_tick) {
    const StepInput input = input_after(plan);
    search_->lean(phi);
    search_->step(input, output);
    search_->lean(upright);
    if (output.state == TickState::kInfeasible) search_->step(input, output);
    if (output.state == TickState::kInfeasible) break;
    plan.push_back(output);
  }
  const bool passed =
      last_tick(plan) == dead_tick && imagine(plan, std::min(last, dead_tick + kPastDeadEnd));
  if (passed) {
    plan_ = std::move(plan);
  } else {
    dead_end_ = dead_end;
  }
  return passed;
}

}  // namespace bqsa
