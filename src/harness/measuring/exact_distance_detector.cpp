// The analytic rival that needs no test points either.

#include <cassert>

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
       .prepare = [](const Workload& workload) -> std::unique_ptr<Detection> {
         return std::make_unique<ExactDistanceDetection>(workload);
       }}};
}

}  // namespace bqsa::harness
