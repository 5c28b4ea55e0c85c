#include "baselines/qp/compact_program.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace bqsa::baselines {

void KernelBasis::assign(const TaskJacobian& J) {
  constexpr double kZero = 1e-9;
  constexpr double kSmallest = std::numeric_limits<double>::min();
  const auto joints = static_cast<int>(J.cols());
  rest_ = J;
  for (int row = 0; row < J.rows(); ++row) rest_.row(row) /= std::max(kSmallest, J.row(row).norm());
  std::iota(order_.begin(), order_.end(), 0);
  int rank = 0;
  while (rank < std::min<int>(static_cast<int>(J.rows()), joints)) {
    Eigen::Index row, column;
    const double pivot =
        rest_.bottomRightCorner(J.rows() - rank, joints - rank).cwiseAbs().maxCoeff(&row, &column);
    if (pivot <= kZero) break;
    rest_.row(rank).swap(rest_.row(rank + row));
    rest_.col(rank).swap(rest_.col(rank + column));
    std::swap(order_[static_cast<std::size_t>(rank)],
              order_[static_cast<std::size_t>(rank + column)]);
    rest_.row(rank) /= double{rest_(rank, rank)};
    for (int other = 0; other < J.rows(); ++other) {
      if (other != rank) rest_.row(other) -= double{rest_(other, rank)} * rest_.row(rank);
    }
    ++rank;
  }
  kernel_.setZero(joints, joints - rank);
  for (int k = 0; k < joints; ++k) {
    const int joint = order_[static_cast<std::size_t>(k)];
    if (k < rank) {
      kernel_.row(joint) = -rest_.row(k).tail(joints - rank);
    } else {
      kernel_(joint, k - rank) = 1;
    }
  }
}

/// A row that depends on the equalities is left with nothing but roundings, which are removed.
void CompactProgram::assign(const QuadraticProgram& program, int equalities, const QpVector& x0) {
  constexpr double kNothing = 1e-10;
  J_ = program.E.topRows(equalities);
  basis_.assign(J_);
  x0_ = x0;
  const QpMatrix& Z = basis_.matrix();
  weighted_.noalias() = program.G * Z;
  reduced_.G.noalias() = Z.transpose() * weighted_;
  reduced_.c = weighted_.transpose().lazyProduct(x0);
  reduced_.c += Z.transpose().lazyProduct(program.c);
  const int rows = program.rows() - equalities;
  reduced_.E.noalias() = program.E.bottomRows(rows) * Z;
  reduced_.lower = program.lower.tail(rows);
  reduced_.upper = program.upper.tail(rows);
  const double rounding = kNothing * Z.norm();
  for (int row = 0; row < rows; ++row) {
    const double left = reduced_.E.row(row).norm();
    if (left <= rounding * program.E.row(equalities + row).norm()) reduced_.E.row(row).setZero();
    const double at_x0 = program.E.row(equalities + row).dot(x0);
    reduced_.lower(row) -= at_x0;
    reduced_.upper(row) -= at_x0;
  }
}

}  // namespace bqsa::baselines
