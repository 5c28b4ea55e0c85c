/// @file
/// What the paper's opponent asks of a pair of link and obstacle. Templated on the scalar, so that
/// what is counted is what is timed.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>

#include "bqsa/geometry/segment_test.hpp"
#include "harness/measuring/unit_ball_map.hpp"

namespace bqsa::harness {

/// The least squared distance of any point of `from` to any of `to`, by trying them all: Dim
/// multiplications a pair of points (paper, section 3.4). Coordinate by coordinate, since Eigen's own
/// expressions use vector instructions whatever the compiler is told.
template <typename Scalar, int Dim>
Scalar least_squared_distance(std::span<const Eigen::Matrix<Scalar, Dim, 1>> from,
                              std::span<const Eigen::Matrix<Scalar, Dim, 1>> to) {
  Scalar least(std::numeric_limits<double>::max());
  for (const Eigen::Matrix<Scalar, Dim, 1>& p : from) {
    for (const Eigen::Matrix<Scalar, Dim, 1>& q : to) {
      const Scalar d_x = q(0) - p(0);
      const Scalar d_y = q(1) - p(1);
      Scalar squared = d_x * d_x + d_y * d_y;
      if constexpr (Dim == 3) {
        const Scalar d_z = q(2) - p(2);
        squared += d_z * d_z;
      }
      least = squared < least ? squared : least;
    }
  }
  return least;
}

/// Whether a point is in the solid ellipse or ellipsoid: 5 or 9 multiplications.
template <typename Scalar, int Dim>
bool is_inside(const UnitBallMap<Scalar, Dim>& obstacle,
               const Eigen::Matrix<Scalar, Dim, 1>& point) {
  const Eigen::Matrix<Scalar, Dim, 1> u = unit_point(obstacle.unit_map, obstacle.center, point);
  return inner(u, u) <= Scalar(1);
}

}  // namespace bqsa::harness
