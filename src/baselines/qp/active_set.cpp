#include "baselines/qp/active_set.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Jacobi>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "baselines/qp/triangular.hpp"

namespace bqsa::baselines {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kViolated = 1e-10;
constexpr double kLargest = 1e4;
constexpr double kRounding = 1e-13;

}  // namespace

void ActiveSet::solve(const QuadraticProgram& program, QpSolution& solution) {
  start(program);
  solution.status = run();
  if (solution.status == QpStatus::kSolved) {
    correct();
    solution.status = run();  // what the correction brought to light
    if (solution.status == QpStatus::kSolved) correct();
  }
  solution.x = y_;
  solve_upper(factor_, n_, solution.x);
  solution.u.setZero(m_);
  for (int k = 0; k < count_; ++k) {
    const Active& active = active_[static_cast<std::size_t>(k)];
    solution.u(active.row) = active.side * active.multiplier * scale_(active.row);
  }
  solution.iterations = iterations_;
}

void ActiveSet::start(const QuadraticProgram& program) {
  assert((program.lower.array() <= program.upper.array()).all());
  n_ = program.variables();
  m_ = program.rows();
  count_ = 0;
  iterations_ = 0;
  passed_over_.fill(false);
  as_good_as_kept_.fill(false);

  const Eigen::LLT<QpMatrix> llt(program.G);
  assert(llt.info() == Eigen::Success);
  factor_ = llt.matrixU();
  y_ = -program.c;
  solve_upper_transposed(factor_, n_, y_);
  y_start_ = y_;
  size_ = y_.norm();
  basis_.setIdentity(n_, n_);
  triangle_.setZero(n_, n_);

  rows_.resize(m_, n_);
  scale_.resize(m_);
  double largest = size_;
  for (int row = 0; row < m_; ++row) {
    z_ = program.E.row(row).transpose();
    solve_upper_transposed(factor_, n_, z_);
    const double length = z_.norm();
    scale_(row) = length > 0 ? 1 / length : 1;
    rows_.row(row) = scale_(row) * z_.transpose();
    for (const double bound : {program.lower(row), program.upper(row)}) {
      if (std::isfinite(bound)) largest = std::max(largest, std::abs(scale_(row) * bound));
    }
  }
  lower_ = program.lower.cwiseProduct(scale_);
  upper_ = program.upper.cwiseProduct(scale_);
  largest_ = kLargest * largest;
}

QpStatus ActiveSet::run() {
  for (int row = 0; row < m_; ++row) {
    const bool equality = lower_(row) == upper_(row);
    if (equality && !passed_over_[static_cast<std::size_t>(row)] && !add_equality(row)) {
      return QpStatus::kInfeasible;
    }
  }
  for (;;) {
    const Active constraint = most_violated();
    if (constraint.side == 0) return QpStatus::kSolved;
    const QpStatus status = add_inequality(constraint);
    if (status != QpStatus::kSolved) return status;
  }
}

/// False if the equality contradicts those before it.
bool ActiveSet::add_equality(int row) {
  Active constraint{.row = row, .side = 1, .equality = true};
  step_towards(constraint);
  const double missing = -surplus(constraint);
  if (!independent_) {
    passed_over_[static_cast<std::size_t>(row)] = true;
    return std::abs(missing) <= doubtful(constraint);
  }
  constraint.multiplier = missing / curvature_;
  move(constraint.multiplier);
  append(constraint);
  return size_ <= largest_;
}

/// With side 0 if none is violated.
ActiveSet::Active ActiveSet::most_violated() const {
  Active worst;
  double most = 0;
  for (int row = 0; row < m_; ++row) {
    const auto k = static_cast<std::size_t>(row);
    if (passed_over_[k] || as_good_as_kept_[k]) continue;
    const double value = rows_.row(row).dot(y_);
    const double below = lower_(row) - value, above = value - upper_(row);
    if (below > most && below > kViolated * reach(lower_(row))) {
      most = below;
      worst = {.row = row, .side = 1};
    }
    if (above > most && above > kViolated * reach(upper_(row))) {
      most = above;
      worst = {.row = row, .side = -1};
    }
  }
  return worst;
}

/// Step 2 of the publication, until the row is active.
QpStatus ActiveSet::add_inequality(Active constraint) {
  const int most_iterations = 20 * (n_ + m_);
  step_towards(constraint);
  if (!independent_ && -surplus(constraint) <= doubtful(constraint)) {
    as_good_as_kept_[static_cast<std::size_t>(constraint.row)] = true;
    return QpStatus::kSolved;
  }
  for (;; step_towards(constraint)) {
    if (iterations_ > most_iterations) return QpStatus::kIterationLimit;
    double dual_step = kInfinity;
    const int blocked_by = blocking(dual_step);
    const double full_step = independent_ ? -surplus(constraint) / curvature_ : kInfinity;
    if (dual_step == kInfinity && full_step == kInfinity) return QpStatus::kInfeasible;
    const double step = std::max(0.0, std::min(dual_step, full_step));
    move(step);
    constraint.multiplier += step;
    if (size_ > largest_) return QpStatus::kInfeasible;
    if (full_step <= dual_step) {
      append(constraint);
      return QpStatus::kSolved;
    }
    drop(blocked_by);
  }
}

/// d = Qᵀn, z = Q2 d2, r = R^-1 d1.
void ActiveSet::step_towards(const Active& constraint) {
  z_ = constraint.side * rows_.row(constraint.row).transpose();
  d_.noalias() = basis_.transpose() * z_;
  const int rest = n_ - count_;
  curvature_ = d_.tail(rest).squaredNorm();
  r_ = d_.head(count_);
  solve_upper(triangle_, count_, r_);
  independent_ = std::sqrt(curvature_) > kRounding * (1 + r_.lpNorm<1>());
  if (independent_) z_.noalias() = basis_.rightCols(rest) * d_.tail(rest);
}

/// Position of the active row whose multiplier is the first to vanish, after this step.
int ActiveSet::blocking(double& step) const {
  const double rounding = count_ > 0 ? kRounding * r_.cwiseAbs().maxCoeff() : 0;
  int first = -1;
  for (int k = 0; k < count_; ++k) {
    const Active& active = active_[static_cast<std::size_t>(k)];
    if (active.equality || r_(k) <= rounding) continue;
    const double until = active.multiplier / r_(k);
    if (until < step) {
      step = until;
      first = k;
    }
  }
  return first;
}

void ActiveSet::move(double step) {
  if (independent_) y_ += step * z_;
  size_ = std::max(size_, y_.norm());
  for (int k = 0; k < count_; ++k) {
    Active& active = active_[static_cast<std::size_t>(k)];
    active.multiplier -= step * r_(k);
    if (!active.equality) active.multiplier = std::max(0.0, active.multiplier);
  }
}

/// The row that d_ belongs to: rotations empty d2 but for its first entry.
void ActiveSet::append(const Active& constraint) {
  for (int k = n_ - 1; k > count_; --k) {
    Eigen::JacobiRotation<double> rotation;
    double length;
    rotation.makeGivens(d_(k - 1), d_(k), &length);
    d_(k - 1) = length;
    basis_.applyOnTheRight(k - 1, k, rotation);
  }
  triangle_.col(count_).head(count_ + 1) = d_.head(count_ + 1);
  passed_over_[static_cast<std::size_t>(constraint.row)] = true;
  as_good_as_kept_.fill(false);
  active_[static_cast<std::size_t>(count_++)] = constraint;
  ++iterations_;
}

void ActiveSet::drop(int position) {
  passed_over_[static_cast<std::size_t>(active_[static_cast<std::size_t>(position)].row)] = false;
  for (int k = position; k + 1 < count_; ++k) {
    active_[static_cast<std::size_t>(k)] = active_[static_cast<std::size_t>(k) + 1];
    triangle_.col(k).head(k + 2) = triangle_.col(k + 1).head(k + 2);
  }
  --count_;
  ++iterations_;
  for (int k = position; k < count_; ++k) {
    Eigen::JacobiRotation<double> rotation;
    rotation.makeGivens(triangle_(k, k), triangle_(k + 1, k));
    triangle_.block(0, k, k + 2, count_ - k).applyOnTheLeft(k, k + 1, rotation.adjoint());
    basis_.applyOnTheRight(k, k + 1, rotation);
  }
}

/// y onto the active rows by the shortest way, and the multipliers from the gradient there.
void ActiveSet::correct() {
  r_.resize(count_);
  for (int k = 0; k < count_; ++k) r_(k) = -surplus(active_[static_cast<std::size_t>(k)]);
  solve_upper_transposed(triangle_, count_, r_);
  y_.noalias() += basis_.leftCols(count_) * r_;
  z_ = y_ - y_start_;
  r_.noalias() = basis_.leftCols(count_).transpose() * z_;
  solve_upper(triangle_, count_, r_);
  for (int k = 0; k < count_; ++k) {
    Active& active = active_[static_cast<std::size_t>(k)];
    active.multiplier = active.equality ? r_(k) : std::max(0.0, r_(k));
  }
}

double ActiveSet::bound(const Active& constraint) const {
  return constraint.side > 0 ? lower_(constraint.row) : upper_(constraint.row);
}

/// Negative by as much as the constraint is violated.
double ActiveSet::surplus(const Active& constraint) const {
  return constraint.side * (rows_.row(constraint.row).dot(y_) - bound(constraint));
}

/// How much a row that depends on the active ones may be violated, and still be kept by some y: a
/// hundred times as far as any so far where part of the row is new, and for roundings of the active
/// rows that it is made of.
double ActiveSet::doubtful(const Active& constraint) const {
  const double part = 100 * std::sqrt(curvature_) + kRounding * (1 + r_.lpNorm<1>());
  return std::max(part, kViolated) * reach(bound(constraint));
}

double ActiveSet::reach(double bound) const { return std::abs(bound) + size_; }

}  // namespace bqsa::baselines
