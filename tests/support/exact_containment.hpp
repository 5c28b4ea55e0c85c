/// @file Whether a point is in an ellipsoid, decided without rounding. Shares no code with
///   src/bqsa: it works from centre, semi-axes and rotation.
#pragma once

#include <Eigen/Core>
#include <boost/multiprecision/cpp_int.hpp>

#include "bqsa/geometry/ellipsoid.hpp"
#include "support/exact_segment_test.hpp"

namespace bqsa::test_support {

using Rational = boost::multiprecision::cpp_rational;

/// |diag(1/a) Rᵀ (p - c)|² - 1, in a number type of any precision; `p` has Dim components of it.
template <typename Number, int Dim, typename Point>
Number exact_level(const EllipsoidN<Dim>& ellipsoid, const Point& p) {
  Number level = -1;
  for (int axis = 0; axis < Dim; ++axis) {
    Number along = 0;
    for (int k = 0; k < Dim; ++k) {
      along +=
          Number(ellipsoid.rotation()(k, axis)) * (Number(p[k]) - Number(ellipsoid.center()(k)));
    }
    along /= Number(ellipsoid.semi_axes()(axis));
    level += along * along;
  }
  return level;
}

}  // namespace bqsa::test_support
