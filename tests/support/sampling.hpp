/// @file
/// Seeded random shapes for the tests.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "bqsa/geometry/ellipsoid.hpp"

namespace bqsa::test_support {

using Generator = std::mt19937_64;

inline double uniform(Generator& generator, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(generator);
}

/// Between low and high with a uniform logarithm.
inline double log_uniform(Generator& generator, double low, double high) {
  return std::exp(uniform(generator, std::log(low), std::log(high)));
}

inline double normal(Generator& generator) { return std::normal_distribution<double>()(generator); }

/// Components in [-half_width, half_width].
template <int Dim>
Eigen::Matrix<double, Dim, 1> random_vector(Generator& generator, double half_width) {
  return Eigen::Matrix<double, Dim, 1>::NullaryExpr(
      [&](Eigen::Index) { return uniform(generator, -half_width, half_width); });
}

/// Uniform on the unit sphere.
template <int Dim>
Eigen::Matrix<double, Dim, 1> random_direction(Generator& generator) {
  return Eigen::Matrix<double, Dim, 1>::NullaryExpr([&](Eigen::Index) { return normal(generator); })
      .normalized();
}

template <int Dim>
Eigen::Matrix<double, Dim, Dim> random_rotation(Generator& generator) {
  if constexpr (Dim == 2) {
    const double angle = uniform(generator, -std::numbers::pi, std::numbers::pi);
    return Eigen::Rotation2Dd(angle).toRotationMatrix();
  } else {
    return Eigen::Quaterniond(random_direction<4>(generator)).toRotationMatrix();
  }
}

/// Semi-axes between low and high [m], each with a uniform logarithm.
template <int Dim>
EllipsoidN<Dim> random_ellipsoid(Generator& generator, double low, double high,
                                 double center_half_width = 1) {
  const Eigen::Matrix<double, Dim, 1> semi_axes = Eigen::Matrix<double, Dim, 1>::NullaryExpr(
      [&](Eigen::Index) { return log_uniform(generator, low, high); });
  return {random_vector<Dim>(generator, center_half_width), semi_axes,
          random_rotation<Dim>(generator)};
}

/// The surface point c + R diag(a) s of an ellipsoid for a unit vector s.
template <int Dim>
Eigen::Matrix<double, Dim, 1> surface_point(const EllipsoidN<Dim>& ellipsoid,
                                            const Eigen::Matrix<double, Dim, 1>& s) {
  return ellipsoid.center() + ellipsoid.rotation() * ellipsoid.semi_axes().cwiseProduct(s);
}

}  // namespace bqsa::test_support
