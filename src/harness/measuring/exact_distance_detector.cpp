// The analytic rival that needs no test points either, pair by pair and for many obstacles at a time.

#include <cassert>

#include "baselines/closest/batched_distance.hpp"
#include "baselines/closest/segment_ellipsoid_distance.hpp"
#include "harness/measuring/detector_lists.hpp"
#include "harness/measuring/end_points.hpp"

namespace bqsa::harness {
namespace {

class ExactDistanceDetection final : public Detection {
 public:
  explicit ExactDistanceDetection(const Workload& workload)
      : points_(workload), obstacles_(workload.obstacles) {}

  void detect(int pose, std::span<std::uint8_t> hit) override {
    const std::span<const Eigen::Vector3d> points = points_[pose];
    assert(hit.size() == obstacles_.size() * (points.size() - 1));
    std::uint8_t* answer = hit.data();
    for (const Ellipsoid& shape : obstacles_) {
      for (std::size_t i = 1; i < points.size(); ++i) {
        *answer++ = baselines::segment_distance(points[i - 1], points[i], shape).distance <= 0;
      }
    }
  }

 private:
  EndPoints<3> points_;
  std::vector<Ellipsoid> obstacles_;
};

class BatchedDistanceDetection final : public Detection {
 public:
  explicit BatchedDistanceDetection(const Workload& workload)
      : links_(workload.size.links),
        obstacles_(workload.obstacles),
        distances_(links_, obstacles_) {
    for (const Eigen::Matrix3Xd& pose : workload.poses) points_.push_back(pose.transpose());
  }

  void detect(int pose, std::span<std::uint8_t> hit) override {
    assert(hit.size() == static_cast<std::size_t>(obstacles_.count() * links_));
    const Eigen::MatrixX3d& points = points_[static_cast<std::size_t>(pose)];
    segment_distances(arrays(points, 0), arrays(points, 1), obstacles_, distances_);
    std::uint8_t* answer = hit.data();
    for (int j = 0; j < obstacles_.count(); ++j) {
      for (int i = 0; i < links_; ++i) *answer++ = distances_.distance[distances_.index(i, j)] <= 0;
    }
  }

 private:
  /// Those of all links, the first at this end-point.
  baselines::PointArrays arrays(const Eigen::MatrixX3d& points, int first) const {
    return {points.col(0).data() + first, points.col(1).data() + first,
            points.col(2).data() + first, links_};
  }

  int links_;
  std::vector<Eigen::MatrixX3d> points_;  // of a pose, O_1 .. O_{n+1} by rows
  baselines::EllipsoidBlocks obstacles_;
  baselines::DistanceTable distances_;
};

template <typename Detection>
std::unique_ptr<bqsa::harness::Detection> prepare(const Workload& workload) {
  return std::make_unique<Detection>(workload);
}

}  // namespace

std::vector<Detector> exact_distance_detectors() {
  return {
      {.name = "exact_distance",
       .label = "exact distance",
       .what = "the distance of segment and ellipsoid by Newton's method; in 3-D, in the plane too",
       .accuracy = Accuracy::kExact,
       .in_plane = true,
       .in_space = true,
       .multiplications = not_counted,
       .prepare = prepare<ExactDistanceDetection>},
      {.name = "exact_distance_batched",
       .label = "exact distance, batched",
       .what = "the same to within 1e-10, for as many obstacles at a time as a vector has numbers",
       .accuracy = Accuracy::kExact,
       .in_plane = true,
       .in_space = true,
       .multiplications = not_counted,
       .prepare = prepare<BatchedDistanceDetection>}};
}

}  // namespace bqsa::harness
