/// @file
/// Reference for the segment test in 113-bit arithmetic. Shares no code with src/bqsa: it works
/// from centre, semi-axes and rotation, and decides by geometry in the unit ball instead of by
/// polar forms.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "bqsa/geometry/ellipsoid.hpp"

namespace bqsa::test_support {

__extension__ typedef __float128 Quad;  // the alias form does not silence -Wpedantic

/// All dimensionless, in the metric in which the ellipsoid is the unit ball.
struct ExactSegmentTest {
  Quad start_level;  ///< |u1|² - 1
  Quad end_level;    ///< |u2|² - 1
  Quad product;      ///< u1·u2 - 1
  Quad length2;      ///< |u2 - u1|²
  Quad area2;        ///< |u1 x u2|²; area2 / length2 is the squared distance of the line from 0
  Quad towards;      ///< -u1·(u2 - u1): positive if the link starts towards the centre
  Quad beyond;       ///< u2·(u2 - u1): positive if the link ends away from the centre

  /// (product)² - start_level end_level = length2 - area2 by Lagrange's identity.
  Quad discriminant() const { return length2 - area2; }

  /// Number of the paper's category, 1 to 5, touching being a hit.
  int category() const {
    const bool start_inside = start_level <= 0;
    const bool end_inside = end_level <= 0;
    if (start_inside && end_inside) return 5;
    if (start_inside || end_inside) return 4;
    const bool nearest_is_between = towards > 0 && beyond > 0;
    if (nearest_is_between && area2 <= length2) return 3;
    return area2 >= length2 ? 1 : 2;
  }
};

template <int Dim>
ExactSegmentTest exact_segment_test(const EllipsoidN<Dim>& ellipsoid,
                                    const Eigen::Matrix<double, Dim, 1>& p1,
                                    const Eigen::Matrix<double, Dim, 1>& p2) {
  Quad u1[3] = {0, 0, 0}, u2[3] = {0, 0, 0}, v[3] = {0, 0, 0};
  for (int axis = 0; axis < Dim; ++axis) {
    for (int k = 0; k < Dim; ++k) {
      const Quad r = ellipsoid.rotation()(k, axis);
      const Quad c = ellipsoid.center()(k);
      u1[axis] += r * (Quad(p1(k)) - c);
      u2[axis] += r * (Quad(p2(k)) - c);
      v[axis] += r * (Quad(p2(k)) - Quad(p1(k)));
    }
    const Quad a = ellipsoid.semi_axes()(axis);
    u1[axis] /= a;
    u2[axis] /= a;
    v[axis] /= a;
  }
  ExactSegmentTest exact{-1, -1, -1, 0, 0, 0, 0};
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3;
    const Quad cross = u1[k] * v[l] - u1[l] * v[k];  // u1 x u2 = u1 x v
    exact.start_level += u1[k] * u1[k];
    exact.end_level += u2[k] * u2[k];
    exact.product += u1[k] * u2[k];
    exact.length2 += v[k] * v[k];
    exact.area2 += cross * cross;
    exact.towards -= u1[k] * v[k];
    exact.beyond += u2[k] * v[k];
  }
  return exact;
}

}  // namespace bqsa::test_support
