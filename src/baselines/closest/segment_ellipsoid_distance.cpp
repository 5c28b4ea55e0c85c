#include "baselines/closest/segment_ellipsoid_distance.hpp"

#include <cmath>
#include <limits>

namespace bqsa::baselines {
namespace {

using Eigen::Array3d;
using Eigen::Vector3d;

/// What the search may leave of the distance, as part of the coordinates.
constexpr double kRounding = 1e-16;
constexpr int kMaxSteps = 100;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The segment p + t d and the squared semi-axes, in the ellipsoid's axes.
struct Dual {
  Array3d p, d;
  Array3d squares;

  /// What belongs to one multiplier l.
  struct Point {
    Array3d w;  ///< 1 / (a_i² + l)
    double t;   ///< the minimising t
    bool free;  ///< whether t lies between the ends
    Array3d x;  ///< p + t d

    /// Outward normal of the surface at A m, the point on it that belongs to l.
    Array3d normal() const { return w * x; }
  };

  Point at(double l) const {
    Point point;
    point.w = 1 / (squares + l);
    const Array3d weighted = point.w * d;
    const double along = -(weighted * p).sum();
    const double whole = (weighted * d).sum();  // 0 only without length, and then `along` is 0 too
    point.free = along > 0 && along < whole;
    point.t = point.free ? along / whole : (along > 0 ? 1 : 0);
    point.x = p + point.t * d;
    return point;
  }

  /// S(l) of the header.
  double secular(const Point& point) const { return (squares * point.normal().square()).sum(); }

  /// -S'(l) / 2. A free t moves with l, which adds the second term.
  double secular_slope(const Point& point, double l) const {
    const Array3d xw = point.normal();
    double slope = (squares * xw.square() * point.w).sum();
    if (point.free) {
      const double turn = (point.w * xw * d).sum();
      slope += l * turn * turn / (point.w * d.square()).sum();
    }
    return slope;
  }
};

/// Some unit normal of the segment where the level has none, at the ellipsoid's centre: that part of
/// the shortest axis that is across the segment, or failing that of another axis.
Vector3d normal_at_center(const Vector3d& d, const Array3d& squares) {
  int shortest;
  squares.minCoeff(&shortest);
  if (d.isZero(0)) return Vector3d::Unit(shortest);
  const Vector3d along = d.stableNormalized();
  int axis = shortest;
  if (std::abs(along(axis)) > 0.9) axis = (axis + 1) % 3;
  return (Vector3d::Unit(axis) - along(axis) * along).normalized();
}

}  // namespace

SegmentDistance segment_distance(const Vector3d& a, const Vector3d& b, const Ellipsoid& shape) {
  const Eigen::Matrix3d& R = shape.rotation();
  const Dual dual{.p = (R.transpose() * (a - shape.center())).array(),
                  .d = (R.transpose() * (b - a)).array(),
                  .squares = shape.semi_axes().array().square()};

  double l = 0;
  Dual::Point point = dual.at(0);
  double secular = dual.secular(point);
  const bool meet = secular <= 1;
  if (!meet) {
    const double thinnest = dual.squares.minCoeff();
    double low = 0;
    double high = kInfinity;
    const double size_squared = dual.p.square().sum() + dual.d.square().sum();
    for (int step = 0; step < kMaxSteps; ++step) {
      const double excess = std::sqrt(secular) - 1;  // S^(-1/2) = 1 is wanted
      const double change = excess * secular / dual.secular_slope(point, l);
      const double newton = l + change;
      // Newton's next error is at most change² / (l + a_min²), and moves the surface by that times |m|.
      const double next_error = change * change / (newton + thinnest);
      const bool last = next_error * next_error * point.normal().square().sum() <=
                            kRounding * kRounding * size_squared ||
                        newton == l;
      (excess > 0 ? low : high) = l;
      const bool astray = !(newton > low && newton < high) && high < kInfinity;
      l = astray && !last ? 0.5 * (low + high) : newton;
      point = dual.at(l);
      if (last) break;
      secular = dual.secular(point);
    }
  }

  SegmentDistance result;
  result.s = point.t;
  result.p_segment = point.t == 1 ? b : Vector3d(a + point.t * (b - a));
  Vector3d m = point.normal();
  const Vector3d on_surface = dual.squares * m.array();
  if (point.free) {
    // Across the segment by construction; to rounding too, though x be small against p and w large.
    m -= m.dot(dual.d.matrix()) / dual.d.square().sum() * dual.d.matrix();
  }
  const double length = m.norm();
  if (length > 0) {
    result.direction = R * (m / length);
  } else {
    result.direction = R * normal_at_center(dual.d, dual.squares);
  }
  result.distance = l * length;
  if (meet) {
    result.p_ellipsoid = result.p_segment;
  } else {
    result.p_ellipsoid = shape.center() + R * on_surface;
  }
  return result;
}

}  // namespace bqsa::baselines
