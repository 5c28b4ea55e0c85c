// The ellipsoid: unit map, level, support, what its constructor refuses, planar embedding, conics.

#include "bqsa/geometry/ellipsoid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "bqsa/geometry/conic.hpp"
#include "bqsa/geometry/segment_test.hpp"
#include "support/sampling.hpp"

namespace bqsa {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using test_support::Generator;
using test_support::random_direction;
using test_support::random_ellipsoid;
using test_support::random_vector;
using test_support::surface_point;
using test_support::uniform;

template <int Dim>
void expect_unit_map_sends_surface_to_unit_sphere() {
  Generator generator(20 + Dim);
  for (int i = 0; i < 2000; ++i) {
    const EllipsoidN<Dim> ellipsoid = random_ellipsoid<Dim>(generator, 1e-3, 1);
    const Eigen::Matrix<double, Dim, 1> s = random_direction<Dim>(generator);
    const double radius = uniform(generator, 0, 3);
    const Eigen::Matrix<double, Dim, 1> p = surface_point<Dim>(ellipsoid, radius * s);
    ASSERT_NEAR(unit_point<Dim>(ellipsoid, p).norm(), radius, 1e-11) << "case " << i;
    ASSERT_NEAR(ellipsoid.level(p), radius * radius - 1, 1e-11) << "case " << i;
    ASSERT_TRUE(ellipsoid.unit_map().isUpperTriangular(0)) << "case " << i;
  }
}

TEST(EllipsoidShape, UnitMapIsTriangularAndSendsTheSurfaceToTheUnitSphere) {
  expect_unit_map_sends_surface_to_unit_sphere<2>();
  expect_unit_map_sends_surface_to_unit_sphere<3>();
}

TEST(EllipsoidShape, QuadraticFormIsThatOfAxesAndRotation) {
  Generator generator(23);
  for (int i = 0; i < 1000; ++i) {
    const Ellipsoid e = random_ellipsoid<3>(generator, 1e-2, 1);
    const Matrix3d expected = e.rotation() *
                              e.semi_axes().array().square().inverse().matrix().asDiagonal() *
                              e.rotation().transpose();
    ASSERT_LT((e.quadratic_form() - expected).norm(), 1e-12 * expected.norm()) << "case " << i;
  }
}

TEST(EllipsoidShape, NeedlesAndSheetsKeepTheirSurface) {
  // The surface point is rounded to an ulp of a long axis, which is kRatio ulps across a short one.
  Generator generator(24);
  constexpr double kRatio = 1e5;
  for (int i = 0; i < 2000; ++i) {
    const bool needle = i % 2 == 0;
    const Vector3d axes = needle ? Vector3d(1, 1 / kRatio, 1 / kRatio) : Vector3d(1 / kRatio, 1, 1);
    const Ellipsoid e(Vector3d::Zero(), axes, test_support::random_rotation<3>(generator));
    const Vector3d p = surface_point<3>(e, random_direction<3>(generator));
    ASSERT_NEAR(e.level(p), 0, 20 * kRatio * std::numeric_limits<double>::epsilon())
        << "case " << i;
  }
}

template <int Dim>
void expect_support_is_the_largest_reach() {
  Generator generator(30 + Dim);
  for (int i = 0; i < 200; ++i) {
    const EllipsoidN<Dim> e = random_ellipsoid<Dim>(generator, 1e-2, 1);
    const Eigen::Matrix<double, Dim, 1> n = random_direction<Dim>(generator);
    double largest = 0;
    for (int k = 0; k < 500; ++k) {
      const double reach =
          n.dot(surface_point<Dim>(e, random_direction<Dim>(generator)) - e.center());
      ASSERT_LE(reach, e.support(n) * (1 + 1e-12)) << "case " << i;
      largest = std::max(largest, reach);
    }
    EXPECT_GT(largest, 0.9 * e.support(n)) << "case " << i;
  }
}

TEST(EllipsoidShape, SupportIsTheLargestReachInADirection) {
  expect_support_is_the_largest_reach<2>();
  expect_support_is_the_largest_reach<3>();
}

template <typename Work>
std::string refusal(const Work& work) {
  try {
    work();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(EllipsoidShape, RefusesWhatIsNoEllipsoidAndSaysWhy) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const Vector3d origin = Vector3d::Zero(), ones = Vector3d::Ones();
  for (const double bad : {0.0, -1.0, nan, infinity}) {
    EXPECT_THAT(refusal([&] {
                  Ellipsoid(origin, {1, bad, 1});
                }),
                testing::HasSubstr("semi-axes"))
        << bad;
  }
  for (const double bad : {nan, infinity}) {
    EXPECT_THAT(refusal([&] {
                  Ellipsoid({0, bad, 0}, ones);
                }),
                testing::HasSubstr("centre"))
        << bad;
  }
  Matrix3d mirrored = Matrix3d::Identity();
  mirrored(2, 2) = -1;
  const Matrix3d with_nan = Matrix3d::Constant(nan);
  const Matrix3d stretched = 1.001 * Matrix3d::Identity();
  for (const Matrix3d& bad : {mirrored, with_nan, stretched}) {
    EXPECT_THAT(refusal([&] { Ellipsoid(origin, ones, bad); }), testing::HasSubstr("rotation"));
  }
}

TEST(Embedding, RoundTripsAndKeepsTheLevelInThePlane) {
  Generator generator(40);
  for (int i = 0; i < 1000; ++i) {
    const Ellipse e = random_ellipsoid<2>(generator, 1e-2, 1);
    const Ellipsoid solid = embedded(e);
    const Ellipse back = planar_section(solid);
    ASSERT_EQ(back.center(), e.center()) << "case " << i;
    ASSERT_EQ(back.semi_axes(), e.semi_axes()) << "case " << i;
    ASSERT_EQ(back.rotation(), e.rotation()) << "case " << i;
    ASSERT_EQ(solid.semi_axes().z(), e.semi_axes().maxCoeff()) << "case " << i;
    const Vector2d p = random_vector<2>(generator, 2);
    ASSERT_NEAR(solid.level({p.x(), p.y(), 0}), e.level(p), 1e-11 * (1 + e.level(p)))
        << "case " << i;
  }
}

TEST(Embedding, RotatedEllipseTurnsItsAxesCounterclockwise) {
  const Ellipse e = rotated_ellipse({1, 2}, {3, 1}, std::numbers::pi / 6);
  const Vector2d vertex = Vector2d(1, 2) + 3 * Vector2d(std::sqrt(3.0) / 2, 0.5);
  EXPECT_NEAR(e.level(vertex), 0, 1e-15);
}

double value(const Conic<double>& G, const Vector2d& p) {
  return G.A * p.x() * p.x() + G.B * p.x() * p.y() + G.C * p.y() * p.y() + G.D * p.x() +
         G.E * p.y() + G.F;
}

TEST(ConicForm, TakesTheValuesOfTheLevel) {
  Generator generator(50);
  for (int i = 0; i < 2000; ++i) {
    const Ellipse e = random_ellipsoid<2>(generator, 0.05, 1);
    const Conic<double> G = conic_from_ellipse(e);
    const Vector2d p = random_vector<2>(generator, 2);
    ASSERT_NEAR(value(G, p), e.level(p), 1e-12 / e.semi_axes().array().square().minCoeff())
        << "case " << i;
    ASSERT_GT(4 * G.A * G.C, G.B * G.B) << "case " << i;
  }
}

TEST(ConicForm, RoundTripsFromTheEllipse) {
  Generator generator(51);
  for (int i = 0; i < 2000; ++i) {
    const Ellipse e = random_ellipsoid<2>(generator, 0.05, 1);
    Conic<double> G = conic_from_ellipse(e);
    const double scale = test_support::log_uniform(generator, 1e-3, 1e3);
    for (double* coefficient : {&G.A, &G.B, &G.C, &G.D, &G.E, &G.F}) *coefficient *= scale;
    const Ellipse back = ellipse_from_conic(G);
    ASSERT_LT((back.center() - e.center()).norm(), 1e-10) << "case " << i;
    ASSERT_LT((back.quadratic_form() - e.quadratic_form()).norm(), 1e-9 * e.quadratic_form().norm())
        << "case " << i;
  }
}

TEST(ConicForm, RoundTripsFromTheCoefficients) {
  Generator generator(52);
  for (int i = 0; i < 2000; ++i) {
    const double A = uniform(generator, 0.5, 5), C = uniform(generator, 0.5, 5);
    const double B = uniform(generator, -1.8, 1.8) * std::sqrt(A * C);
    const double D = uniform(generator, -2, 2), E = uniform(generator, -2, 2);
    const Conic<double> back = conic_from_ellipse(ellipse_from_conic({A, B, C, D, E, -9}));
    const double scale = -9 / back.F;
    ASSERT_NEAR(back.A * scale, A, 1e-11) << "case " << i;
    ASSERT_NEAR(back.B * scale, B, 1e-11) << "case " << i;
    ASSERT_NEAR(back.C * scale, C, 1e-11) << "case " << i;
    ASSERT_NEAR(back.D * scale, D, 1e-11) << "case " << i;
    ASSERT_NEAR(back.E * scale, E, 1e-11) << "case " << i;
  }
}

TEST(ConicForm, RefusesWhatIsNoEllipse) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Conic<double> parabola{1, 2, 1, 0, 0, -1}, hyperbola{1, 3, 1, 0, 0, -1};
  const Conic<double> turned_out{-1, 0, -1, 0, 0, 1}, empty{1, 0, 1, 0, 0, 1};
  const Conic<double> point{1, 0, 1, 0, 0, 0}, not_a_number{1, 0, 1, nan, 0, -1};
  for (const Conic<double>& bad : {parabola, hyperbola, turned_out, empty, point, not_a_number}) {
    EXPECT_THROW(ellipse_from_conic(bad), std::invalid_argument);
  }
}

}  // namespace
}  // namespace bqsa
