#include "harness/judge/exact_solid.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "harness/judge/fcl_check.hpp"
#include "harness/judge/judge.hpp"
#include "harness/judge/link_scene.hpp"
#include "solid_scenes.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;
using test_support::Generator;
using test_support::height;
using test_support::judged_solid;
using test_support::kJudgedSolidNames;
using test_support::log_uniform;
using test_support::Segment;
using test_support::segment_near;
using test_support::uniform;

class ExactSolids : public ::testing::TestWithParam<std::size_t> {};

INSTANTIATE_TEST_SUITE_P(Kinds, ExactSolids, ::testing::Values(0, 1, 2, 3, 4, 5),
                         [](const auto& kind) { return kJudgedSolidNames[kind.param]; });

/// Whose distance from a point has one; hulls have none.
class SolidsWithAFormula : public ExactSolids {};

INSTANTIATE_TEST_SUITE_P(Kinds, SolidsWithAFormula, ::testing::Values(0, 1, 2, 3),
                         [](const auto& kind) { return kJudgedSolidNames[kind.param]; });

/// A gap of either sign, from micrometres to metres.
double any_gap(Generator& generator, int number) {
  return (number % 2 == 0 ? 1 : -1) * log_uniform(generator, 1e-6, 1);
}

TEST_P(ExactSolids, AreAsFarAsThePlaneProves) {
  Generator generator(11 + GetParam());
  int apart = 0, meeting = 0;
  for (int k = 0; k < 20000; ++k) {
    const Solid solid = judged_solid(GetParam(), k % 3 == 0 ? 1e-4 : 0.05, generator);
    const double length = k % 7 == 0 ? 0 : 0.4;
    const Segment link = segment_near(generator, solid, length, any_gap(generator, k), k % 5 != 0);
    const SolidClearance result = ExactSolid(solid).clearance(link.a, link.b);
    ASSERT_NEAR(result.normal.norm(), 1, 1e-12) << "case " << k;
    const double highest = height(solid, result.normal);
    ASSERT_NEAR(result.offset, highest, 1e-13) << "case " << k;
    const double lowest = std::min(result.normal.dot(link.a), result.normal.dot(link.b));
    // The direction between two points, of the solid or of axes, is known the less the nearer they
    // are.
    const double unknown =
        result.clearance > 0 ? std::min(result.clearance, 1e-15 / result.clearance) : 1e-10;
    ASSERT_NEAR(lowest - highest, result.clearance, unknown + 1e-12) << "case " << k;
    ++(result.clearance > 0 ? apart : meeting);
  }
  EXPECT_GT(apart, 4000);
  EXPECT_GT(meeting, 1000);
}

/// By libccd with links as thick as the clearance, a little less and a little more.
TEST_P(ExactSolids, AreAsFarAsForFcl) {
  constexpr double kTolerance = 2e-8;
  Generator generator(21 + GetParam());
  int hits = 0, confirmed = 0;
  for (int k = 0; k < 10000; ++k) {
    const Solid solid = judged_solid(GetParam(), k % 3 == 0 ? 1e-4 : 0.05, generator);
    const double radius = k % 4 < 2 ? 0 : uniform(generator, 1e-3, 0.05);
    const Segment link =
        segment_near(generator, solid, 0.4, radius + any_gap(generator, k), k % 5 != 0);
    const double clearance = ExactSolid(solid).clearance(link.a, link.b).clearance - radius;
    const FclCheck check({}, radius, {solid});
    const bool hit = check.collides(link.a, link.b, 0);
    ASSERT_EQ(contradiction(clearance, hit), "") << "case " << k;
    if (hit) {
      ++hits;
      continue;
    }
    ASSERT_TRUE(check.confirms(link.a, link.b, 0, std::max(clearance, 0.0), kTolerance))
        << "case " << k << ", clearance " << clearance;
    ASSERT_FALSE(check.confirms(link.a, link.b, 0, clearance + 5 * kTolerance, kTolerance))
        << "case " << k;
    ++confirmed;
  }
  EXPECT_GT(hits, 1500);
  EXPECT_GT(confirmed, 1500);
}

/// Distance of a point from a box, cylinder, capsule or ball.
long double distance_of_point(const Solid& solid, const Vector3d& p) {
  if (const auto* box = std::get_if<Box>(&solid)) {
    const Vector3d local = box->rotation.transpose() * (p - box->center);
    return (local.cwiseAbs() - box->half_lengths).cwiseMax(0).norm();
  }
  if (const auto* ball = std::get_if<Ball>(&solid)) {
    return std::max(0.0, (p - ball->center).norm() - ball->radius);
  }
  const auto along_and_across = [&](const Vector3d& a, const Vector3d& b) {
    const Vector3d axis = (b - a).normalized();
    const double half = 0.5 * (b - a).norm();
    const Vector3d from_middle = p - 0.5 * (a + b);
    return Eigen::Vector2d(std::max(0.0, std::abs(axis.dot(from_middle)) - half),
                           axis.cross(from_middle).norm());
  };
  if (const auto* cylinder = std::get_if<Cylinder>(&solid)) {
    const Eigen::Vector2d r = along_and_across(cylinder->a, cylinder->b);
    return std::hypot(r.x(), std::max(0.0, r.y() - cylinder->radius));
  }
  const auto& capsule = std::get<Capsule>(solid);
  return std::max(0.0, along_and_across(capsule.a, capsule.b).norm() - capsule.radius);
}

TEST_P(SolidsWithAFormula, AreAsFarAsATernarySearchAlongTheSegment) {
  Generator generator(31 + GetParam());
  int apart = 0;
  for (int k = 0; k < 4000; ++k) {
    const Solid solid = judged_solid(GetParam(), k % 3 == 0 ? 1e-3 : 0.05, generator);
    const Segment link = segment_near(generator, solid, log_uniform(generator, 0.01, 10),
                                      any_gap(generator, k), k % 2);
    long double low = 0, high = 1;
    const auto at = [&](long double t) {
      return distance_of_point(solid, link.a + static_cast<double>(t) * (link.b - link.a));
    };
    for (int i = 0; i < 120; ++i) {
      const long double third = (high - low) / 3;
      (at(low + third) < at(high - third) ? high : low) =
          at(low + third) < at(high - third) ? high - third : low + third;
    }
    const double searched = static_cast<double>(at((low + high) / 2));
    const double found = std::max(0.0, ExactSolid(solid).clearance(link.a, link.b).clearance);
    ASSERT_NEAR(found, searched, 1e-8) << "case " << k;  // flat minima end a ternary search early
    ASSERT_LE(found, searched + 1e-12) << "case " << k;
    if (found > 0) ++apart;
  }
  EXPECT_GT(apart, 800);
}

/// Moved by the depth along the normal, the link is free; and no more than what was pushed in has
/// to be undone, but for a few links across the rim of a cylinder.
TEST_P(ExactSolids, AreLeftByTheDepth) {
  Generator generator(41 + GetParam());
  int meeting = 0, too_deep = 0;
  for (int k = 0; k < 10000; ++k) {
    const Solid solid = judged_solid(GetParam(), 0.05, generator);
    const double pushed = log_uniform(generator, 1e-7, 1e-4);
    const Segment link = segment_near(generator, solid, 0.4, -pushed, true);
    const ExactSolid exact(solid);
    const SolidClearance result = exact.clearance(link.a, link.b);
    const double depth = -result.clearance;
    if (depth > pushed * 1.01 + 1e-12) ++too_deep;
    if (!(depth > 0)) continue;
    const Vector3d out = (depth + 1e-9) * result.normal;
    ASSERT_GE(exact.clearance(link.a + out, link.b + out).clearance, 1e-9 - 1e-12) << "case " << k;
    ++meeting;
  }
  EXPECT_LE(too_deep, GetParam() == 2 ? 5 : 0);
  EXPECT_GT(meeting, GetParam() == test_support::kFlat ? 2000 : 8000);
}

TEST(ExactSolid, OfABoxIsThatOfTheHullOfItsCorners) {
  Generator generator(51);
  for (int k = 0; k < 5000; ++k) {
    const Box box = std::get<Box>(judged_solid(1, 0.05, generator));
    std::vector<Vector3d> points;
    for (int corner = 0; corner < 27; ++corner) {  // middles of edges and faces, too
      const Vector3d place(corner % 3 - 1, corner / 3 % 3 - 1, corner / 9 - 1);
      points.emplace_back(box.center + box.rotation * box.half_lengths.cwiseProduct(place));
    }
    const Segment link = segment_near(generator, box, 0.4, any_gap(generator, k), k % 2 == 0);
    const double of_box = ExactSolid(box).clearance(link.a, link.b).clearance;
    const double of_hull = ExactSolid(convex_hull(points)).clearance(link.a, link.b).clearance;
    ASSERT_NEAR(of_box, of_hull, 1e-10) << "case " << k;
  }
}

TEST(ExactSolid, InsideIsDeepAndNotFar) {
  const Box box{Vector3d::Zero(), {0.3, 0.2, 0.1}};
  EXPECT_NEAR(ExactSolid(box).clearance({-0.05, 0, 0.02}, {0.05, 0, 0.02}).clearance, -0.08, 1e-15);
  const Cylinder cylinder{{0, 0, -0.3}, {0, 0, 0.3}, 0.1};
  EXPECT_NEAR(ExactSolid(cylinder).clearance({0, 0, -0.1}, {0, 0, 0.1}).clearance, -0.1, 1e-15);
  EXPECT_NEAR(ExactSolid(cylinder).clearance({0, 0, 0.25}, {0.01, 0, 0.26}).clearance, -0.05,
              1e-15);
  const Capsule capsule{{0, 0, -0.3}, {0, 0, 0.3}, 0.1};
  EXPECT_NEAR(ExactSolid(capsule).clearance({0, 0, -0.1}, {0, 0, 0.1}).clearance, -0.1, 1e-15);
  EXPECT_NEAR(ExactSolid(capsule).clearance({-1, 0, 0}, {1, 0, 0}).clearance, -0.1, 1e-15);
  const Ball ball{Vector3d::Zero(), 0.1};
  EXPECT_NEAR(ExactSolid(ball).clearance(Vector3d::Zero(), Vector3d::Zero()).clearance, -0.1,
              1e-15);
}

TEST(ExactSolid, KnownDistances) {
  const Box box{{1, 0, 0}, {0.5, 0.25, 0.125}};
  const auto from_box = [&](const Vector3d& a, const Vector3d& b) {
    return ExactSolid(box).clearance(a, b).clearance;
  };
  EXPECT_NEAR(from_box({1, 0, 1}, {1.1, 0, 1}), 0.875, 1e-15);          // face
  EXPECT_NEAR(from_box({0, 1, 0.125}, {2, 1, 0.125}), 0.75, 1e-15);     // along an edge
  EXPECT_NEAR(from_box({1.8, 0.65, 0}, {1.8, 0.65, 0.1}), 0.5, 1e-15);  // 3-4-5 from an edge
  EXPECT_NEAR(from_box({1.5, 0.45, 0.125}, {1.7, 0.25, 0.125}), std::sqrt(0.02), 1e-15);
  EXPECT_NEAR(from_box({1.7, 0.45, 0.225}, {2, 1, 1}), 0.3, 1e-15);  // corner
  const Cylinder cylinder{{0, 0, -1}, {0, 0, 1}, 0.5};
  const auto from_cylinder = [&](const Vector3d& a, const Vector3d& b) {
    return ExactSolid(cylinder).clearance(a, b).clearance;
  };
  EXPECT_NEAR(from_cylinder({-1, 0.75, 0}, {1, 0.75, 0.5}), 0.25, 1e-15);    // side
  EXPECT_NEAR(from_cylinder({0.8, 0, 1.4}, {0.8, 0, 2}), 0.5, 1e-15);        // 3-4-5 from the rim
  EXPECT_NEAR(from_cylinder({-3, 0.1, 1.25}, {3, 0.1, 1.25}), 0.25, 1e-15);  // over the end
  EXPECT_NEAR(from_cylinder({-0.5, 0, 2}, {1.5, 0, 1}), std::sqrt(0.2), 1e-15);
}

TEST(ExactSolid, OfAPolygonHasTwoSidesAndARim) {
  const std::vector<Vector3d> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const ExactSolid sheet{Solid(convex_hull(square))};
  const auto from = [&](const Vector3d& a, const Vector3d& b) {
    return sheet.clearance(a, b).clearance;
  };
  EXPECT_NEAR(from({0.5, 0.5, 0.25}, {0.6, 0.5, 0.5}), 0.25, 1e-15);
  EXPECT_NEAR(from({0.5, 0.5, -0.25}, {0.6, 0.5, -0.5}), 0.25, 1e-15);
  EXPECT_NEAR(from({0.5, 0.5, -0.1}, {0.5, 0.5, 0.3}), -0.1, 1e-15);     // through it
  EXPECT_NEAR(from({0.95, 0.5, -1}, {0.95, 0.5, 1}), -0.05, 1e-15);      // nearer to its rim
  EXPECT_NEAR(from({2, -1, 0}, {2, 3, 0}), 1, 1e-15);                    // beside it, in its plane
  EXPECT_NEAR(from({2, 0.5, 0}, {0.5, 2, 0}), std::sqrt(0.125), 1e-15);  // a corner of it
  EXPECT_NEAR(from({0.2, 0.5, 0}, {0.7, 0.5, 0}), 0, 1e-15);  // within it: it has no depth
}

TEST(ExactSolid, OfALineIsRefused) {
  const std::vector<Vector3d> line = {{0, 0, 0}, {1, 1, 1}};
  EXPECT_THROW(ExactSolid(Solid(convex_hull(line))), std::invalid_argument);
}

}  // namespace
}  // namespace bqsa::harness
