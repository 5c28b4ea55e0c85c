/// @file
/// The inner loop of the vectorised search, alone in its file with its own compiler options.
#pragma once

#include "baselines/closest/point_arrays.hpp"

namespace bqsa::baselines {

/// For every point of `from` the least squared distance to any point of `to`.
void least_squared_distances_2d(const PointArrays& from, const PointArrays& to, double* least);
void least_squared_distances_3d(const PointArrays& from, const PointArrays& to, double* least);

}  // namespace bqsa::baselines
