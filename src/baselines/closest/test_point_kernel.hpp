/// @file
/// The loop of `least_squared_distances`, compiled once for every instruction set: plain numbers only.
#pragma once

#include <cstddef>

#include "baselines/closest/point_arrays.hpp"

namespace bqsa::baselines {

/// Points that lie side by side: as many as the widest vector has doubles.
inline constexpr std::ptrdiff_t kPointBlock = 8;

struct TestPointPass {
  const double* blocks;  ///< block by block, row by row, coordinate by coordinate
  int dimension;
  int block_count;
  int rows;  ///< a block
  PointArrays points;
  int count;    ///< of `points` that belong together
  bool across;  ///< whether the least of all lanes is wanted
  bool fused;   ///< by multiply-adds, which round once

  /// Block by block, group of points by group of points; eight each unless `across`.
  double* least;
};

/// With the instruction set in use.
void run_test_point_pass(const TestPointPass& pass);

}  // namespace bqsa::baselines
