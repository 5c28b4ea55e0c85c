/// @file
/// What a test of points or links needs to know of an obstacle.
#pragma once

#include <Eigen/Core>

#include "bqsa/geometry/ellipsoid.hpp"

namespace bqsa::harness {

/// p -> unit_map (p - center) takes the solid ellipse or ellipsoid to the unit disk or ball.
template <typename Scalar, int Dim>
struct UnitBallMap {
  Eigen::Matrix<Scalar, Dim, Dim> unit_map;
  Eigen::Matrix<Scalar, Dim, 1> center;
};

/// @param shape  for Dim = 2 an embedded ellipse
template <int Dim>
UnitBallMap<double, Dim> unit_ball_map(const Ellipsoid& shape) {
  if constexpr (Dim == 2) {
    const Ellipse ellipse = planar_section(shape);
    return {ellipse.unit_map(), ellipse.center()};
  } else {
    return {shape.unit_map(), shape.center()};
  }
}

}  // namespace bqsa::harness
