/// @file
/// The inner loop of the vectorised search, alone in its file with its own compiler options.
#pragma once

namespace bqsa::baselines {

/// Points with their coordinates in separate arrays. In the plane z is not read.
struct PointArrays {
  const double* x;
  const double* y;
  const double* z;
  int count;
};

/// For every point of `from` the least squared distance to any point of `to`.
void least_squared_distances_2d(const PointArrays& from, const PointArrays& to, double* least);
void least_squared_distances_3d(const PointArrays& from, const PointArrays& to, double* least);

}  // namespace bqsa::baselines
