#include "harness/judge/exact_solid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bqsa/envelope/overloaded.hpp"
#include "harness/judge/closest_point_search.hpp"
#include "harness/judge/segment_pair.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;

/// A unit vector across both, or across the longer one if they are parallel.
Vector3d across(const Vector3d& u, const Vector3d& v) {
  const Vector3d common = u.cross(v);
  if (common.norm() > 0) return common.normalized();
  const Vector3d& longer = u.norm() > v.norm() ? u : v;
  return longer.unitOrthogonal();
}

/// The distance of the two axes, less the radius.
SolidClearance clearance_of(const Capsule& capsule, const Vector3d& a, const Vector3d& b) {
  const PointPair nearest = nearest_points(a, b, capsule.a, capsule.b);
  const Vector3d apart = nearest.on_first - nearest.on_second;
  // Axes that meet have no direction between them; one across both serves.
  const Vector3d common = across(b - a, capsule.b - capsule.a);
  SolidClearance best{.clearance = -std::numeric_limits<double>::infinity()};
  for (const Vector3d& n : {apart, common, Vector3d(-common)}) {
    if (!(n.norm() > 0)) continue;
    const Vector3d unit = n.normalized();
    const double highest = std::max(unit.dot(capsule.a), unit.dot(capsule.b)) + capsule.radius;
    const double clearance = std::min(unit.dot(a), unit.dot(b)) - highest;
    if (clearance > best.clearance) best = {clearance, unit, highest};
  }
  best.clearance = apart.norm() - capsule.radius;
  return best;
}

/// A cylinder around the z axis, from -half_length to half_length.
struct Upright {
  double half_length;
  double radius;

  double support(const Vector3d& n) const {
    return half_length * std::abs(n.z()) + radius * n.head<2>().norm();
  }

  /// At most 1 inside: the factor by which the cylinder has to grow about its centre to reach x.
  double growth(const Vector3d& x) const {
    return std::max(std::abs(x.z()) / half_length, x.head<2>().norm() / radius);
  }

  Nearest nearest(const Vector3d& x) const {
    const double from_axis = x.head<2>().norm();
    const double beyond_side = std::max(from_axis - radius, 0.0);
    const double beyond_end = std::max(std::abs(x.z()) - half_length, 0.0);
    Vector3d outward = Vector3d::Zero();
    if (from_axis > 0) outward.head<2>() = x.head<2>() / from_axis;
    const Vector3d upward(0, 0, x.z() < 0 ? -1 : 1);
    const Vector3d offset = beyond_side * outward + beyond_end * upward;
    const double distance = std::hypot(beyond_side, beyond_end);
    if (distance > 0) return {offset, offset / distance, distance};
    const bool at_side = from_axis - radius > std::abs(x.z()) - half_length;
    return {offset, at_side ? outward : upward, 0};
  }
};

/// Parameters in [0, 1] among which the point p + t d of least growth is: the ends, where it is
/// nearest to the middle plane or to the axis, and where side and end of the cylinder grow alike.
std::array<double, 6> parameters_of_least_growth(const Upright& cylinder, const Vector3d& p,
                                                 const Vector3d& d) {
  const double across_squared = d.head<2>().squaredNorm();
  const double r = 1 / (cylinder.radius * cylinder.radius);
  const double h = 1 / (cylinder.half_length * cylinder.half_length);
  // side² - end² = a t² + 2 b t + c
  const double a = r * across_squared - h * d.z() * d.z();
  const double b = r * p.head<2>().dot(d.head<2>()) - h * p.z() * d.z();
  const double c = r * p.head<2>().squaredNorm() - h * p.z() * p.z();
  const double root = std::sqrt(std::max(b * b - a * c, 0.0));
  const double far = -b - std::copysign(root, b);
  std::array<double, 6> parameters = {
      0, 1, -p.z() / d.z(), -p.head<2>().dot(d.head<2>()) / across_squared, far / a, c / far};
  for (double& t : parameters) t = std::isfinite(t) ? std::clamp(t, 0.0, 1.0) : 0;
  return parameters;
}

/// Where the segment meets the cylinder, it leaves it across the plane that it would touch last if
/// the cylinder shrank about its centre, turned about the segment as long as that makes the way
/// shorter; ends and side are tried too.
SolidClearance depth(const Upright& cylinder, const Vector3d& p, const Vector3d& q,
                     const Vector3d& deepest) {
  const Vector3d d = q - p;
  Vector3d outward = Vector3d::UnitX();
  if (deepest.head<2>().norm() > 0) outward << deepest.head<2>().normalized(), 0;
  const Vector3d upward(0, 0, deepest.z() < 0 ? -1 : 1);
  // Gradients of the growth of side and end; of their mixtures one is perpendicular to the segment.
  const Vector3d side = outward / cylinder.radius, end = upward / cylinder.half_length;
  const double share = std::clamp(d.dot(end) / (d.dot(end) - d.dot(side)), 0.0, 1.0);
  const Vector3d common = across(Vector3d::UnitZ(), d);
  SolidClearance best{.clearance = -std::numeric_limits<double>::infinity()};
  const auto offer = [&](const Vector3d& normal) {
    const Vector3d unit = normal.normalized();
    const double highest = cylinder.support(unit);
    const double clearance = std::min(unit.dot(p), unit.dot(q)) - highest;
    if (!(clearance > best.clearance)) return false;  // nor the mixture of equal slopes
    best = {clearance, unit, highest};
    return true;
  };
  offer(share * side + (1 - share) * end);
  for (const Vector3d& n : {outward, upward, Vector3d(-upward), common, Vector3d(-common)}) {
    offer(n);
  }
  constexpr int kHalvings = 25;  // to a turn of 1e-8, which changes the depth by its square
  double turn = 0.25;
  for (int round = 0; round < kHalvings; ++round, turn /= 2) {
    const Vector3d sideways = d.normalized().cross(best.normal);
    const Vector3d n = best.normal;
    if (!offer(n + turn * sideways)) offer(n - turn * sideways);
  }
  best.clearance = std::min(best.clearance, 0.0);
  return best;
}

SolidClearance clearance_of(const Upright& cylinder, const Vector3d& p, const Vector3d& q) {
  const Vector3d d = q - p;
  double t = 0;
  for (const double other : parameters_of_least_growth(cylinder, p, d)) {
    if (cylinder.growth(p + other * d) < cylinder.growth(p + t * d)) t = other;
  }
  if (cylinder.growth(p + t * d) <= 1) return depth(cylinder, p, q, p + t * d);
  const ClosestPoint closest =
      closest_point(p, d, t, [&cylinder](const Vector3d& x) { return cylinder.nearest(x); });
  return {closest.distance, closest.normal, cylinder.support(closest.normal)};
}

/// As seen by the cylinder, in lengths of at most 1.
SolidClearance clearance_of(const Cylinder& cylinder, const Vector3d& a, const Vector3d& b) {
  const Vector3d center = 0.5 * (cylinder.a + cylinder.b);
  const Vector3d half_axis = 0.5 * (cylinder.b - cylinder.a);
  Eigen::Matrix3d frame;
  frame.col(2) = half_axis.normalized();
  frame.col(0) = frame.col(2).unitOrthogonal();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  const Vector3d p = frame.transpose() * (a - center);
  const Vector3d q = frame.transpose() * (b - center);
  const double size = std::max({p.lpNorm<Eigen::Infinity>(), q.lpNorm<Eigen::Infinity>(),
                                half_axis.norm(), cylinder.radius});
  SolidClearance result =
      clearance_of(Upright{half_axis.norm() / size, cylinder.radius / size}, p / size, q / size);
  result.clearance *= size;
  result.normal = frame * result.normal;
  result.offset = size * result.offset + result.normal.dot(center);
  return result;
}

SolidClearance clearance_of(const ExactPolytope& polytope, const Vector3d& a, const Vector3d& b) {
  return polytope.clearance(a, b);
}

}  // namespace

ExactSolid::ExactSolid(const Solid& solid)
    : shape_(std::visit(
          Overloaded{
              [](const Ball& ball) -> decltype(shape_) {
                return Capsule{ball.center, ball.center, ball.radius};
              },
              [](const Box& box) -> decltype(shape_) { return ExactPolytope(box); },
              [](const Cylinder& cylinder) -> decltype(shape_) { return cylinder; },
              [](const Capsule& capsule) -> decltype(shape_) { return capsule; },
              [](const ConvexHull& hull) -> decltype(shape_) { return ExactPolytope(hull); }},
          solid)) {}

SolidClearance ExactSolid::clearance(const Vector3d& a, const Vector3d& b) const {
  return std::visit([&](const auto& shape) { return clearance_of(shape, a, b); }, shape_);
}

}  // namespace bqsa::harness
