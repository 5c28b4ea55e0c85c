#include "bqsa/geometry/nearest_plane.hpp"

#include <algorithm>
#include <cmath>

namespace bqsa {
namespace {

constexpr int kMaxPlanes = 60;

/// Change of mu at which the search ends, relative to mu: the bound errs with its square.
constexpr double kConverged = 1e-7;

/// Change of mu that is rounding, relative to the least a_i² + mu.
constexpr double kRounding = 1e-14;

/// Difference of two planes' distances that is rounding, relative to the lengths in play.
constexpr double kSameDistance = 5e-16;

}  // namespace

template <int Dim>
NearestPlane<Dim> nearest_plane(const EllipsoidN<Dim>& ellipsoid,
                                const Eigen::Matrix<double, Dim, 1>& p1,
                                const Eigen::Matrix<double, Dim, 1>& p2, double enough) {
  using Vector = Eigen::Matrix<double, Dim, 1>;
  const Vector a_squared = ellipsoid.semi_axes().cwiseAbs2();
  const Vector x1 = ellipsoid.rotation().transpose() * (p1 - ellipsoid.center());
  const Vector x2 = ellipsoid.rotation().transpose() * (p2 - ellipsoid.center());
  const Vector d = x2 - x1;

  // Of planes whose distances differ by rounding the last has the best normal: errors of the normal
  // enter the distance squared, so that rounding would choose one that is off by 1e-8.
  const double same = kSameDistance * (std::max(x1.norm(), x2.norm()) + std::sqrt(a_squared.sum()));

  NearestPlane<Dim> best{Vector::UnitX(), -ellipsoid.semi_axes().minCoeff()};
  Vector best_normal = Vector::UnitX();
  double mu = 0, low = 0, high = std::numeric_limits<double>::infinity();
  while (best.planes < kMaxPlanes) {
    const Vector weight = (a_squared.array() + mu).inverse();
    const Vector weighted_d = weight.cwiseProduct(d);
    const double towards = -x1.dot(weighted_d);
    const double curvature = d.dot(weighted_d);
    const double t = !(towards > 0) ? 0 : towards < curvature ? towards / curvature : 1;
    Vector n = weight.cwiseProduct(x1 + t * d);
    // Of a thin shape, x1 + t d has lost digits; the vertex says that n is across the segment.
    const bool across = 0 < t && t < 1;
    if (across) n -= n.dot(d) / d.squaredNorm() * d;
    const double length = n.norm();
    if (!(length > 0)) break;  // the segment passes through the centre
    const double support_squared = n.cwiseAbs2().dot(a_squared);
    const double support = std::sqrt(support_squared);
    const double distance = (std::min(n.dot(x1), n.dot(x2)) - support) / length;
    if (best.planes == 0 || distance > best.distance - same) {
      best.distance = best.planes == 0 ? distance : std::max(best.distance, distance);
      best_normal = n / length;
      best.t = t;
    }
    ++best.planes;
    const bool meet = mu == 0 && support <= 1;
    if (meet || distance > enough) break;

    (support > 1 ? low : high) = mu;
    const double turn = across ? n.dot(weighted_d) : 0;  // of the vertex with mu
    const double slope = n.cwiseAbs2().cwiseProduct(a_squared).dot(weight) +
                         (turn != 0 ? mu * turn * turn / curvature : 0);  // -1/2 of the derivative
    double next = mu + support_squared * (support - 1) / slope;
    if (!(low <= next && next <= high)) next = std::isfinite(high) ? 0.5 * (low + high) : 2 * mu;
    const double change = std::abs(next - mu);
    if (change <= kConverged * mu || change <= kRounding * (a_squared.minCoeff() + mu)) break;
    mu = next;
  }
  best.normal = ellipsoid.rotation() * best_normal;
  return best;
}

template NearestPlane<2> nearest_plane<2>(const Ellipse&, const Eigen::Vector2d&,
                                          const Eigen::Vector2d&, double);
template NearestPlane<3> nearest_plane<3>(const Ellipsoid&, const Eigen::Vector3d&,
                                          const Eigen::Vector3d&, double);

}  // namespace bqsa
