#include "bqsa/geometry/separation.hpp"

#include <gtest/gtest.h>

#include "support/distance_oracle.hpp"
#include "support/sampling.hpp"

namespace bqsa {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test_support::DistanceOracle;
using test_support::Generator;
using test_support::log_uniform;
using test_support::random_direction;
using test_support::random_ellipsoid;
using test_support::random_vector;
using test_support::surface_point;
using test_support::uniform;

TEST(Separation, NeverExceedsTheDistanceAndIsPositiveExactlyForFreeSegments) {
  Generator generator(20);
  int free = 0, hit = 0;
  for (int i = 0; i < 3000; ++i) {
    const Ellipsoid e = random_ellipsoid<3>(generator, i % 3 == 0 ? 1e-4 : 0.05, 1);
    const Vector3d a = random_vector<3>(generator, 1);
    const Vector3d b = i % 10 == 0 ? a : random_vector<3>(generator, 1);
    const double bound = separation(e, a, b);
    const auto distance = static_cast<double>(DistanceOracle(a, b, e).distance());
    ASSERT_LE(bound, distance + 1e-12) << "case " << i;
    ASSERT_EQ(bound > 0, distance > 0) << "case " << i;
    ++(distance > 0 ? free : hit);
  }
  EXPECT_GT(free, 1000);
  EXPECT_GT(hit, 100);
}

TEST(Separation, IsTheDistanceForABall) {
  Generator generator(21);
  int free = 0;
  for (int i = 0; i < 1000; ++i) {
    const Ellipsoid ball(random_vector<3>(generator, 1), Vector3d::Constant(0.3));
    const Vector3d a = random_vector<3>(generator, 2), b = random_vector<3>(generator, 2);
    const auto distance = static_cast<double>(DistanceOracle(a, b, ball).distance());
    if (distance == 0) continue;
    ++free;
    ASSERT_NEAR(separation(ball, a, b), distance, 1e-12) << "case " << i;
  }
  EXPECT_GT(free, 500);
}

TEST(Separation, IsTheDistanceToFirstOrderNearContact) {
  Generator generator(22);
  for (int i = 0; i < 1000; ++i) {
    const Ellipse e = random_ellipsoid<2>(generator, 0.1, 1);
    const Vector2d on_surface = surface_point<2>(e, random_direction<2>(generator));
    const Vector2d normal = (e.quadratic_form() * (on_surface - e.center())).normalized();
    const Vector2d along(-normal.y(), normal.x());
    const double gap = log_uniform(generator, 1e-6, 1e-4);
    const Vector2d p = on_surface + gap * normal;
    // Between two parallel lines the distance of this link is the gap itself.
    const double bound = separation<2>(e, p - 0.3 * along, p + 0.4 * along);
    ASSERT_NEAR(bound, gap, 30 * gap * gap + 1e-14) << "case " << i;
  }
}

TEST(Separation, KeepsTheRadiusWhereLongerSemiAxesWouldNot) {
  // Semi-axes longer by the radius are up to 4.6 mm short of the sum of ellipse and ball: here a
  // link that misses the longer ellipse cuts into the capsule's room.
  const double radius = 0.02;
  const Ellipse e({0, 0}, {0.4, 0.08});
  const Ellipse longer({0, 0}, {0.42, 0.10});
  int cut = 0;
  for (int k = 1; k < 1000; ++k) {
    const double angle = k * 1e-3 * std::acos(0.0);
    const Vector2d n(std::cos(angle), std::sin(angle));
    const Vector2d along(-n.y(), n.x());
    const Vector2d p = (longer.support(n) + 1e-6) * n;
    const Vector2d a = p - along, b = p + along;
    const double distance = longer.support(n) + 1e-6 - e.support(n);  // of parallel lines
    ASSERT_FALSE(hits(polar_form(longer, a, b))) << k;
    ASSERT_LE(separation(e, a, b), distance + 1e-12) << k;
    cut += distance < radius - 1e-3;
  }
  EXPECT_GT(cut, 100);
}

TEST(Separation, OfASegmentThroughTheCentreIsNegative) {
  const Ellipsoid e(Vector3d::Zero(), {0.1, 0.2, 0.3});
  EXPECT_LT(separation<3>(e, {-1, 0, 0}, {1, 0, 0}), 0);
  EXPECT_LT(separation<3>(e, Vector3d::Zero(), Vector3d::Zero()), 0);
}

}  // namespace
}  // namespace bqsa
