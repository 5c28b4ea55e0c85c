/// @file
/// Families of segment-ellipsoid pairs, ordinary and degenerate, for the accuracy of the segment
/// test.
#pragma once

#include <string>

#include "bqsa/geometry/ellipsoid.hpp"
#include "support/sampling.hpp"

namespace bqsa::test_support {

enum class Family {
  kRandom,
  kVertical,
  kNearVertical,
  kHorizontal,
  kZeroLength,
  kContained,
  kFar,
  kNeedle,
  kSheet,
  kMillimetresToKilometres,
  kTangent,
  kEndOnSurface,
};

template <int Dim>
struct Pair {
  EllipsoidN<Dim> ellipsoid;
  Eigen::Matrix<double, Dim, 1> p1, p2;
};

/// Semi-axes [m] of a family's ellipsoids before scaling.
template <int Dim>
Eigen::Matrix<double, Dim, 1> family_semi_axes(Family family, Generator& generator) {
  using Vector = Eigen::Matrix<double, Dim, 1>;
  constexpr double kAxisRatio = 1e5;
  Vector axes = Vector::NullaryExpr([&](Eigen::Index) { return log_uniform(generator, 0.02, 2); });
  if (family == Family::kNeedle) axes.template tail<Dim - 1>() /= kAxisRatio;
  if (family == Family::kSheet) axes(0) /= kAxisRatio;
  return axes;
}

/// A link aimed at a random point in or around the ellipsoid, then bent to what the family is
/// about.
template <int Dim>
Pair<Dim> make_pair(Family family, Generator& generator) {
  using Vector = Eigen::Matrix<double, Dim, 1>;
  const double scale =
      family == Family::kMillimetresToKilometres ? log_uniform(generator, 1e-3, 1e3) : 1.0;
  const EllipsoidN<Dim> ellipsoid(scale * random_vector<Dim>(generator, 1),
                                  scale * family_semi_axes<Dim>(family, generator),
                                  random_rotation<Dim>(generator));
  const Vector s = random_direction<Dim>(generator);
  const Vector target = surface_point<Dim>(ellipsoid, s * uniform(generator, 0, 1.5));
  Vector direction = random_direction<Dim>(generator);
  double before = scale * uniform(generator, -0.5, 2), after = scale * uniform(generator, -0.5, 2);

  switch (family) {
    case Family::kRandom:
    case Family::kNeedle:
    case Family::kSheet:
    case Family::kMillimetresToKilometres:
      break;
    case Family::kVertical:
      direction = Vector::Unit(Dim - 1);
      break;
    case Family::kNearVertical:
      direction = Vector::Unit(Dim - 1) + 1e-12 * Vector::Unit(0);
      break;
    case Family::kHorizontal:
      direction = Vector::Unit(0);
      break;
    case Family::kZeroLength:
      return {ellipsoid, target, target};
    case Family::kContained:
      return {ellipsoid, surface_point<Dim>(ellipsoid, s * uniform(generator, 0, 0.999)),
              surface_point<Dim>(ellipsoid,
                                 random_direction<Dim>(generator) * uniform(generator, 0, 0.999))};
    case Family::kFar:
      before = log_uniform(generator, 10, 1000);
      after = uniform(generator, -0.5, 2) * before;
      break;
    case Family::kTangent: {
      // Through a surface point moved by a few units in the last place, at right angles to the
      // normal.
      const double few_ulps = 0x1p-52 * static_cast<int>(uniform(generator, -8, 9));
      const Vector touch = surface_point<Dim>(ellipsoid, s * (1 + few_ulps));
      const Vector normal =
          (ellipsoid.quadratic_form() * (touch - ellipsoid.center())).normalized();
      direction = (direction - normal * normal.dot(direction)).normalized();
      return {ellipsoid, touch - log_uniform(generator, 1e-3, 2) * direction,
              touch + log_uniform(generator, 1e-3, 2) * direction};
    }
    case Family::kEndOnSurface: {
      const double few_ulps = 0x1p-52 * static_cast<int>(uniform(generator, -8, 9));
      const Vector outwards = ellipsoid.center() + 2 * (target - ellipsoid.center());
      return {ellipsoid, surface_point<Dim>(ellipsoid, s * (1 + few_ulps)), outwards};
    }
  }
  return {ellipsoid, target - before * direction, target + after * direction};
}

inline std::string name_of(Family family) {
  switch (family) {
    case Family::kRandom:
      return "Random";
    case Family::kVertical:
      return "Vertical";
    case Family::kNearVertical:
      return "NearVertical";
    case Family::kHorizontal:
      return "Horizontal";
    case Family::kZeroLength:
      return "ZeroLength";
    case Family::kContained:
      return "Contained";
    case Family::kFar:
      return "Far";
    case Family::kNeedle:
      return "Needle";
    case Family::kSheet:
      return "Sheet";
    case Family::kMillimetresToKilometres:
      return "MillimetresToKilometres";
    case Family::kTangent:
      return "Tangent";
    case Family::kEndOnSurface:
      return "EndOnSurface";
  }
  return "Unknown";
}

}  // namespace bqsa::test_support
