// How far ellipsoids reach beyond solids.

#include "bqsa/envelope/inflation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "bqsa/envelope/least_ellipsoid_around.hpp"
#include "support/solid_samples.hpp"

namespace bqsa {
namespace {

using Eigen::Vector3d;
using test_support::Generator;
using test_support::random_direction;
using test_support::random_ellipsoid;
using test_support::random_solid;
using test_support::surface_point;

double distance(const Vector3d& p, const Box& box) {
  const Vector3d x = box.rotation.transpose() * (p - box.center);
  return (x.cwiseAbs() - box.half_lengths).cwiseMax(0).norm();
}

double distance(const Vector3d& p, const Capsule& capsule) {
  const Vector3d d = capsule.b - capsule.a;
  const double t = std::clamp(d.dot(p - capsule.a) / d.squaredNorm(), 0.0, 1.0);
  return std::max((p - capsule.a - t * d).norm() - capsule.radius, 0.0);
}

double distance(const Vector3d& p, const Cylinder& cylinder) {
  const Vector3d d = cylinder.b - cylinder.a;
  const double along = d.normalized().dot(p - cylinder.a);
  const double across = (p - cylinder.a - along * d.normalized()).norm();
  const double beyond = std::max({-along, along - d.norm(), 0.0});
  return std::hypot(beyond, std::max(across - cylinder.radius, 0.0));
}

/// No surface point of the ellipsoid is further from the solid, and some nearly as far.
template <typename Shape>
void expect_the_furthest_of_many_points(const Ellipsoid& ellipsoid, const Shape& shape,
                                        Generator& generator) {
  const double accuracy = 1e-3 * ellipsoid.semi_axes().maxCoeff();
  const double inflation = largest_inflation(ellipsoid, shape, accuracy);
  double most = 0;
  for (int k = 0; k < 20'000; ++k) {
    const Vector3d p = surface_point<3>(ellipsoid, random_direction<3>(generator));
    const double beyond = distance(p, shape);
    ASSERT_LE(beyond, inflation + 1e-14);
    most = std::max(most, beyond);
  }
  for (int k = 0; k < 6; ++k) {  // needles are all tip
    const Vector3d tip = (k % 2 == 0 ? 1 : -1) * Vector3d::Unit(k / 2);
    most = std::max(most, distance(surface_point<3>(ellipsoid, tip), shape));
  }
  ASSERT_GE(most, inflation - accuracy - 0.02 * ellipsoid.semi_axes().maxCoeff());
}

TEST(Inflation, IsTheDistanceOfTheFurthestPoint) {
  Generator generator(1000);
  for (int i = 0; i < 30; ++i) {
    const double thin = i % 2 == 0 ? 0.2 : 0.01;
    for (std::size_t kind = 1; kind < 4; ++kind) {
      const Solid solid = random_solid(kind, thin, 1, generator);
      const Ellipsoid envelope = least_ellipsoid_around(solid);
      const Ellipsoid any = random_ellipsoid<3>(generator, thin, 1);
      std::visit(
          [&](const auto& shape) {
            if constexpr (requires { distance(Vector3d::Zero(), shape); }) {
              expect_the_furthest_of_many_points(envelope, shape, generator);
              expect_the_furthest_of_many_points(any, shape, generator);
            }
          },
          solid);
    }
  }
}

TEST(Inflation, OfABoxesEnvelopeIsThatOfItsLongestAxis) {
  Generator generator(1001);
  for (int i = 0; i < 50; ++i) {
    const Solid solid = random_solid(1, 0.01, 1, generator);
    const double longest = std::get<Box>(solid).half_lengths.maxCoeff();
    const double expected = (std::numbers::sqrt3 - 1) * longest;
    const double found = largest_inflation(least_ellipsoid_around(solid), solid, 1e-4 * longest);
    EXPECT_GE(found, expected) << "case " << i;
    EXPECT_LE(found, expected + 1.1e-4 * longest) << "case " << i;
  }
}

TEST(Inflation, IsZeroForABallAndWithin) {
  const Ball ball{{1, 2, 3}, 0.5};
  EXPECT_LT(largest_inflation(least_ellipsoid_around(ball), ball, 1e-4), 1.1e-4);
  EXPECT_EQ(largest_inflation({{1, 2, 3}, Vector3d::Constant(0.4)}, ball, 1e-4), 0);
  EXPECT_NEAR(largest_inflation({{1, 2, 4}, Vector3d::Constant(0.4)}, ball, 1e-4), 0.9, 1e-4);
}

TEST(Inflation, OfAHullIsThatOfTheBoxThatItIs) {
  Generator generator(1002);
  for (int i = 0; i < 10; ++i) {
    const Box box = std::get<Box>(random_solid(1, 0.1, 1, generator));
    std::vector<Vector3d> corners;
    for (int k = 0; k < 8; ++k) {
      corners.emplace_back(
          box.center +
          box.rotation * box.half_lengths.cwiseProduct(Vector3d(
                             (k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1)));
    }
    const Ellipsoid any = random_ellipsoid<3>(generator, 0.1, 1);
    EXPECT_NEAR(largest_inflation(any, convex_hull(corners), 1e-5),
                largest_inflation(any, box, 1e-5), 1e-5);
  }
}

}  // namespace
}  // namespace bqsa
