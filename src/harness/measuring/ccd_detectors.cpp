// libccd without FCL around it, with support functions for exactly what links and obstacles are. In
// millimetres, like FCL: libccd's tolerance, 1e-4 of them, is absolute too.

#include <ccd/ccd.h>

#include <Eigen/Core>
#include <cassert>

#include "harness/measuring/detector_lists.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;

constexpr double kMillimetres = 1000;
constexpr unsigned long kMostIterations = 500;  // as FCL sets it

struct Segment {
  Vector3d a, b;  // [mm]
};

/// The image of the unit ball.
struct Ball {
  Vector3d center;      // [mm]
  Eigen::Matrix3d map;  // [mm]
};

Vector3d from_ccd(const ccd_vec3_t& v) { return {v.v[0], v.v[1], v.v[2]}; }
void to_ccd(const Vector3d& v, ccd_vec3_t* out) { ccdVec3Set(out, v.x(), v.y(), v.z()); }

void segment_support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
  const auto& segment = *static_cast<const Segment*>(object);
  to_ccd(from_ccd(*direction).dot(segment.b - segment.a) > 0 ? segment.b : segment.a, point);
}

void ball_support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
  const auto& ball = *static_cast<const Ball*>(object);
  const Vector3d n = ball.map.transpose() * from_ccd(*direction);
  to_ccd(ball.center + ball.map * (n / n.norm()), point);
}

void segment_center(const void* object, ccd_vec3_t* center) {
  const auto& segment = *static_cast<const Segment*>(object);
  to_ccd(0.5 * (segment.a + segment.b), center);
}

void ball_center(const void* object, ccd_vec3_t* center) {
  to_ccd(static_cast<const Ball*>(object)->center, center);
}

/// From one centre to the other: where the nearest points are likely to be.
void first_direction(const void* segment, const void* ball, ccd_vec3_t* direction) {
  ccd_vec3_t from;
  segment_center(segment, &from);
  ball_center(ball, direction);
  ccdVec3Sub(direction, &from);
  if (ccdVec3Len2(direction) == 0) ccdFirstDirDefault(segment, ball, direction);
}

template <int (*Intersect)(const void*, const void*, const ccd_t*)>
class CcdDetection final : public Detection {
 public:
  explicit CcdDetection(const Workload& workload)
      : links_a_pose_(static_cast<std::size_t>(workload.size.links)) {
    for (const Eigen::Matrix3Xd& pose : workload.poses) {
      for (Eigen::Index i = 0; i + 1 < pose.cols(); ++i) {
        links_.push_back({kMillimetres * pose.col(i), kMillimetres * pose.col(i + 1)});
      }
    }
    for (const Ellipsoid& shape : workload.obstacles) {
      obstacles_.push_back({kMillimetres * shape.center(),
                            shape.rotation() * (kMillimetres * shape.semi_axes()).asDiagonal()});
    }
    CCD_INIT(&ccd_);
    ccd_.first_dir = first_direction;
    ccd_.support1 = segment_support;
    ccd_.support2 = ball_support;
    ccd_.center1 = segment_center;
    ccd_.center2 = ball_center;
    ccd_.max_iterations = kMostIterations;
  }

  void detect(int pose, std::span<std::uint8_t> hit) override {
    assert(hit.size() == obstacles_.size() * links_a_pose_);
    const Segment* const links = &links_[static_cast<std::size_t>(pose) * links_a_pose_];
    std::uint8_t* answer = hit.data();
    for (const Ball& ball : obstacles_) {
      for (std::size_t i = 0; i < links_a_pose_; ++i) {
        *answer++ = Intersect(&links[i], &ball, &ccd_) != 0;
      }
    }
  }

 private:
  std::size_t links_a_pose_;
  std::vector<Segment> links_;
  std::vector<Ball> obstacles_;
  ccd_t ccd_;
};

template <int (*Intersect)(const void*, const void*, const ccd_t*)>
std::unique_ptr<Detection> prepare(const Workload& workload) {
  return std::make_unique<CcdDetection<Intersect>>(workload);
}

}  // namespace

std::vector<Detector> ccd_detectors() {
  return {library_detector("ccd_gjk", "libccd GJK",
                           "libccd's GJK called directly, with support functions of segment and "
                           "ellipsoid",
                           prepare<ccdGJKIntersect>),
          library_detector("ccd_mpr", "libccd MPR",
                           "libccd's portal refinement (MPR) called directly, likewise",
                           prepare<ccdMPRIntersect>)};
}

}  // namespace bqsa::harness
