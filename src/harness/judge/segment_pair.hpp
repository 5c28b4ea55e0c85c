/// @file
/// The nearest points of two segments.
#pragma once

#include <Eigen/Core>

namespace bqsa::harness {

/// One point of each of two segments.
struct PointPair {
  Eigen::Vector3d on_first;
  Eigen::Vector3d on_second;

  double distance() const { return (on_first - on_second).norm(); }
};

/// The pair with the least distance; one of them where there are several. Either segment may be a
/// point.
PointPair nearest_points(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                         const Eigen::Vector3d& c, const Eigen::Vector3d& d);

}  // namespace bqsa::harness
