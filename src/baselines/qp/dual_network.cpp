#include "baselines/qp/dual_network.hpp"

#include <Eigen/Cholesky>
#include <cassert>
#include <cmath>

#include "baselines/qp/triangular.hpp"

namespace bqsa::baselines {

void DualNetwork::solve(const QuadraticProgram& program, QpSolution& solution) {
  constexpr int kTicksBetweenCertificates = 32;
  connect(program);
  if (solution.u.size() == program.rows()) {
    u_ = solution.u.cwiseQuotient(scale_);
  } else {
    u_.setZero(program.rows());
  }
  solution.status = QpStatus::kIterationLimit;
  solution.iterations = 0;
  for (;;) {
    respond();
    if (settled()) {
      solution.status = QpStatus::kSolved;
      break;
    }
    if (solution.iterations % kTicksBetweenCertificates == kTicksBetweenCertificates - 1 &&
        certifies_infeasible()) {
      solution.status = QpStatus::kInfeasible;
      break;
    }
    if (solution.iterations == settings_.max_iterations) break;
    u_ += kStep * r_;
    ++solution.iterations;
  }
  solution.x = rows_ * u_ - offset_;
  solve_upper(factor_, program.variables(), solution.x);
  solution.u = u_.cwiseProduct(scale_);
}

void DualNetwork::connect(const QuadraticProgram& program) {
  assert((program.lower.array() <= program.upper.array()).all());
  const Eigen::LLT<QpMatrix> llt(program.G);
  assert(llt.info() == Eigen::Success);
  factor_ = llt.matrixU();
  offset_ = program.c;
  solve_upper_transposed(factor_, program.variables(), offset_);
  rows_ = program.E.transpose();
  for (int row = 0; row < program.rows(); ++row) {
    solve_upper_transposed(factor_, program.variables(), rows_.col(row));
  }
  coupling_.noalias() = rows_.transpose() * rows_;
  scale_.resize(program.rows());
  for (int row = 0; row < program.rows(); ++row) {
    const double sum = coupling_.row(row).cwiseAbs().sum();
    scale_(row) = sum > 0 ? 1 / std::sqrt(sum) : 1;
  }
  for (int row = 0; row < program.rows(); ++row) {
    rows_.col(row) *= scale_(row);
    coupling_.row(row) *= scale_(row);
    coupling_.col(row) *= scale_(row);
  }
  lower_ = program.lower.cwiseProduct(scale_);
  upper_ = program.upper.cwiseProduct(scale_);
  shift_.noalias() = rows_.transpose() * offset_;
}

/// F(u) and r(u).
void DualNetwork::respond() {
  output_.noalias() = coupling_ * u_;
  output_ -= shift_;
  r_ = (output_ - u_).cwiseMax(lower_).cwiseMin(upper_) - output_;
}

bool DualNetwork::settled() const {
  return (r_.array().abs() <= settings_.tolerance * scale_.array()).all();
}

/// With v the direction in which u grows, but for its components towards an infinite bound.
bool DualNetwork::certifies_infeasible() {
  v_ = r_;
  double gap = 0;
  for (int row = 0; row < v_.size(); ++row) {
    const double bound = v_(row) > 0 ? lower_(row) : upper_(row);
    if (std::isfinite(bound)) {
      gap += v_(row) * bound;
    } else {
      v_(row) = 0;
    }
  }
  return gap > kLargestSolution * (rows_ * v_).norm();
}

}  // namespace bqsa::baselines
