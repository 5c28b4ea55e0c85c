#include "harness/judge/link_distance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;

struct Segment {
  const Vector3d& start;
  const Vector3d direction;

  Segment(const Vector3d& from, const Vector3d& to) : start(from), direction(to - from) {}
  Vector3d at(double parameter) const { return start + parameter * direction; }

  /// Parameter of the point nearest to p.
  double nearest(const Vector3d& p) const {
    const double length_squared = direction.squaredNorm();
    if (!(length_squared > 0)) return 0;
    return std::clamp((p - start).dot(direction) / length_squared, 0.0, 1.0);
  }
};

}  // namespace

LinkDistance link_distance(const Vector3d& a_start, const Vector3d& a_end, const Vector3d& b_start,
                           const Vector3d& b_end) {
  const Segment a(a_start, a_end);
  const Segment b(b_start, b_end);
  LinkDistance best;
  best.distance = std::numeric_limits<double>::infinity();
  const auto consider = [&](double s, double t) {
    const Vector3d on_first = a.at(s), on_second = b.at(t);
    const double distance = (on_second - on_first).norm();
    if (!(distance < best.distance)) return;
    best = {.distance = distance, .s = s, .t = t, .on_first = on_first, .on_second = on_second};
  };
  consider(0, b.nearest(a_start));
  consider(1, b.nearest(a_end));
  consider(a.nearest(b_start), 0);
  consider(a.nearest(b_end), 1);

  const Vector3d perpendicular = a.direction.cross(b.direction);
  const double size = perpendicular.squaredNorm();
  if (size > 0) {
    const Vector3d between = b_start - a_start;
    const double s = between.cross(b.direction).dot(perpendicular) / size;
    if (s > 0 && s < 1) consider(s, b.nearest(a.at(s)));
  }
  if (best.distance > 0) best.normal = (best.on_second - best.on_first) / best.distance;
  return best;
}

}  // namespace bqsa::harness
