/// @file
/// Where the test points of links and obstacles lie.
#pragma once

#include <Eigen/Core>

namespace bqsa::baselines {

/// How many test points there are.
struct TestPointCounts {
  int link = 2;      ///< N a link, at least 2: evenly spaced, both ends included
  int obstacle = 1;  ///< M an obstacle
};

/// M points, a column each. In the plane, of the unit circle at even steps of the angle; in space, of
/// the unit sphere: a spiral of even steps in area (Fibonacci).
Eigen::Matrix3Xd unit_test_points(int dimension, int count);

}  // namespace bqsa::baselines
