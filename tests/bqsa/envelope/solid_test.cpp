// Solids and the least ellipsoid around each: containment without rounding, and the closed forms
// against the search.

#include "bqsa/envelope/solid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "bqsa/envelope/least_ellipsoid.hpp"
#include "bqsa/envelope/least_ellipsoid_around.hpp"
#include "support/exact_containment.hpp"
#include "support/solid_samples.hpp"

namespace bqsa {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test_support::exact_level;
using test_support::Generator;
using test_support::kSolidNames;
using test_support::Quad;
using test_support::QuadPoint;
using test_support::random_direction;
using test_support::random_rotation;
using test_support::random_solid;
using test_support::sample;

/// A random solid of each kind.
class SolidOfKind : public testing::TestWithParam<std::size_t> {};

TEST_P(SolidOfKind, IsContainedInItsEnvelope) {
  Generator generator(900 + GetParam());
  int points = 0;
  for (const double thin : {0.1, 1e-4}) {
    for (const double offset : {0.0, 1e3}) {
      for (int i = 0; i < 50; ++i) {
        const Solid solid = random_solid(GetParam(), thin, offset, generator);
        const Ellipsoid envelope = least_ellipsoid_around(solid);
        for (int k = 0; k < 5000; ++k) {
          const QuadPoint p = sample(solid, generator);
          ASSERT_LE(static_cast<double>(exact_level<Quad>(envelope, p)), 0) << "case " << i;
          ++points;
        }
      }
    }
  }
  EXPECT_EQ(points, 1'000'000);
}

/// Support functions decide it for all points at once.
TEST_P(SolidOfKind, ReachesNoFurtherThanItsEnvelopeInAnyDirection) {
  Generator generator(910 + GetParam());
  for (int i = 0; i < 200; ++i) {
    const Solid solid = random_solid(GetParam(), 0.01, 1, generator);
    const Ellipsoid envelope = least_ellipsoid_around(solid);
    for (int k = 0; k < 500; ++k) {
      const Vector3d n = random_direction<3>(generator);
      const double beyond =
          n.dot(support_point(solid, n) - envelope.center()) - envelope.support(n);
      ASSERT_LE(beyond, 1e-15 * (1 + envelope.center().norm())) << "case " << i;
    }
  }
}

/// The direction's part across the axis is then rounding errors alone, which may be along the axis.
TEST(Solid, ACylinderReachesNoFurtherThanItsEndAlongItsAxis) {
  test_support::Generator generator(3);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d half_axis = test_support::random_vector<3>(generator, 1);
    const Cylinder cylinder{-half_axis, half_axis, 1};
    const Eigen::Vector3d n = half_axis.normalized();
    ASSERT_NEAR(n.dot(support_point(cylinder, n)), half_axis.norm(), 1e-12) << "case " << i;
  }
}

TEST_P(SolidOfKind, HasNoPointBeyondItsSupportPoint) {
  Generator generator(920 + GetParam());
  for (int i = 0; i < 50; ++i) {
    const Solid solid = random_solid(GetParam(), 0.1, 1, generator);
    const Vector3d n = random_direction<3>(generator);
    const double reach = n.dot(support_point(solid, n));
    double most = -std::numeric_limits<double>::infinity();
    for (int k = 0; k < 2000; ++k) {
      most = std::max(most, n.dot(test_support::rounded(sample(solid, generator))));
    }
    ASSERT_LE(most, reach + 1e-14) << "case " << i;
    ASSERT_GE(most, reach - 0.2) << "case " << i;
  }
}

/// Support points in many directions: the hull that they span fills the solid from within.
std::vector<Vector3d> surface(const Solid& solid, int count, Generator& generator) {
  std::vector<Vector3d> points;
  const Ellipsoid envelope = least_ellipsoid_around(solid);
  for (int k = 0; k < count; ++k) {
    // Normals of the envelope, so that thin solids are sampled all over, too.
    const Vector3d n =
        envelope.rotation() * random_direction<3>(generator).cwiseQuotient(envelope.semi_axes());
    points.push_back(support_point(solid, n));
  }
  return points;
}

TEST_P(SolidOfKind, HasTheVolumeOfItsPoints) {
  Generator generator(930 + GetParam());
  for (int i = 0; i < 10; ++i) {
    const Solid solid = random_solid(GetParam(), 0.1, 1, generator);
    const double from_within = volume(convex_hull(surface(solid, 20'000, generator)));
    EXPECT_LE(from_within, volume(solid) * (1 + 1e-10)) << "case " << i;
    EXPECT_GE(from_within, volume(solid) * (1 - 0.01)) << "case " << i;
  }
}

TEST_P(SolidOfKind, HasAnEnvelopeOfLeastVolume) {
  Generator generator(940 + GetParam());
  for (int i = 0; i < 20; ++i) {
    const Solid solid = random_solid(GetParam(), i % 2 == 0 ? 0.1 : 1e-3, 1, generator);
    const std::vector<Vector3d> points = surface(solid, 20'000, generator);
    const LeastEllipsoid<3> of_points = least_ellipsoid<3>(points);
    const double least = least_axis_product<3>(points, of_points.contacts);
    const double product = least_ellipsoid_around(solid).semi_axes().prod();
    EXPECT_GE(product, least) << "case " << i << ": smaller than possible";
    EXPECT_LE(product, least * (1 + 1e-4)) << "case " << i;
  }
}

TEST_P(SolidOfKind, ContainsPointsWithinTheSlack) {
  Generator generator(950 + GetParam());
  for (int i = 0; i < 50; ++i) {
    const Solid solid = random_solid(GetParam(), 0.1, 1, generator);
    const double slack = test_support::log_uniform(generator, 1e-6, 0.1);
    const Ellipsoid envelope = least_ellipsoid_around(solid, 0, slack);
    for (int k = 0; k < 500; ++k) {
      const Vector3d n = random_direction<3>(generator);
      const Vector3d p = support_point(solid, n) + slack * n;
      ASSERT_LE(n.dot(p - envelope.center()), envelope.support(n)) << "case " << i;
    }
  }
}

/// Together they contain it, they stay within it but for the slack, and each is about half as long.
TEST_P(SolidOfKind, IsDividedIntoHalvesThatContainIt) {
  if (GetParam() == 0) {
    EXPECT_FALSE(divisible(Ball{Vector3d::Zero(), 1}));
    EXPECT_THROW(halves({Ball{Vector3d::Zero(), 1}}, Vector3d::UnitX()), std::invalid_argument);
    return;
  }
  Generator generator(960 + GetParam());
  for (int i = 0; i < 100; ++i) {
    const Solid solid = random_solid(GetParam(), 0.1, 1, generator);
    const Vector3d direction = random_direction<3>(generator);
    ASSERT_TRUE(divisible(solid));
    const std::array<Part, 2> parts = halves({solid, 1e-3}, direction);
    std::array<Ellipsoid, 2> envelopes = {
        least_ellipsoid_around(parts[0].solid, 0, parts[0].slack),
        least_ellipsoid_around(parts[1].solid, 0, parts[1].slack)};
    for (const Part& part : parts) {
      EXPECT_GE(part.slack, 1e-3);
      EXPECT_LE(part.slack, 1e-3 + 1e-8);
      EXPECT_LT(volume(part.solid), volume(solid));
      for (int k = 0; k < 100; ++k) {
        const Vector3d n = random_direction<3>(generator);
        const double beyond = n.dot(support_point(part.solid, n) - support_point(solid, n));
        // The prism around a cylinder reaches 1.3e-3 of its radius further.
        EXPECT_LE(beyond, GetParam() == 2 ? 2e-3 : 1e-14) << "case " << i;
      }
    }
    for (int k = 0; k < 100; ++k) {
      const Vector3d n = random_direction<3>(generator);
      const double reached = std::max(n.dot(support_point(parts[0].solid, n)),
                                      n.dot(support_point(parts[1].solid, n)));
      EXPECT_GE(reached, n.dot(support_point(solid, n)) - 1e-11) << "case " << i;
    }
    for (int k = 0; k < 1000; ++k) {
      const QuadPoint p = sample(solid, generator);
      ASSERT_TRUE(exact_level<Quad>(envelopes[0], p) <= 0 ||
                  exact_level<Quad>(envelopes[1], p) <= 0)
          << "case " << i;
    }
  }
}

/// Corners within rounding of the plane, on both sides of it, and edges along it.
TEST(Halves, ContainSolidsWithManyCornersInTheCut) {
  Generator generator(970);
  for (int i = 0; i < 100; ++i) {
    const Matrix3d turn = random_rotation<3>(generator);
    const Vector3d shift = test_support::random_vector<3>(generator, 100);
    std::vector<Vector3d> points;
    for (int k = 0; k < 12; ++k) {  // a double pyramid; its equator is in the cut
      const double angle = test_support::uniform(generator, -3, 3);
      points.emplace_back(shift + turn * Vector3d(std::cos(angle), std::sin(angle), 0));
    }
    points.emplace_back(shift + turn.col(2));
    points.emplace_back(shift - turn.col(2));
    const Solid solid = convex_hull(points);
    const std::array<Part, 2> parts = halves({solid}, turn.col(2));
    const std::array<Ellipsoid, 2> envelopes = {
        least_ellipsoid_around(parts[0].solid, 0, parts[0].slack),
        least_ellipsoid_around(parts[1].solid, 0, parts[1].slack)};
    for (const Part& part : parts) EXPECT_NEAR(volume(part.solid), 0.5 * volume(solid), 1e-9);
    for (int k = 0; k < 2000; ++k) {
      const QuadPoint p = sample(solid, generator);
      ASSERT_TRUE(exact_level<Quad>(envelopes[0], p) <= 0 ||
                  exact_level<Quad>(envelopes[1], p) <= 0)
          << "case " << i;
    }
  }
  const Solid sheet = convex_hull(std::vector<Vector3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  EXPECT_THROW(halves({sheet}, Vector3d::UnitZ()), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(Kinds, SolidOfKind, testing::Range<std::size_t>(0, 5),
                         [](const auto& kind) { return kSolidNames[kind.param]; });

TEST(SolidEnvelope, HasTheClosedFormsOfBoxCylinderAndCapsule) {
  const Ellipsoid box = least_ellipsoid_around(Box{{1, 2, 3}, {0.3, 0.2, 0.1}});
  EXPECT_TRUE(box.semi_axes().isApprox(std::sqrt(3.0) * Vector3d(0.3, 0.2, 0.1), 1e-12));
  EXPECT_EQ(box.center(), Vector3d(1, 2, 3));
  const Ellipsoid cylinder = least_ellipsoid_around(Cylinder{{0, 0, -2}, {0, 0, 2}, 0.5});
  EXPECT_TRUE(cylinder.semi_axes().isApprox(
      Vector3d(0.5 * std::sqrt(1.5), 0.5 * std::sqrt(1.5), 2 * std::sqrt(3.0)), 1e-12));
  // l = r = 1: s = 3, A² = 4/3, C² = 16/3.
  const Ellipsoid capsule = least_ellipsoid_around(Capsule{{0, 0, -1}, {0, 0, 1}, 1});
  EXPECT_TRUE(capsule.semi_axes().isApprox(
      Vector3d(std::sqrt(4.0 / 3), std::sqrt(4.0 / 3), 4 / std::sqrt(3.0)), 1e-12));
  const Ellipsoid ball = least_ellipsoid_around(Capsule{{1, 1, 1}, {1, 1, 1}, 0.2});
  EXPECT_TRUE(ball.semi_axes().isApprox(Vector3d::Constant(0.2), 1e-12));
}

/// The optimum of a capsule in one dimension: for each A the least C that contains the caps, by
/// bisection on their support functions; then a fine scan of A. No closed form is used.
TEST(SolidEnvelope, OfACapsuleIsTheOptimumOverOneVariable) {
  for (const double r : {0.05, 0.3, 1.0, 4.0}) {
    const double l = 1;
    const auto contains = [&](double A, double C) {
      for (int k = 0; k <= 4000; ++k) {
        const double x = k / 4000.0;
        if (A * A * (1 - x * x) + C * C * x * x < (l * x + r) * (l * x + r)) return false;
      }
      return true;
    };
    double least = std::numeric_limits<double>::infinity();
    for (int k = 1; k < 1000; ++k) {
      const double A = r * (1 + 0.5 * k / 1000.0);
      double low = l + r, high = 100 * (l + r);
      for (int step = 0; step < 40; ++step) {
        const double C = 0.5 * (low + high);
        (contains(A, C) ? high : low) = C;
      }
      least = std::min(least, A * A * high);
    }
    const Ellipsoid capsule = least_ellipsoid_around(Capsule{{0, 0, -l}, {0, 0, l}, r});
    EXPECT_NEAR(capsule.semi_axes().prod() / least, 1, 1e-5) << "radius " << r;
  }
}

TEST(SolidEnvelope, GrowsToTheLeastSemiAxis) {
  const Ellipsoid plate = least_ellipsoid_around(Box{{0, 0, 0}, {1, 1, 1e-9}}, 0.01);
  EXPECT_NEAR(plate.semi_axes().z(), 0.01, 1e-12);
  const ConvexHull sheet =
      convex_hull(std::vector<Vector3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}});
  EXPECT_THROW(least_ellipsoid_around(sheet), std::invalid_argument);
  EXPECT_NEAR(least_ellipsoid_around(sheet, 0.01).semi_axes().minCoeff(), 0.01, 1e-8);
}

std::string refusal(const Solid& solid) {
  try {
    least_ellipsoid_around(solid);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SolidEnvelope, RefusesWhatIsNoSolidAndSaysWhy) {
  using testing::HasSubstr;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Vector3d o = Vector3d::Zero(), z = Vector3d::UnitZ(), bad = Vector3d::Constant(nan);
  for (const double length : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT(refusal(Ball{o, length}), HasSubstr("radius of the ball"));
    EXPECT_THAT(refusal(Box{o, {1, length, 1}}), HasSubstr("half lengths of the box"));
    EXPECT_THAT(refusal(Cylinder{o, z, length}), HasSubstr("radius of the cylinder"));
    EXPECT_THAT(refusal(Capsule{o, z, length}), HasSubstr("radius of the capsule"));
  }
  EXPECT_THAT(refusal(Cylinder{z, z, 1}), HasSubstr("length of the cylinder"));
  EXPECT_THAT(refusal(Ball{bad, 1}), HasSubstr("centre of the ball"));
  EXPECT_THAT(refusal(Box{bad, {1, 1, 1}}), HasSubstr("centre of the box"));
  EXPECT_THAT(refusal(Box{o, {1, 1, 1}, 1.01 * Matrix3d::Identity()}), HasSubstr("rotation"));
  EXPECT_THAT(refusal(Box{o, {1, 1, 1}, -Matrix3d::Identity()}), HasSubstr("rotation"));
  EXPECT_THAT(refusal(Capsule{o, bad, 1}), HasSubstr("end-points"));
  EXPECT_THAT(refusal(Cylinder{bad, z, 1}), HasSubstr("end-points"));
  EXPECT_THAT(refusal(ConvexHull{}), HasSubstr("hull with corners"));
}

}  // namespace
}  // namespace bqsa
