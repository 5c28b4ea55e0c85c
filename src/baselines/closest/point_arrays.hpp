/// @file
/// Points as vector code reads them.
#pragma once

namespace bqsa::baselines {

/// Points with their coordinates in separate arrays [m]. In the plane z is not read.
struct PointArrays {
  const double* x;
  const double* y;
  const double* z;
  int count;
};

}  // namespace bqsa::baselines
