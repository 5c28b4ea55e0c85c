#include "bqsa/row_svd.hpp"

#include <cmath>
#include <utility>

namespace bqsa {
namespace {

/// Cosine of the angle between rows that pass for orthogonal.
constexpr double kOrthogonal = 4e-15;

/// Bounds the work on matrices with numbers that are none; others take two to five.
constexpr int kMaxSweeps = 30;

}  // namespace

void RowSvd::decompose(const TaskJacobian& A) {
  rows_ = static_cast<int>(A.rows());
  columns_ = static_cast<int>(A.cols());
  for (int i = 0; i < rows_; ++i) {
    for (int j = 0; j < columns_; ++j) sv_[at(i)][at(j)] = A(i, j);
    for (int k = 0; k < rows_; ++k) u_[at(i)][at(k)] = i == k ? 1 : 0;
  }

  const auto m = static_cast<std::size_t>(rows_);
  bool turned = true;
  for (int sweep = 0; turned && sweep < kMaxSweeps; ++sweep) {
    turned = false;
    for (std::size_t i = 0; i < m; ++i) {
      for (std::size_t k = i + 1; k < m; ++k) turned |= turn(i, k);
    }
  }

  for (std::size_t i = 0; i < m; ++i) {
    double squared = 0;
    for (int j = 0; j < columns_; ++j) squared += sv_[i][at(j)] * sv_[i][at(j)];
    s_[i] = std::sqrt(squared);
    for (std::size_t k = i; k > 0 && s_[k] > s_[k - 1]; --k) {
      std::swap(s_[k], s_[k - 1]);
      std::swap(sv_[k], sv_[k - 1]);
      std::swap(u_[k], u_[k - 1]);
    }
  }
}

/// Makes two rows orthogonal. False if they were.
bool RowSvd::turn(std::size_t i, std::size_t k) {
  Row& a = sv_[i];
  Row& b = sv_[k];
  double aa = 0, bb = 0, ab = 0;
  for (int j = 0; j < columns_; ++j) {
    aa += a[at(j)] * a[at(j)];
    bb += b[at(j)] * b[at(j)];
    ab += a[at(j)] * b[at(j)];
  }
  if (!(std::abs(ab) > kOrthogonal * std::sqrt(aa * bb))) return false;

  // The smaller of the two angles that do it (Rutishauser).
  const double zeta = (bb - aa) / (2 * ab);
  const double t = std::copysign(1 / (std::abs(zeta) + std::sqrt(1 + zeta * zeta)), zeta);
  const double c = 1 / std::sqrt(1 + t * t);
  const double s = c * t;
  const auto rotate = [c, s](double& x, double& y) {
    const double x1 = c * x - s * y;
    y = s * x + c * y;
    x = x1;
  };
  for (int j = 0; j < columns_; ++j) rotate(a[at(j)], b[at(j)]);
  for (int j = 0; j < rows_; ++j) rotate(u_[i][at(j)], u_[k][at(j)]);
  return true;
}

double RowSvd::along_u(int i, const TaskVector& x) const {
  double sum = 0;
  for (int k = 0; k < rows_; ++k) sum += u_[at(i)][at(k)] * x(k);
  return sum;
}

double RowSvd::along_v(int i, const JointVector& y) const {
  double sum = 0;
  for (int j = 0; j < columns_; ++j) sum += sv_[at(i)][at(j)] * y(j);
  return sum / s(i);
}

void RowSvd::add_v(int i, double factor, JointVector& y) const {
  const double per_s = factor / s(i);
  for (int j = 0; j < columns_; ++j) y(j) += per_s * sv_[at(i)][at(j)];
}

}  // namespace bqsa
