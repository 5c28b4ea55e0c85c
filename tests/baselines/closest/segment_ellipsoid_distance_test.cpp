#include "baselines/closest/segment_ellipsoid_distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/distance_oracle.hpp"
#include "support/sampling.hpp"
#include "support/segment_cases.hpp"

namespace bqsa::baselines {
namespace {

using Eigen::Vector3d;
using test_support::DistanceOracle;
using test_support::Generator;
using test_support::log_uniform;
using test_support::random_direction;
using test_support::random_segment_case;
using test_support::random_shape;
using test_support::SegmentCase;
using test_support::uniform;

constexpr double kRounding = 2e-15;  // of the lengths in play

/// The two points and the plane between them prove each other, by convexity: the points are in their
/// sets, so the distance is at most `distance`; the plane across `direction` has the sets on its two
/// sides, so it is at least the gap that the plane sees.
void expect_proven(const SegmentCase& c, const SegmentDistance& found, int trial) {
  const double tolerance = kRounding * c.size();
  EXPECT_GE(found.s, 0) << trial;
  EXPECT_LE(found.s, 1) << trial;
  EXPECT_LT((found.p_segment - (c.a + found.s * (c.b - c.a))).norm(), tolerance) << trial;
  EXPECT_NEAR(found.direction.norm(), 1, 1e-14) << trial;
  EXPECT_LT((found.p_segment - found.p_ellipsoid - found.distance * found.direction).norm(),
            2 * tolerance)
      << trial;
  EXPECT_LT(std::abs(c.shape.level(found.p_ellipsoid)) * c.shape.semi_axes().minCoeff(),
            8 * tolerance)
      << trial;
  const double gap = std::min(found.direction.dot(c.a - c.shape.center()),
                              found.direction.dot(c.b - c.shape.center())) -
                     c.shape.support(found.direction);
  EXPECT_GT(gap, found.distance - 4 * tolerance) << trial;
}

TEST(SegmentDistance, IsProvenByItsOwnPointsAndPlane) {
  Generator generator(1);
  int apart = 0;
  for (int trial = 0; trial < 80000; ++trial) {
    const SegmentCase c = random_segment_case(generator, trial);
    const SegmentDistance found = segment_distance(c.a, c.b, c.shape);
    if (found.distance == 0) continue;
    ++apart;
    expect_proven(c, found, trial);
  }
  EXPECT_GT(apart, 50000);
}

TEST(SegmentDistance, IsThatOfTheOracle) {
  Generator generator(2);
  int meeting = 0;
  for (int trial = 0; trial < 16000; ++trial) {
    const SegmentCase c = random_segment_case(generator, trial);
    const auto expected = static_cast<double>(DistanceOracle(c.a, c.b, c.shape).distance());
    EXPECT_NEAR(segment_distance(c.a, c.b, c.shape).distance, expected, kRounding * c.size())
        << trial;
    meeting += expected == 0;
  }
  EXPECT_GT(meeting, 500);
}

TEST(SegmentDistance, OfSegmentsThatMeetIsZeroAtTheirDeepestPoint) {
  Generator generator(3);
  int inside = 0, crossing = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Ellipsoid shape = random_shape(generator, trial);
    const Vector3d p = shape.center() + shape.rotation() * shape.semi_axes().cwiseProduct(
                                                               uniform(generator, 0, 0.99) *
                                                               random_direction<3>(generator));
    const Vector3d d = random_direction<3>(generator) * log_uniform(generator, 1e-6, 1);
    const Vector3d a = p - uniform(generator, 0, 1) * d, b = a + d;
    const SegmentDistance found = segment_distance(a, b, shape);
    EXPECT_EQ(found.distance, 0) << trial;
    EXPECT_EQ(found.p_ellipsoid, found.p_segment) << trial;
    const auto least = static_cast<double>(DistanceOracle(a, b, shape).least_norm());
    const double noise =
        1e-15 * (1 + a.norm() + shape.center().norm()) / shape.semi_axes().minCoeff();
    const double norm = std::sqrt(std::max(0.0, 1 + shape.level(found.p_segment)));
    EXPECT_NEAR(norm, least, 1e-7 * least + noise) << trial;
    EXPECT_NEAR(found.direction.norm(), 1, 1e-14) << trial;
    const Vector3d x = shape.rotation().transpose() * (found.p_segment - shape.center());
    const Vector3d m = x.cwiseQuotient(shape.semi_axes().cwiseAbs2());
    const double turn = noise / (shape.semi_axes().minCoeff() * m.norm());
    EXPECT_LT((found.direction - shape.rotation() * m.normalized()).norm(), 1e-14 + 4 * turn)
        << trial;
    ++(shape.level(a) < 0 && shape.level(b) < 0 ? inside : crossing);
  }
  EXPECT_GT(inside, 3000);
  EXPECT_GT(crossing, 3000);
}

TEST(SegmentDistance, ThroughTheCenterStillHasADirection) {
  const Ellipsoid shape(Vector3d(1, 2, 3), Vector3d(0.3, 0.2, 0.1));
  for (const Vector3d& d : {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 0, 1),
                            Vector3d(0, 1e-300, 0), Vector3d(0.5, 0.5, 0.25)}) {
    const SegmentDistance found = segment_distance(shape.center() - d, shape.center() + d, shape);
    EXPECT_EQ(found.distance, 0);
    EXPECT_NEAR(found.direction.norm(), 1, 1e-15);
    EXPECT_NEAR(found.direction.dot(d.stableNormalized()), 0, 1e-15);
  }
}

TEST(SegmentDistance, DoesNotDependOnTheOrderOfTheEnds) {
  Generator generator(4);
  for (int trial = 0; trial < 8000; ++trial) {
    const SegmentCase c = random_segment_case(generator, trial);
    const SegmentDistance forth = segment_distance(c.a, c.b, c.shape);
    const SegmentDistance back = segment_distance(c.b, c.a, c.shape);
    EXPECT_NEAR(forth.distance, back.distance, kRounding * c.size()) << trial;
    EXPECT_EQ(forth.distance == 0, back.distance == 0) << trial;
  }
}

}  // namespace
}  // namespace bqsa::baselines
