/// @file
/// Singular values of a task matrix: few rows, as many columns as joints.
#pragma once

#include <array>

#include "bqsa/kinematics/serial_chain.hpp"

namespace bqsa {

using TaskVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxTaskRows, 1>;

/// A = U S Vᵀ by one-sided Jacobi rotations of the rows of A (Hestenes 1958): pairs of rows are turned
/// until all are orthogonal. Then their lengths are the singular values, their directions the columns
/// of V, and the turns make up U. Small singular values keep the digits that the rows have. A task of
/// two rows takes one rotation and a second to polish.
class RowSvd {
 public:
  void decompose(const TaskJacobian& A);

  int rows() const { return rows_; }

  /// s_1 >= s_2 >= ... >= 0, as many as A has rows; i counts from 0 in all of these.
  double s(int i) const { return s_[at(i)]; }

  /// u_iᵀ x
  double along_u(int i, const TaskVector& x) const;

  /// v_iᵀ y, only where s_i > 0
  double along_v(int i, const JointVector& y) const;

  /// y += factor v_i, only where s_i > 0
  void add_v(int i, double factor, JointVector& y) const;

 private:
  using Row = std::array<double, kMaxJoints>;
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  bool turn(std::size_t i, std::size_t k);

  int rows_ = 0;
  int columns_ = 0;
  std::array<Row, kMaxTaskRows> sv_;                              ///< rows s_i v_iᵀ
  std::array<std::array<double, kMaxTaskRows>, kMaxTaskRows> u_;  ///< rows u_iᵀ
  std::array<double, kMaxTaskRows> s_;
};

}  // namespace bqsa
