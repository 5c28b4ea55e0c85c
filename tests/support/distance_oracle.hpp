/// @file
/// Slow, independent reference for segment-ellipsoid distances: bisection and golden section in
/// long double, sharing no code and no method with what it checks.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "bqsa/geometry/ellipsoid.hpp"

namespace bqsa::test_support {

using LongVector3 = Eigen::Matrix<long double, 3, 1>;

/// A solid ellipsoid and a segment, in the ellipsoid's own axes.
class DistanceOracle {
 public:
  DistanceOracle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Ellipsoid& ellipsoid)
      : semi_axes_(ellipsoid.semi_axes().cast<long double>()) {
    const Eigen::Matrix<long double, 3, 3> R = ellipsoid.rotation().cast<long double>();
    const LongVector3 c = ellipsoid.center().cast<long double>();
    p_ = R.transpose() * (a.cast<long double>() - c);
    d_ = R.transpose() * (b.cast<long double>() - a.cast<long double>());
  }

  /// Distance of the segment to the solid ellipsoid, 0 if they meet.
  long double distance() const {
    constexpr int kSamples = 48;
    int nearest = 0;
    long double least = distance_at(0);
    for (int k = 1; k <= kSamples; ++k) {
      const long double value = distance_at(static_cast<long double>(k) / kSamples);
      if (value < least) {
        least = value;
        nearest = k;
      }
    }
    long double low = std::max(0.0L, static_cast<long double>(nearest - 1) / kSamples);
    long double high = std::min(1.0L, static_cast<long double>(nearest + 1) / kSamples);
    const long double golden = (std::sqrt(5.0L) - 1) / 2;
    long double x = high - golden * (high - low), y = low + golden * (high - low);
    long double fx = distance_at(x), fy = distance_at(y);
    for (int k = 0; k < 90; ++k) {
      if (fx < fy) {
        high = y, y = x, fy = fx;
        fx = distance_at(x = high - golden * (high - low));
      } else {
        low = x, x = y, fx = fy;
        fy = distance_at(y = low + golden * (high - low));
      }
      least = std::min({least, fx, fy});
    }
    return least;
  }

  /// Least value of |diag(1/a) R^T (x - c)| over the segment: at most 1 exactly if they meet.
  long double least_norm() const {
    const LongVector3 u = p_.cwiseQuotient(semi_axes_), v = d_.cwiseQuotient(semi_axes_);
    const long double vv = v.squaredNorm();
    const long double t = vv > 0 ? std::clamp(-u.dot(v) / vv, 0.0L, 1.0L) : 0.0L;
    return (u + t * v).norm();
  }

 private:
  /// Distance of the point at parameter t, by bisection on the secular equation of the nearest
  /// point.
  long double distance_at(long double t) const {
    const LongVector3 x = p_ + t * d_;
    if (x.cwiseQuotient(semi_axes_).squaredNorm() <= 1) return 0;
    const LongVector3 squares = semi_axes_.cwiseAbs2();
    const LongVector3 w = semi_axes_.cwiseProduct(x).cwiseAbs();
    long double low = 0, high = w.norm();
    for (int k = 0; k < 200; ++k) {
      // The root may be smaller than `high` by many orders of magnitude: halve the exponent first.
      const long double middle =
          low > 0 && high > 4 * low ? std::sqrt(low * high) : (low + high) / 2;
      if (middle <= low || middle >= high) break;
      const long double sum = w.cwiseQuotient((squares.array() + middle).matrix()).squaredNorm();
      (sum > 1 ? low : high) = middle;
    }
    const long double l = (low + high) / 2;
    return (l * x.cwiseQuotient((squares.array() + l).matrix())).norm();
  }

  LongVector3 semi_axes_, p_, d_;
};

}  // namespace bqsa::test_support
