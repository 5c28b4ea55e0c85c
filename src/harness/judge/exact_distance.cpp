#include "harness/judge/exact_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "harness/judge/closest_point_search.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;

/// Lengths are scaled by the problem's size, so coordinates and semi-axes are at most 1. A
/// semi-axis below this is beyond what double coordinates resolve; the floor keeps its square from
/// underflow.
constexpr double kThinnest = 1e-30;

/// The nearest point of the ellipsoid with its axes along the coordinates to an outside point.
/// Solves the secular equation sum (a_i p_i / (a_i² + l))² = 1 for l >= 0; the nearest point is
/// a_i² p_i / (a_i² + l). Newton's method on 1 / sqrt(sum) = 1, which is concave and increasing in
/// l (and linear for a sphere), rises to the root without overshooting; the bracket guards
/// rounding.
Nearest nearest(const Vector3d& p, const Vector3d& a) {
  const Vector3d squares = a.cwiseProduct(a);
  const Vector3d w = a.cwiseProduct(p).cwiseAbs();
  double low = std::max(0.0, (w - squares).maxCoeff());
  double high = std::max(low, w.norm() - squares.minCoeff());
  double l = low;
  for (int k = 0; k < kMaxSearchSteps && low < high; ++k) {
    const Vector3d inverse = (squares.array() + l).inverse();
    const Vector3d terms = w.cwiseProduct(inverse).cwiseAbs2();
    const double sum = terms.sum();
    const double excess = std::sqrt(sum) - 1;
    (excess > 0 ? low : high) = l;
    double next = l + sum / terms.dot(inverse) * excess;
    if (!(next >= low && next <= high)) next = low + (high - low) / 2;
    const bool settled = std::abs(next - l) <= std::numeric_limits<double>::epsilon() * l;
    l = next;
    if (settled) break;
  }
  const Vector3d gradient = p.cwiseQuotient(Vector3d(squares.array() + l));
  const Vector3d offset = l * gradient;
  return {offset, gradient.stableNormalized(), offset.norm()};
}

/// Parameter of the segment's deepest point in the ellipsoid's own metric: the vertex of
/// |(p + t d) / a|², clamped to [0, 1]. The second round removes the first one's rounding error.
double vertex(const Vector3d& p, const Vector3d& d, const Vector3d& a) {
  const Vector3d v = d.cwiseQuotient(a);
  const double vv = v.squaredNorm();
  if (!(vv > 0)) return 0;
  double t = 0;
  for (int round = 0; round < 2; ++round) {
    const Vector3d u = (p + t * d).cwiseQuotient(a);
    t = std::clamp(t - u.dot(v) / vv, 0.0, 1.0);
  }
  return t;
}

/// Shortest of the translations that carry the segment out of the ellipsoid across the supporting
/// planes with a few normals: the gradient at the vertex point, for which the translation is
/// m (1 - m) / |Q x| and optimal to first order, and the six axis directions, which also serve when
/// that gradient vanishes at the centre.
void separate(const Vector3d& p, const Vector3d& q, const Vector3d& at, const Vector3d& a,
              SegmentDistance& result) {
  const Vector3d gradient = at.cwiseQuotient(a).cwiseQuotient(a).stableNormalized();
  const std::array<Vector3d, 7> normals = {
      gradient,           Vector3d::UnitX(), -Vector3d::UnitX(), Vector3d::UnitY(),
      -Vector3d::UnitY(), Vector3d::UnitZ(), -Vector3d::UnitZ()};
  result.depth = std::numeric_limits<double>::infinity();
  for (const Vector3d& n : normals) {
    const double support = a.cwiseProduct(n).norm();
    if (!(support > 0)) continue;
    const double depth = support - std::min(n.dot(p), n.dot(q));
    if (depth >= result.depth) continue;
    result.depth = depth;
    result.normal = n;
    result.on_ellipsoid = a.cwiseProduct(a).cwiseProduct(n) / support;
  }
  result.depth = std::max(result.depth, 0.0);
}

}  // namespace

SegmentDistance exact_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                               const Ellipsoid& ellipsoid) {
  const Eigen::Matrix3d& R = ellipsoid.rotation();
  Vector3d p = R.transpose() * (a - ellipsoid.center());
  Vector3d q = R.transpose() * (b - ellipsoid.center());
  const double size = std::max(
      {p.lpNorm<Eigen::Infinity>(), q.lpNorm<Eigen::Infinity>(), ellipsoid.semi_axes().maxCoeff()});
  p /= size;
  q /= size;
  const Vector3d axes = (ellipsoid.semi_axes() / size).cwiseMax(kThinnest);
  const Vector3d d = q - p;

  SegmentDistance result;
  result.t = vertex(p, d, axes);
  result.on_segment = p + result.t * d;
  if (result.on_segment.cwiseQuotient(axes).squaredNorm() <= 1) {
    separate(p, q, result.on_segment, axes, result);
  } else {
    const ClosestPoint closest =
        closest_point(p, d, result.t, [&axes](const Vector3d& x) { return nearest(x, axes); });
    result.t = closest.t;
    result.distance = closest.distance;
    result.normal = closest.normal;
    result.on_segment = p + closest.t * d;
    result.on_ellipsoid = result.on_segment - closest.offset;
  }
  result.distance *= size;
  result.depth *= size;
  result.on_segment = ellipsoid.center() + R * (size * result.on_segment);
  result.on_ellipsoid = ellipsoid.center() + R * (size * result.on_ellipsoid);
  result.normal = R * result.normal;
  return result;
}

}  // namespace bqsa::harness
