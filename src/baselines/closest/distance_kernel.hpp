/// @file
/// The loop of `segment_distances`, compiled once for every instruction set: plain numbers only.
#pragma once

#include "baselines/closest/point_arrays.hpp"

namespace bqsa::baselines {

/// All segments against all blocks of ellipsoids.
struct DistancePass {
  const PointArrays* starts;
  const PointArrays* ends;
  const double* ellipsoids;  ///< EllipsoidBlocks::data
  int blocks;
  double* distance;  ///< of a DistanceTable [m]
  double* t;         ///< of a DistanceTable

  /// Asked, with `context`, for what the loop could not prove: ellipsoids `first` to `first + 31` of
  /// which the bit in `lanes` is set.
  void (*redo)(void* context, int segment, int first, unsigned lanes);
  void* context;
};

/// With the instruction set in use.
void run_distance_pass(const DistancePass& pass);

}  // namespace bqsa::baselines
