/// @file
/// The end-points of all links in all poses of a workload, as detectors read them.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "harness/measuring/workload.hpp"

namespace bqsa::harness {

template <int Dim>
class EndPoints {
 public:
  using Point = Eigen::Matrix<double, Dim, 1>;

  explicit EndPoints(const Workload& workload)
      : points_a_pose_(static_cast<std::size_t>(workload.size.links) + 1) {
    for (const Eigen::Matrix3Xd& pose : workload.poses) {
      for (const auto& p : pose.colwise()) points_.push_back(p.template head<Dim>());
    }
  }

  /// O_1 .. O_{n+1}.
  std::span<const Point> operator[](int pose) const {
    return std::span(points_).subspan(static_cast<std::size_t>(pose) * points_a_pose_,
                                      points_a_pose_);
  }

 private:
  std::size_t points_a_pose_;
  std::vector<Point> points_;
};

}  // namespace bqsa::harness
