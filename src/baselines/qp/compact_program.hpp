/// @file
/// The compact form of a program (Cheng, Chen and Sun 1994): its first equalities eliminated.
#pragma once

#include <array>

#include "baselines/qp/quadratic_program.hpp"

namespace bqsa::baselines {

/// Basis of the kernel of J by Gaussian elimination with complete pivoting: J = [J1 J2] up to the order
/// of its columns, J1 regular, and Z = [-J1^-1 J2; I]. With rows of unit length, pivots
/// below 1e-9 count as zero. Does not allocate.
class KernelBasis {
 public:
  void assign(const TaskJacobian& J);
  const QpMatrix& matrix() const { return kernel_; }

 private:
  TaskJacobian rest_;
  std::array<int, kMaxJoints> order_;  // pivot columns first
  QpMatrix kernel_;
};

/// A program in the free variables y alone: x = x0 + Z y, where x0 keeps the equalities J x = b that are
/// the first rows of the program. Its rows are the others, in their order. Does not allocate.
class CompactProgram {
 public:
  /// @param equalities  how many first rows there are to eliminate
  /// @param x0          keeps them
  void assign(const QuadraticProgram& program, int equalities, const QpVector& x0);

  /// May be changed before it is solved, if variables are added behind its own.
  QuadraticProgram& reduced() { return reduced_; }

  /// x of a solution y, further variables left out.
  QpVector expand(const QpVector& y) const {
    return x0_ + basis_.matrix() * y.head(basis_.matrix().cols());
  }

 private:
  KernelBasis basis_;
  TaskJacobian J_;
  QpVector x0_;
  QpMatrix weighted_;  // G Z
  QuadraticProgram reduced_;
};

}  // namespace bqsa::baselines
