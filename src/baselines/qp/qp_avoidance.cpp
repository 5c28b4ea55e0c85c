#include "baselines/qp/qp_avoidance.hpp"

#include <algorithm>
#include <cmath>

namespace bqsa::baselines {
namespace {

std::pair<int, int> pair_of(const Escape& escape) { return {escape.link, escape.obstacle}; }

}  // namespace

void QpAvoidance::prepare(const Problem& problem) {
  problem_ = &problem;
  counters_ = {};
  network_state_.resize(0);
  network_pairs_.clear();
  network_pairs_.reserve(kMaxEscapeRows);
  surroundings_.assign(problem,
                       {.influence = settings_.influence,
                        .exempt_length = settings_.exempt_length,
                        .all_pairs = settings_.all_pairs,
                        .obstacle_velocity = true},
                       counters_);
}

void QpAvoidance::step(const StepInput& input, StepOutput& output) {
  output = {};
  surroundings_.look(input.tick, input.q);
  tracking_ = surroundings_.track(input);
  if (!rows_.assign(*problem_, input.q, tracking_, surroundings_.task_jacobian(),
                    surroundings_.escapes())) {
    return hold(input.q, Infeasible::kJointLimit, 0, -1, output);
  }
  switch (solve()) {
    case QpStatus::kSolved:
      return make_step(input, output);
    case QpStatus::kIterationLimit:
      return hold(input.q, Infeasible::kDiverged, 0, -1, output);
    case QpStatus::kInfeasible: {
      const Infeasible broken =
          forbidden_step(*problem_, input.q, input.q + problem_->dt * tracking_);
      return hold(input.q, broken == Infeasible::kNot ? Infeasible::kStepTooLarge : broken, 0, -1,
                  output);
    }
  }
}

/// q_dot_, and the multipliers of the escape rows at the end of solution_.u.
QpStatus QpAvoidance::solve() {
  const bool compact = settings_.solver == QpSolver::kCompact;
  if (compact) {
    compact_.assign(rows_.program(), static_cast<int>(surroundings_.task_jacobian().rows()),
                    tracking_);
    ++counters_.linear_solves;
  }
  const QuadraticProgram& hard = compact ? compact_.reduced() : rows_.program();
  QpStatus status = solve(hard);
  if (status == QpStatus::kInfeasible && rows_.escape_count() > 0) {
    softened_ = hard;
    rows_.soften(softened_);
    status = solve(softened_);
  }
  if (settings_.solver == QpSolver::kDualNetwork) {
    if (status == QpStatus::kIterationLimit) status = QpStatus::kSolved;
    if (status == QpStatus::kSolved) keep_network();
  }
  q_dot_ = compact ? compact_.expand(solution_.x) : solution_.x.head(problem_->chain.joints());
  return status;
}

QpStatus QpAvoidance::solve(const QuadraticProgram& program) {
  if (settings_.solver == QpSolver::kDualNetwork) {
    start_network(program);
    network_.solve(program, solution_);
  } else {
    active_set_.solve(program, solution_);
  }
  counters_.iterations += static_cast<std::uint64_t>(solution_.iterations);
  return solution_.status;
}

/// From its state at the end of the last tick, but for neurons of escape rows that were not the same.
void QpAvoidance::start_network(const QuadraticProgram& program) {
  const int escapes = rows_.escape_count(), others = program.rows() - escapes;
  solution_.u.setZero(program.rows());
  if (network_state_.size() == 0) return;
  solution_.u.head(others) = network_state_.head(others);
  for (int k = 0; k < escapes; ++k) {
    const auto same = std::ranges::find(network_pairs_, pair_of(rows_.escape(k)));
    if (same == network_pairs_.end()) continue;
    solution_.u(others + k) = network_state_(others + (same - network_pairs_.begin()));
  }
}

void QpAvoidance::keep_network() {
  network_state_ = solution_.u;
  network_pairs_.clear();
  for (int k = 0; k < rows_.escape_count(); ++k) {
    network_pairs_.push_back(pair_of(rows_.escape(k)));
  }
}

/// Limits are kept to the last digit, which neither solver does.
void QpAvoidance::make_step(const StepInput& input, StepOutput& output) const {
  constexpr double kInside = 1 - 1e-9;
  const JointLimits& limits = problem_->limits;
  JointVector q = input.q;
  for (int j = 0; j < q.size(); ++j) {
    const double most = kInside * problem_->max_step(j);
    q(j) += std::clamp(problem_->dt * q_dot_(j), -most, most);
    if (limits.lower.size() > 0) q(j) = std::max(q(j), limits.lower(j));
    if (limits.upper.size() > 0) q(j) = std::min(q(j), limits.upper(j));
  }
  const Infeasible forbidden = forbidden_step(*problem_, input.q, q);
  if (forbidden != Infeasible::kNot) return hold(input.q, forbidden, 0, -1, output);
  output.q = q;
  output.state = TickState::kUnclaimed;
  constexpr double kActing = 1e-6;  // beyond what is left of a network's idle neurons
  const auto first_row = solution_.u.size() - rows_.escape_count();
  for (int k = 0; k < rows_.escape_count(); ++k) {
    if (std::abs(solution_.u(first_row + k)) <= kActing) continue;
    surroundings_.record(rows_.escape(k), output);
  }
}

}  // namespace bqsa::baselines
