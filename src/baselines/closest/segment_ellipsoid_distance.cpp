#include "baselines/closest/segment_ellipsoid_distance.hpp"

#include <algorithm>
#include <cmath>

namespace bqsa::baselines {
namespace {

using Vector = Eigen::Vector3d;

/// Closest points of an ellipsoid at the origin whose axes are the coordinate axes, for points
/// outside it.
class NearestPoint {
 public:
  explicit NearestPoint(const Vector& semi_axes)
      : semi_axes_(semi_axes), squares_(semi_axes.cwiseAbs2()) {}

  /// x minus its closest point n on the surface: n_i = a_i² x_i / (a_i² + m) with the multiplier m
  /// that solves |n_i / a_i| = 1. Newton on 1 / |n_i / a_i| - 1, which is concave in m, so that it
  /// climbs from the left without overshooting.
  Vector offset(const Vector& x) {
    const Vector scaled = semi_axes_.cwiseProduct(x).cwiseAbs2();
    // From where the last point left off, if that is not beyond the root.
    double m = std::max(start_of(x), 0.0);
    if (norm(scaled, multiplier_) >= 1) m = std::max(m, multiplier_);
    for (int k = 0; k < kMostSteps; ++k) {
      const Vector inverse = (squares_.array() + m).inverse();
      const Vector terms = scaled.cwiseProduct(inverse.cwiseAbs2());
      const double sum = terms.sum();
      const double length = std::sqrt(sum);
      const double step = sum * (length - 1) / terms.dot(inverse);
      if (!(step > 1e-16 * m)) break;
      m += step;
    }
    multiplier_ = m;
    return m * x.cwiseQuotient((squares_.array() + m).matrix());
  }

 private:
  static constexpr int kMostSteps = 60;

  /// No more than the multiplier: each |n_i / a_i| alone is at most 1.
  double start_of(const Vector& x) const {
    return (semi_axes_.cwiseProduct(x.cwiseAbs()) - squares_).maxCoeff();
  }

  double norm(const Vector& scaled, double m) const {
    return scaled.cwiseQuotient((squares_.array() + m).square().matrix()).sum();
  }

  Vector semi_axes_;
  Vector squares_;
  double multiplier_ = 0;
};

/// Parameter of the least distance, and the offset there. With g(t) = d·offset(p + t d), half the
/// derivative of the squared distance, which grows with t: regula falsi (Illinois) on its root.
double least(const Vector& p, const Vector& d, NearestPoint& nearest, Vector& offset) {
  constexpr int kMostSteps = 80;
  constexpr double kEnough = 4e-16;  // of |d| times the distance
  double low = 0;
  offset = nearest.offset(p);
  double g_low = d.dot(offset);
  if (g_low >= 0) return 0;
  double high = 1;
  offset = nearest.offset(p + d);
  double g_high = d.dot(offset);
  if (g_high <= 0) return 1;

  double t = 0.5;
  int side = 0;
  for (int k = 0; k < kMostSteps && high - low > 1e-16; ++k) {
    t = (low * g_high - high * g_low) / (g_high - g_low);
    // Where it creeps, the middle takes over.
    if (!(t > low && t < high) || k % 8 == 7) t = (low + high) / 2;
    offset = nearest.offset(p + t * d);
    const double g = d.dot(offset);
    if (std::abs(g) <= kEnough * d.norm() * offset.norm()) break;
    if (g < 0) {
      low = t;
      g_low = g;
      if (side < 0) g_high /= 2;
      side = -1;
    } else {
      high = t;
      g_high = g;
      if (side > 0) g_low /= 2;
      side = 1;
    }
  }
  return t;
}

}  // namespace

SegmentDistance segment_distance(const Vector& a, const Vector& b, const Ellipsoid& shape) {
  const Eigen::Matrix3d& R = shape.rotation();
  const Vector& semi_axes = shape.semi_axes();
  const Vector p = R.transpose() * (a - shape.center());
  const Vector d = R.transpose() * (b - a);

  const Vector u = p.cwiseQuotient(semi_axes);
  const Vector v = d.cwiseQuotient(semi_axes);
  const double vv = v.squaredNorm();
  const double deepest = vv > 0 ? std::clamp(-u.dot(v) / vv, 0.0, 1.0) : 0.0;

  SegmentDistance result;
  if ((u + deepest * v).squaredNorm() <= 1) {
    result.s = deepest;
    result.p_segment = a + deepest * (b - a);
    result.p_ellipsoid = result.p_segment;
    result.direction = R * (u + deepest * v).cwiseQuotient(semi_axes).stableNormalized();
    return result;
  }
  NearestPoint nearest(semi_axes);
  Vector offset;
  result.s = least(p, d, nearest, offset);
  result.distance = offset.norm();
  result.p_segment = a + result.s * (b - a);
  const Vector offset_W = R * offset;
  result.p_ellipsoid = result.p_segment - offset_W;
  result.direction = offset_W.stableNormalized();
  return result;
}

}  // namespace bqsa::baselines
