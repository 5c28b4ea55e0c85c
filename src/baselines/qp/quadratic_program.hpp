/// @file
/// Small strictly convex quadratic programs: what the solvers are given, and what they answer.
#pragma once

#include <Eigen/Core>

#include "bqsa/kinematics/serial_chain.hpp"

namespace bqsa::baselines {

inline constexpr int kMaxEscapeRows = 32;
inline constexpr int kMaxQpVariables = kMaxJoints + kMaxEscapeRows;  ///< a slack an escape row
inline constexpr int kMaxQpRows = kMaxJoints + kMaxTaskRows + kMaxEscapeRows;

/// Their storage is part of the objects.
using QpVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxQpVariables, 1>;
using QpRowVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxQpRows, 1>;
using QpMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxQpVariables, kMaxQpVariables>;
using QpRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, kMaxQpRows,
                             kMaxQpVariables>;

/// min 1/2 xᵀG x + cᵀx  subject to  lower <= E x <= upper,
///
/// G symmetric and positive definite. Rows with lower = upper are equalities; infinite bounds do not
/// act.
struct QuadraticProgram {
  QpMatrix G;
  QpVector c;
  QpRows E;
  QpRowVector lower;
  QpRowVector upper;

  int variables() const { return static_cast<int>(c.size()); }
  int rows() const { return static_cast<int>(E.rows()); }
};

enum class QpStatus {
  kSolved,
  kInfeasible,      ///< no x keeps all rows
  kIterationLimit,  ///< neither was found; x is what the solver had got to
};

/// At the solution G x + c = Eᵀu, with u_i >= 0 at a lower bound, u_i <= 0 at an upper bound, any u_i
/// in an equality, and u_i = 0 elsewhere.
struct QpSolution {
  QpStatus status = QpStatus::kSolved;
  QpVector x;
  QpRowVector u;       ///< multipliers, one a row
  int iterations = 0;  ///< steps of the solver
};

}  // namespace bqsa::baselines
