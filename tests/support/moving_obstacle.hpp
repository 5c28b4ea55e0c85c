/// @file
/// Where a moving obstacle is between two ticks, for dense sampling. By quaternions, so that it
/// shares nothing with the rotation vectors of what it checks.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "bqsa/problem.hpp"

namespace bqsa::test_support {

/// The obstacle at a time counted in ticks, from 0 to the last one; beyond it stays where it is.
inline Ellipsoid shape_at(const Obstacle& obstacle, double time) {
  if (!obstacle.moves()) return obstacle.shape;
  const int last = static_cast<int>(obstacle.motion.size()) - 1;
  const int tick = std::clamp(static_cast<int>(std::floor(time)), 0, last);
  const Ellipsoid& from = obstacle.at(tick);
  const Ellipsoid& to = obstacle.at(std::min(tick + 1, last));
  const double s = time - tick;
  const Eigen::Quaterniond turned =
      Eigen::Quaterniond(from.rotation()).slerp(s, Eigen::Quaterniond(to.rotation())).normalized();
  return {(1 - s) * from.center() + s * to.center(), from.semi_axes(), turned.toRotationMatrix()};
}

}  // namespace bqsa::test_support
