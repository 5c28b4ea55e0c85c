/// @file
/// Where the test points of a workload are.
#pragma once

#include <Eigen/Core>

#include "harness/measuring/workload.hpp"

namespace bqsa::harness {

/// N a link: evenly spaced, both ends included; a single one is in the middle.
/// @return a column each, in W [m]: first all of a link, then the next link, then the next pose
Eigen::Matrix3Xd link_test_points(const Workload& workload);

/// M an obstacle, on its surface: the map of even points on circle or sphere (test_point_layout.hpp).
/// @return a column each, in W [m]: first all of an obstacle, then the next
Eigen::Matrix3Xd obstacle_test_points(const Workload& workload);

}  // namespace bqsa::harness
