#include "baselines/qp/dual_network.hpp"

#include <Eigen/Cholesky>
#include <cassert>
#include <cmath>

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
  solution.x = Y_ * u_ - offset_;
  factor_.triangularView<Eigen::Upper>().solveInPlace(solution.x);
  solution.u = u_.cwiseProduct(scale_);
}

void DualNetwork::connect(const QuadraticProgram& program) {
  assert((program.lower.array() <= program.upper.array()).all());
  const Eigen::LLT<QpMatrix> llt(program.G);
  assert(llt.info() == Eigen::Success);
  factor_ = llt.matrixU();
  offset_ = program.c;
  llt.matrixL().solveInPlace(offset_);
  Y_ = program.E.transpose();
  llt.matrixL().solveInPlace(Y_);
  M_.noalias() = Y_.transpose() * Y_;
  scale_.resize(program.rows());
  for (int row = 0; row < program.rows(); ++row) {
    const double sum = M_.row(row).cwiseAbs().sum();
    scale_(row) = sum > 0 ? 1 / std::sqrt(sum) : 1;
  }
  for (int row = 0; row < program.rows(); ++row) {
    Y_.col(row) *= scale_(row);
    M_.row(row) *= scale_(row);
    M_.col(row) *= scale_(row);
  }
  lower_ = program.lower.cwiseProduct(scale_);
  upper_ = program.upper.cwiseProduct(scale_);
  shift_.noalias() = Y_.transpose() * offset_;
}

/// F(u) and r(u).
void DualNetwork::respond() {
  F_.noalias() = M_ * u_;
  F_ -= shift_;
  r_ = (F_ - u_).cwiseMax(lower_).cwiseMin(upper_) - F_;
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
  return gap > kLargestSolution * (Y_ * v_).norm();
}

}  // namespace bqsa::baselines
