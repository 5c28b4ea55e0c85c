#include "baselines/qp/velocity_program.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bqsa::baselines {

bool VelocityProgram::assign(const Problem& problem, const JointVector& q,
                             const JointVector& tracking, const TaskJacobian& J_tip,
                             const std::vector<Escape>& escapes) {
  const auto joints = static_cast<int>(q.size());
  const auto tip_rows = static_cast<int>(J_tip.rows());
  choose(escapes);
  const int rows = tip_rows + joints + escape_count_;
  program_.G.setIdentity(joints, joints);
  program_.c = settings_.drift_gain * (q - problem.start);
  program_.E.setZero(rows, joints);
  program_.lower.resize(rows);
  program_.upper.resize(rows);

  // A row that is nothing but roundings beside the largest, of a stretched arm, demands nothing.
  constexpr double kNothing = 1e-9;
  const double largest = J_tip.rowwise().norm().maxCoeff();
  for (int row = 0; row < tip_rows; ++row) {
    program_.lower(row) = program_.upper(row) = 0;
    if (J_tip.row(row).norm() <= kNothing * largest) continue;
    program_.E.row(row) = J_tip.row(row);
    program_.lower(row) = program_.upper(row) = J_tip.row(row).dot(tracking);
  }
  const bool possible = limit_joints(problem, q, tracking, tip_rows);
  for (int k = 0; k < escape_count_; ++k) {
    const int row = tip_rows + joints + k;
    const double permitted = settings_.approach == ApproachLimit::kDamped
                                 ? settings_.gain * (escape(k).clearance - settings_.safe_distance)
                                 : 0;
    program_.E.row(row) = escape(k).j0.transpose();
    program_.lower(row) = escape(k).approach - permitted;
    program_.upper(row) = settings_.equalities ? double{program_.lower(row)}
                                               : std::numeric_limits<double>::infinity();
  }
  return possible;
}

/// Those that act; the nearest if they are too many.
void VelocityProgram::choose(const std::vector<Escape>& escapes) {
  escape_count_ = 0;
  for (const Escape& escape : escapes) {
    if (settings_.equalities && escape.clearance >= settings_.safe_distance) continue;
    auto last = escapes_.begin() + escape_count_;
    if (escape_count_ == kMaxEscapeRows) {
      last = std::max_element(
          escapes_.begin(), escapes_.end(),
          [](const Escape* a, const Escape* b) { return a->clearance < b->clearance; });
      if (escape.clearance >= (*last)->clearance) continue;
    } else {
      ++escape_count_;
    }
    *last = &escape;
  }
}

bool VelocityProgram::limit_joints(const Problem& problem, const JointVector& q,
                                   const JointVector& tracking, int first_row) {
  constexpr double kInside = 1 - 1e-9;  // of the limit, so that rounding does not break it
  const double dt = problem.dt;
  bool possible = true;
  for (int j = 0; j < q.size(); ++j) {
    const double limit = kInside * problem.max_step(j) / dt;
    const double v = std::min(std::max(settings_.max_velocity, std::abs(tracking(j))), limit);
    double lower = -v, upper = v;
    if (problem.limits.lower.size() > 0) {
      lower = std::max(lower, (problem.limits.lower(j) - q(j)) / dt);
    }
    if (problem.limits.upper.size() > 0) {
      upper = std::min(upper, (problem.limits.upper(j) - q(j)) / dt);
    }
    possible = possible && lower <= upper;
    program_.E(first_row + j, j) = 1;
    program_.lower(first_row + j) = lower;
    program_.upper(first_row + j) = upper;
  }
  return possible;
}

void VelocityProgram::soften(QuadraticProgram& program) const {
  const int variables = program.variables(), first_row = program.rows() - escape_count_;
  const double coefficient = 1 / std::sqrt(settings_.slack_weight);
  program.G.conservativeResizeLike(
      QpMatrix::Identity(variables + escape_count_, variables + escape_count_));
  program.c.conservativeResizeLike(QpVector::Zero(variables + escape_count_));
  program.E.conservativeResizeLike(QpRows::Zero(program.rows(), variables + escape_count_));
  for (int k = 0; k < escape_count_; ++k) program.E(first_row + k, variables + k) = coefficient;
}

}  // namespace bqsa::baselines
