// Solids covered by several ellipsoids, and the geometry ledger.

#include "bqsa/envelope/cover.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "bqsa/envelope/inflation.hpp"
#include "bqsa/envelope/least_ellipsoid_around.hpp"
#include "support/exact_containment.hpp"
#include "support/solid_samples.hpp"

namespace bqsa {
namespace {

using Eigen::Vector3d;
using test_support::exact_level;
using test_support::Generator;
using test_support::kSolidNames;
using test_support::Quad;
using test_support::QuadPoint;
using test_support::random_solid;
using test_support::sample;

bool contains(const Cover& cover, const QuadPoint& p) {
  return std::any_of(cover.ellipsoids.begin(), cover.ellipsoids.end(),
                     [&](const Ellipsoid& e) { return exact_level<Quad>(e, p) <= 0; });
}

class CoverOfKind : public testing::TestWithParam<std::size_t> {};

TEST_P(CoverOfKind, ContainsTheWholeSolid) {
  Generator generator(1100 + GetParam());
  int points = 0, divided = 0;
  for (const double thin : {0.1, 1e-3}) {
    for (int i = 0; i < 20; ++i) {
      const Solid solid = random_solid(GetParam(), thin, 10, generator);
      const Cover several = cover(solid, {.inflation = 0.01, .max_ellipsoids = 2 + i});
      divided += several.ellipsoids.size() > 1;
      for (int k = 0; k < 5000; ++k) {
        ASSERT_TRUE(contains(several, sample(solid, generator))) << "case " << i;
        ++points;
      }
    }
  }
  EXPECT_EQ(points, 200'000);
  if (GetParam() > 0) {
    EXPECT_GT(divided, 20);
  }
}

TEST_P(CoverOfKind, KeepsItsBoundsOrSaysThatItCannot) {
  Generator generator(1110 + GetParam());
  int kept = 0, ended = 0;
  for (int i = 0; i < 20; ++i) {
    const Solid solid = random_solid(GetParam(), 0.05, 1, generator);
    const double own = largest_inflation(least_ellipsoid_around(solid), solid, 1e-4);
    const CoverSettings settings{.inflation = 0.5 * own + 1e-3, .max_ellipsoids = 12};
    const Cover several = cover(solid, settings);
    EXPECT_EQ(several.within_bounds, several.inflation <= settings.inflation);
    if (!several.within_bounds) {
      EXPECT_EQ(several.ellipsoids.size(), 12U);
    }
    (several.within_bounds ? kept : ended) += 1;
    double most = 0, total = 0;
    for (const Ellipsoid& e : several.ellipsoids) {
      most = std::max(most, largest_inflation(e, solid, 1e-4));
      total += 4 * std::numbers::pi / 3 * e.semi_axes().prod();
    }
    EXPECT_NEAR(several.inflation, most, 2e-3);
    EXPECT_NEAR(several.volume_ratio, total / volume(solid), 1e-9 * several.volume_ratio);
  }
  EXPECT_GE(kept, 5);
}

TEST_P(CoverOfKind, ContainsThePointsWithinTheMargin) {
  Generator generator(1130 + GetParam());
  constexpr double kMargin = 0.05;
  for (int i = 0; i < 20; ++i) {
    const Solid solid = random_solid(GetParam(), 0.2, 1, generator);
    const Cover several =
        cover(solid, {.inflation = 0.1, .max_ellipsoids = 1 + i, .margin = kMargin});
    for (int k = 0; k < 1000; ++k) {
      const Vector3d n = test_support::random_direction<3>(generator);
      const QuadPoint p = test_support::quad_point(support_point(solid, n));
      const QuadPoint near =
          test_support::plus(p, kMargin * (1 - 1e-12), test_support::quad_point(n));
      ASSERT_TRUE(contains(several, near)) << "case " << i;
    }
  }
  EXPECT_THROW(cover(Ball{{0, 0, 0}, 1}, {.margin = -1}), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(Kinds, CoverOfKind, testing::Range<std::size_t>(0, 5),
                         [](const auto& kind) { return kSolidNames[kind.param]; });

TEST(Cover, OfABoxByOneHasTheLedgerOfTheClosedForm) {
  const Cover one = cover(Box{{0, 0, 0}, {0.3, 0.2, 0.1}});
  ASSERT_EQ(one.ellipsoids.size(), 1U);
  EXPECT_TRUE(one.within_bounds);
  EXPECT_NEAR(one.volume_ratio, std::numbers::pi / 2 * std::numbers::sqrt3, 1e-9);
  EXPECT_NEAR(one.inflation, (std::numbers::sqrt3 - 1) * 0.3, 1e-3);
}

TEST(Cover, DividesALongBoxAcrossItsLength) {
  // Two cubes of side 2: their ellipsoids are balls of radius sqrt(3).
  const Cover two = cover(Box{{0, 0, 0}, {2, 1, 1}}, {.inflation = 1, .max_ellipsoids = 2});
  ASSERT_EQ(two.ellipsoids.size(), 2U);
  EXPECT_TRUE(two.within_bounds);
  for (const Ellipsoid& e : two.ellipsoids) {
    EXPECT_TRUE(e.semi_axes().isApprox(Vector3d::Constant(std::numbers::sqrt3), 1e-6));
    EXPECT_LT((e.center().cwiseAbs() - Vector3d::UnitX()).norm(), 1e-6);
  }
  EXPECT_NEAR(two.inflation, std::numbers::sqrt3 - 1, 3e-3);
}

TEST(Cover, MoreEllipsoidsInflateLess) {
  const Cylinder rod{{0, 0, 0}, {4, 0, 0}, 0.1};
  double before = std::numeric_limits<double>::infinity();
  for (const int count : {1, 2, 4, 8, 16}) {
    const Cover several = cover(rod, {.inflation = 1e-3, .max_ellipsoids = count});
    EXPECT_EQ(several.ellipsoids.size(), static_cast<std::size_t>(count));
    EXPECT_FALSE(several.within_bounds);
    EXPECT_LT(several.inflation, 0.6 * before) << count;
    before = several.inflation;
  }
}

TEST(Cover, KeepsAVolumeRatio) {
  const Cylinder disc{{0, 0, 0}, {0, 0, 0.2}, 1};
  const double own = cover(disc).volume_ratio;
  EXPECT_NEAR(own, std::sqrt(3.0), 1e-9);  // 4/3 pi (3/2) sqrt(3) / (2 pi)
  const Cover several = cover(disc, {.volume_ratio = 0.999 * own, .max_ellipsoids = 50});
  EXPECT_EQ(several.within_bounds, several.volume_ratio <= 0.999 * own);
  EXPECT_GT(several.ellipsoids.size(), 1U);
}

TEST(Cover, OfASheetIsThinAndWhole) {
  // The diagonal of the sheet is where a cut that only shares corners leaves a gap.
  Generator generator(1120);
  const ConvexHull sheet =
      convex_hull(std::vector<Vector3d>{{0, 0, 1}, {4, 0, 1}, {4, 1, 1}, {0, 1, 1}});
  const Cover several =
      cover(sheet, {.inflation = 0.2, .max_ellipsoids = 20, .least_semi_axis = 1e-3});
  EXPECT_TRUE(several.within_bounds);
  EXPECT_GT(several.ellipsoids.size(), 3U);
  EXPECT_TRUE(std::isinf(several.volume_ratio));
  for (const Ellipsoid& e : several.ellipsoids) {
    EXPECT_NEAR(e.semi_axes().minCoeff(), 1e-3, 1e-7);
  }
  for (int k = 0; k < 20'000; ++k) ASSERT_TRUE(contains(several, sample(sheet, generator)));
  EXPECT_THROW(cover(sheet, {.inflation = 0.2, .max_ellipsoids = 20}), std::invalid_argument);
}

TEST(Cover, OfASegmentAndOfAPointIsThin) {
  const ConvexHull segment = convex_hull(std::vector<Vector3d>{{0, 0, 0}, {1, 2, 2}});
  const CoverSettings settings{.inflation = 0.5e-3, .max_ellipsoids = 8, .least_semi_axis = 1e-3};
  const Cover rods = cover(segment, settings);
  EXPECT_EQ(rods.ellipsoids.size(), 8U);
  EXPECT_FALSE(rods.within_bounds) << "thinner than the least semi-axis";
  Generator generator(1121);
  for (int k = 0; k < 5000; ++k) ASSERT_TRUE(contains(rods, sample(segment, generator)));
  const ConvexHull point = convex_hull(std::vector<Vector3d>{{1, 2, 3}});
  const Cover ball = cover(point, settings);
  ASSERT_EQ(ball.ellipsoids.size(), 1U);
  EXPECT_FALSE(ball.within_bounds);
  EXPECT_TRUE(ball.ellipsoids[0].semi_axes().isApprox(Vector3d::Constant(1e-3), 1e-9));
}

/// A grain in a ball of the least radius inflates by more than is asked for, however it is divided.
TEST(Cover, OfAGrainIsOneBallOfTheLeastRadius) {
  const CoverSettings settings{.inflation = 1e-4, .max_ellipsoids = 200, .least_semi_axis = 1e-3};
  const Box grain{Vector3d(0.5, 0.4, 0.3), Vector3d::Constant(2.5e-4)};
  std::vector<Vector3d> corners;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      for (const double z : {-1.0, 1.0}) {
        corners.emplace_back(grain.center + grain.half_lengths.cwiseProduct(Vector3d(x, y, z)));
      }
    }
  }
  for (const Solid& solid : {Solid(grain), Solid(convex_hull(corners))}) {
    const Cover result = cover(solid, settings);
    ASSERT_EQ(result.ellipsoids.size(), 1U);
    EXPECT_TRUE(result.ellipsoids[0].semi_axes().isApproxToConstant(1e-3, 1e-9));
    EXPECT_FALSE(result.within_bounds);
    EXPECT_NEAR(result.inflation, 1e-3 - 2.5e-4, 2e-6);
  }
}

TEST(Cover, RefusesBoundsThatAreNone) {
  const Ball ball{{0, 0, 0}, 1};
  EXPECT_THROW(cover(ball, {.inflation = 0}), std::invalid_argument);
  EXPECT_THROW(cover(ball, {.inflation = std::nan("")}), std::invalid_argument);
  EXPECT_THROW(cover(ball, {.volume_ratio = -1}), std::invalid_argument);
  EXPECT_THROW(cover(ball, {.max_ellipsoids = 0}), std::invalid_argument);
  EXPECT_THROW(cover(Ball{{0, 0, 0}, -1}), std::invalid_argument);
}

}  // namespace
}  // namespace bqsa
