/// @file
/// Segments and ellipsoids of all sorts, and close to all that is degenerate.
#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "bqsa/geometry/ellipsoid.hpp"
#include "support/sampling.hpp"

namespace bqsa::test_support {

struct SegmentCase {
  Eigen::Vector3d a, b;
  Ellipsoid shape;

  /// The largest length in play [m].
  double size() const {
    const Eigen::Vector3d& c = shape.center();
    return std::max({c.norm(), (a - c).norm(), (b - c).norm(), shape.semi_axes().maxCoeff()});
  }
};

inline Eigen::Vector3d outward_normal(const Ellipsoid& shape, const Eigen::Vector3d& q) {
  return (shape.quadratic_form() * (q - shape.center())).normalized();
}

/// Eggs, then needles and sheets of axis ratio up to 1e5.
inline Ellipsoid random_shape(Generator& generator, int trial) {
  if (trial % 2 == 0) return random_ellipsoid<3>(generator, 0.1, 0.5);
  if (trial % 4 == 1) return random_ellipsoid<3>(generator, 1e-5, 1);
  const double thin = log_uniform(generator, 1e-5, 1e-3);
  Eigen::Vector3d semi_axes(1, 1, thin);
  if (trial % 8 == 3) semi_axes << thin, 0.7 * thin, 1;
  return {random_vector<3>(generator, 1), semi_axes, random_rotation<3>(generator)};
}

/// One of eight families, the last six degenerate or close to it.
inline SegmentCase random_segment_case(Generator& generator, int trial) {
  const Ellipsoid shape = random_shape(generator, trial / 8);
  const Eigen::Vector3d a = random_vector<3>(generator, 2);
  const Eigen::Vector3d q = surface_point<3>(shape, random_direction<3>(generator));
  const Eigen::Vector3d n = outward_normal(shape, q);
  const Eigen::Vector3d along = n.cross(random_direction<3>(generator)).normalized();
  const double height = log_uniform(generator, 1e-12, 1e-1);
  switch (trial % 8) {
    case 0:
      return {a, random_vector<3>(generator, 2), shape};
    case 1:
      return {a, a + 0.5 * random_direction<3>(generator), shape};
    case 2:
      return {a, a, shape};  // zero length
    case 3:
      return {q + height * n, q + height * n, shape};  // the same, close
    case 4:
      return {q + height * n - along, q + height * n + 0.3 * along, shape};  // tangent
    case 5:
      return {q + height * n, q + n + along, shape};  // leaves the surface
    case 6:
      return {a, q + height * n, shape};
    default: {  // along an axis of the shape
      const Eigen::Vector3d axis = shape.rotation().col(trial / 8 % 3);
      return {a, a + uniform(generator, -2, 2) * axis, shape};
    }
  }
}

}  // namespace bqsa::test_support
