#include "harness/measuring/test_points.hpp"

namespace bqsa::harness {

Eigen::Matrix3Xd link_test_points(const Workload& workload) {
  const int count = workload.size.test_points.link;
  Eigen::Matrix3Xd points(
      3, static_cast<Eigen::Index>(workload.poses.size()) * workload.size.links * count);
  Eigen::Index next = 0;
  for (const Eigen::Matrix3Xd& pose : workload.poses) {
    for (int i = 0; i < workload.size.links; ++i) {
      for (int k = 0; k < count; ++k) {
        const double t = count == 1 ? 0.5 : static_cast<double>(k) / (count - 1);
        points.col(next++) = (1 - t) * pose.col(i) + t * pose.col(i + 1);
      }
    }
  }
  return points;
}

Eigen::Matrix3Xd obstacle_test_points(const Workload& workload) {
  const Eigen::Matrix3Xd unit =
      baselines::unit_test_points(workload.size.dimension, workload.size.test_points.obstacle);
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(workload.obstacles.size()) * unit.cols());
  Eigen::Index next = 0;
  for (const Ellipsoid& shape : workload.obstacles) {
    const Eigen::Matrix3d map = shape.rotation() * shape.semi_axes().asDiagonal();
    points.middleCols(next, unit.cols()) = (map * unit).colwise() + shape.center();
    next += unit.cols();
  }
  return points;
}

}  // namespace bqsa::harness
