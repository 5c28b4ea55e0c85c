/// @file
/// Random quadratic programs whose feasible points, or whose proofs that there is none, are known.
#pragma once

#include <algorithm>
#include <limits>

#include "baselines/qp/quadratic_program.hpp"
#include "support/sampling.hpp"

namespace bqsa::test_support {

struct ProgramShape {
  int largest_variables = 16;
  bool well_scaled = false;   ///< G = I and rows of like length, as in control; else ill-scaled
  double least_angle = 1e-6;  ///< between rows that are near copies [rad], about
};

inline double infinity() { return std::numeric_limits<double>::infinity(); }

inline baselines::QpVector random_qp_vector(Generator& generator, int size) {
  return baselines::QpVector::NullaryExpr(size, [&](Eigen::Index) { return normal(generator); });
}

/// A positive definite G with eigenvalues between 1e-3 and 1e3, or the identity.
inline baselines::QpMatrix random_metric(Generator& generator, int n, bool identity) {
  if (identity) return baselines::QpMatrix::Identity(n, n);
  baselines::QpMatrix G = baselines::QpMatrix::Zero(n, n);
  for (int k = 0; k < n; ++k) {
    const baselines::QpVector v = random_qp_vector(generator, n);
    G += log_uniform(generator, 1e-3, 1e3) / n * v * v.transpose();
  }
  G.diagonal().array() += 1e-3;
  return G;
}

/// A program that keeps a known point x0. Its rows include, at random: equalities, rank-deficient ones
/// among them, rows that pass exactly through x0 (more than there are variables: a degenerate
/// vertex), copies, opposites and near copies of other rows, tight and infinite bounds, empty rows.
inline baselines::QuadraticProgram feasible_program(Generator& generator, const ProgramShape& shape,
                                                    baselines::QpVector& x0) {
  const auto chance = [&](double p) { return uniform(generator, 0, 1) < p; };
  const auto integer = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(generator);
  };
  const bool plain = shape.well_scaled;
  const int n = integer(1, shape.largest_variables);
  const int equalities = integer(0, std::min(n, 6));
  const int rows = equalities + integer(0, std::min(2 * n + 6, baselines::kMaxQpRows - 6));
  baselines::QuadraticProgram program;
  program.G = random_metric(generator, n, plain || chance(0.5));
  program.c = log_uniform(generator, 1e-2, 1e2) * random_qp_vector(generator, n);
  program.E.resize(rows, n);
  program.lower.resize(rows);
  program.upper.resize(rows);
  x0 = random_qp_vector(generator, n);
  if (chance(0.1)) x0.setZero();
  const bool degenerate = chance(0.3);
  for (int i = 0; i < rows; ++i) {
    baselines::QpVector row = random_qp_vector(generator, n);
    if (chance(0.3)) row = baselines::QpVector::Unit(n, integer(0, n - 1));
    if (i > 0 && chance(0.15)) {
      const baselines::QpVector other = program.E.row(integer(0, i - 1)).transpose();
      const double nearness = chance(0.5) ? 0 : log_uniform(generator, shape.least_angle, 1e-2);
      row = (chance(0.5) ? 1 : -1) * other + nearness * row;
    } else if (i > 1 && chance(0.1)) {
      row = program.E.row(integer(0, i - 1)).transpose() -
            2 * program.E.row(integer(0, i - 1)).transpose();
    }
    if (!plain && chance(0.2)) row *= log_uniform(generator, 1e-3, 1e3);
    if (chance(0.02)) row.setZero();
    program.E.row(i) = row.transpose();
    const double value = program.E.row(i).dot(x0);
    const double length = row.norm();
    const auto room = [&] {
      if (chance(0.3)) return infinity();
      return degenerate && chance(0.8) ? 0 : length * log_uniform(generator, 1e-3, 3);
    };
    program.lower(i) = i < equalities ? value : value - room();
    program.upper(i) = i < equalities ? value : value + room();
  }
  return program;
}

/// A program that no x keeps: after a feasible one's rows it has a last row that is minus a positive
/// combination of others, y, and asks for more than they leave: with e = -sum y_i n_i (n_i x >= b_i)
/// every x that keeps them has e x <= -sum y_i b_i, and the row asks for `gap` more.
inline baselines::QuadraticProgram infeasible_program(Generator& generator,
                                                      const ProgramShape& shape) {
  for (;;) {
    baselines::QpVector x0;
    baselines::QuadraticProgram program = feasible_program(generator, shape, x0);
    const int rows = program.rows();
    baselines::QpVector e = baselines::QpVector::Zero(program.variables());
    double most = 0, size = 0;
    int used = 0;
    for (int tries = 0; tries < 4 && rows > 0; ++tries) {
      const int i = std::uniform_int_distribution<int>(0, rows - 1)(generator);
      const bool below = uniform(generator, 0, 1) < 0.5;
      const double side = below ? 1 : -1;
      const double bound = below ? program.lower(i) : program.upper(i);
      const double length = program.E.row(i).norm();
      if (!std::isfinite(bound) || length == 0) continue;
      const double y = uniform(generator, 0.2, 1) / length;
      e -= y * side * program.E.row(i).transpose();
      most -= y * side * bound;
      size += std::abs(y * bound);
      ++used;
    }
    if (used == 0 || rows == baselines::kMaxQpRows) continue;
    const double gap = log_uniform(generator, 1e-4, 1) * (1 + size + x0.norm());
    program.E.conservativeResize(rows + 1, program.variables());
    program.lower.conservativeResize(rows + 1);
    program.upper.conservativeResize(rows + 1);
    program.E.row(rows) = e.transpose();
    program.lower(rows) = most + gap;
    program.upper(rows) = infinity();
    return program;
  }
}

}  // namespace bqsa::test_support
