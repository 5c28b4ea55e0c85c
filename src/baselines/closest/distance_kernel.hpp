/// @file
/// The loop of `segment_distances`, compiled once for every instruction set: plain numbers only.
#pragma once

#include <cstddef>

#include "baselines/closest/point_arrays.hpp"

namespace bqsa::baselines {

/// Ellipsoids that lie side by side: as many as the widest vector has doubles.
inline constexpr std::ptrdiff_t kEllipsoidBlock = 8;

/// Numbers an ellipsoid, a row of the block each: centre, rotation column by column, squared semi-axes,
/// their reciprocals, largest semi-axis.
inline constexpr std::ptrdiff_t kEllipsoidRows = 19;

/// All segments against all blocks of ellipsoids.
struct DistancePass {
  const PointArrays* starts;
  const PointArrays* ends;
  const double* ellipsoids;  ///< block by block, row by row
  int blocks;
  double* distance;  ///< block by block, segment by segment [m]
  double* t;         ///< likewise

  /// Called, with `context`, for what the loop cannot prove: ellipsoid first + k if bit k of `lanes` is
  /// set, counted without regard to blocks.
  void (*redo)(void* context, int segment, int first, unsigned lanes);
  void* context;
};

/// With the instruction set in use.
void run_distance_pass(const DistancePass& pass);

}  // namespace bqsa::baselines
