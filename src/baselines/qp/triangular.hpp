/// @file
/// Systems with the upper triangle of a small matrix.
#pragma once

#include "baselines/qp/quadratic_program.hpp"

namespace bqsa::baselines {

/// U x = b with the leading `size` rows and columns of U; x holds b before.
inline void solve_upper(const QpMatrix& U, int size, Eigen::Ref<Eigen::VectorXd> x) {
  for (int i = size - 1; i >= 0; --i) {
    const int rest = size - i - 1;
    x(i) -= U.row(i).segment(i + 1, rest).dot(x.segment(i + 1, rest));
    x(i) /= U(i, i);
  }
}

/// Uᵀ x = b, as above.
inline void solve_upper_transposed(const QpMatrix& U, int size, Eigen::Ref<Eigen::VectorXd> x) {
  for (int i = 0; i < size; ++i) {
    x(i) -= U.col(i).head(i).dot(x.head(i));
    x(i) /= U(i, i);
  }
}

}  // namespace bqsa::baselines
