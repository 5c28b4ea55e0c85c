#include "bqsa/bqsa_lookahead.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "bqsa/exact_search.hpp"

namespace bqsa {
namespace {

constexpr double kUnhurriedStep = 1.0;  // largest joint step without hurry [rad, m]
constexpr double kAcross = 0.1;         // sine of the angle at which an axis is across a link
constexpr int kFirstLead = 4;           // ticks before a dead end at which a branch starts
constexpr int kPastDeadEnd = 5;         // ticks by which a branch must pass it
constexpr int kMaxBranchings = 16;      // dead ends that one tick may get past

/// Unit vectors across a link: two in the plane, four in space. Those in space are told by the arm's
/// own axes, so that the frame W does not matter.
std::vector<Eigen::Vector3d> directions_across(const SerialChain& chain, const ChainPose& pose,
                                               const Link& link) {
  const Eigen::Vector3d along = pose.p_WO.col(link.end) - pose.p_WO.col(link.start);
  if (chain.dimension() == 2) {
    const Eigen::Vector3d left = Eigen::Vector3d(-along.y(), along.x(), 0).normalized();
    return {left, -left};
  }
  Eigen::Vector3d a = along.unitOrthogonal();  // if no axis is across the link
  for (int j = chain.moving_joints(link.end) - 1; j >= 0; --j) {
    if (chain.is_prismatic(j)) continue;
    const Eigen::Vector3d turning = pose.axis_W.col(j).cross(along);
    if (turning.norm() <= kAcross * along.norm()) continue;
    a = turning.normalized();
    break;
  }
  const Eigen::Vector3d b = along.cross(a).normalized();
  return {a, -a, b, -b};
}

}  // namespace

BqsaLookahead::BqsaLookahead(const LookaheadSettings& settings) : settings_(settings) {}

void BqsaLookahead::prepare(const Problem& problem) {
  if (!problem.desired_tip || problem.ticks < 1) {
    throw std::invalid_argument("looking ahead needs a path");
  }
  problem_ = &problem;
  counters_ = {};
  certificate_counters_ = {};
  unhurried_ = problem;
  unhurried_->limits.max_velocity =
      JointVector::Constant(problem.chain.joints(), kUnhurriedStep / problem.dt);
  search_ = make_exact_search(problem, settings_.bqsa);
  search_->prepare(problem);
  unhurried_search_ = make_exact_search(problem, settings_.bqsa);
  unhurried_search_->prepare(*unhurried_);
  certificate_.assign(problem, certificate_counters_);
  const int horizon = std::min(settings_.horizon, problem.ticks);
  plan_ = Plan(horizon + 1);
  pulled_.reserve(static_cast<std::size_t>(horizon) + 1);
  hopeless_ = 0;
}

void BqsaLookahead::step(const StepInput& input, StepOutput& output) {
  const int now = input.tick - 1;
  if (leads_on(now, input.q)) {
    plan_.at(now).q = input.q;
  } else {
    plan_.restart(now, input.q);
    hopeless_ = 0;
  }
  const int last = std::min(now + settings_.horizon, problem_->ticks);
  int branchings = 0;
  while (plan_.last_tick() + 1 != hopeless_ && !imagine(plan_, last)) {  // 1
    if (spread()) continue;                                              // 2
    if (branchings++ == kMaxBranchings) break;
    if (!branch(last)) hopeless_ = plan_.last_tick() + 1;  // 3
  }
  if (plan_.last_tick() == now) {
    hold(input.q, dead_end_.reason, dead_end_.link, dead_end_.obstacle, output);
  } else {
    plan_.drop_first();
    copy(plan_.at(input.tick), output);
  }
  counters_ = certificate_counters_ + search_->counters() + unhurried_search_->counters();
}

void BqsaLookahead::Plan::restart(int tick, const JointVector& q) {
  first_ = last_ = tick;
  clear(at(tick));
  at(tick).q = q;
}

/// Whether the arm, at q [rad] at tick `now`, can follow the plan.
bool BqsaLookahead::leads_on(int now, const JointVector& q) {
  if (plan_.first_tick() != now || plan_.last_tick() < now) return false;
  if (plan_.at(now).q == q) return true;
  if (plan_.last_tick() == now) return false;
  const JointVector& q_next = plan_.at(now + 1).q;
  return forbidden_step(*problem_, q, q_next) == Infeasible::kNot &&
         certificate_.certify(now + 1, q, q_next).certified;
}

/// The input of the tick after the plan's last.
StepInput BqsaLookahead::input_after(const Plan& plan) const {
  const int tick = plan.last_tick() + 1;
  const double t = problem_->time(tick);
  return {.tick = tick,
          .t = t,
          .p_WT_desired = problem_->desired_tip(t),
          .R_WT_desired = problem_->rotation_at(t),
          .q = plan.at(plan.last_tick()).q};
}

/// Adds ticks to the plan up to `last`. False at a dead end.
bool BqsaLookahead::imagine(Plan& plan, int last) {
  while (plan.last_tick() < last) {
    search_->step(input_after(plan), plan.next());
    if (plan.next().state == TickState::kInfeasible) {
      copy(plan.next(), dead_end_);
      return false;
    }
    plan.take_next();
  }
  return true;
}

/// Gets the next tick into the plan by starting its self-motion earlier.
bool BqsaLookahead::spread() {
  StepOutput reached;
  unhurried_search_->step(input_after(plan_), reached);
  if (reached.state == TickState::kInfeasible) return false;
  pulled_.assign(1, reached.q);
  int met = plan_.last_tick();
  for (;; --met) {
    JointVector q = plan_.at(met).q;
    const JointVector q_next = pulled_.back();
    const bool in_reach = forbidden_step(*problem_, q, q_next) == Infeasible::kNot &&
                          certificate_.certify(met + 1, q, q_next).certified;
    if (in_reach) break;
    if (met == plan_.first_tick() || !pull(met, q_next, q)) return false;
    pulled_.push_back(q);
  }
  for (int tick = met + 1; tick <= plan_.last_tick(); ++tick) {
    plan_.at(tick).q = pulled_[static_cast<std::size_t>(plan_.last_tick() + 1 - tick)];
    plan_.at(tick).state = TickState::kClamped;
  }
  plan_.add(reached);
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
    if (forbidden_step(*problem_, q, q_next) == Infeasible::kNot &&
        certificate_.certify(tick + 1, q, q_next).certified) {
      return true;
    }
  }
  return false;
}

/// Leaves the plan for one that passes the dead end at its end.
bool BqsaLookahead::branch(int last) {
  const std::span<const Link> links = problem_->chain.links();
  std::vector<const Link*> nearest_first;
  for (const Link& link : links) nearest_first.push_back(&link);
  std::stable_sort(
      nearest_first.begin(), nearest_first.end(), [this](const Link* a, const Link* b) {
        return std::abs(a->number - dead_end_.link) < std::abs(b->number - dead_end_.link);
      });
  ChainPose pose;
  int tried = 0;
  for (int lead = kFirstLead;; lead *= 2) {
    const int from = std::max(plan_.first_tick(), plan_.last_tick() - lead);
    problem_->chain.forward(plan_.at(from).q, pose);
    for (const Link* link : nearest_first) {
      for (const Eigen::Vector3d& across : directions_across(problem_->chain, pose, *link)) {
        if (tried++ == settings_.branches) return false;
        if (lean(from, *link, across, last)) return true;
      }
    }
    if (from == plan_.first_tick()) return false;
  }
}

/// From a tick of the plan to the dead end, the middle of the link leans towards `direction`. If
/// that passes the dead end, it is the new plan.
bool BqsaLookahead::lean(int from, const Link& link, const Eigen::Vector3d& direction, int last) {
  const SerialChain& chain = problem_->chain;
  ChainPose pose;
  TaskJacobian J_start, J_end;
  chain.forward(plan_.at(from).q, pose);
  chain.jacobian(pose, link.start, J_start);
  chain.jacobian(pose, link.end, J_end);
  const TaskVector d = direction.head(chain.dimension());
  const JointVector towards = (J_start + J_end).transpose() * d;
  const int dead_tick = plan_.last_tick() + 1;
  const double rate = settings_.lean_turn / ((dead_tick - from) * problem_->dt);  // [rad/s]
  const double largest = towards.cwiseAbs().maxCoeff();
  if (!(largest > 0)) return false;

  const JointVector leaning = rate / largest * towards;
  const JointVector upright = JointVector::Zero(chain.joints());
  const StepOutput dead_end = dead_end_;
  Plan plan = plan_;
  plan.cut_after(from);
  StepOutput output;
  while (plan.last_tick() < dead_tick) {
    const StepInput input = input_after(plan);
    search_->lean(leaning);
    search_->step(input, output);
    search_->lean(upright);
    if (output.state == TickState::kInfeasible) search_->step(input, output);
    if (output.state == TickState::kInfeasible) return false;
    plan.add(output);
  }
  if (!imagine(plan, std::min(last, dead_tick + kPastDeadEnd))) {
    dead_end_ = dead_end;
    return false;
  }
  plan_ = std::move(plan);
  return true;
}

}  // namespace bqsa
