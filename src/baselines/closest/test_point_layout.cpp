#include "baselines/closest/test_point_layout.hpp"

#include <cmath>
#include <numbers>

namespace bqsa::baselines {

Eigen::Matrix3Xd unit_test_points(int dimension, int count) {
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  Eigen::Matrix3Xd points(3, count);
  for (int k = 0; k < count; ++k) {
    if (dimension == 2) {
      const double angle = 2 * std::numbers::pi * k / count;
      points.col(k) << std::cos(angle), std::sin(angle), 0;
    } else {
      const double z = 1 - (2.0 * k + 1) / count;
      const double radius = std::sqrt(1 - z * z);
      points.col(k) << radius * std::cos(k * golden_angle), radius * std::sin(k * golden_angle), z;
    }
  }
  return points;
}

}  // namespace bqsa::baselines
