#include "harness/judge/exact_distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "judge_scenes.hpp"
#include "support/distance_oracle.hpp"

namespace bqsa::harness {
namespace {

using test_support::DistanceOracle;
using test_support::Generator;
using test_support::log_uniform;
using test_support::random_direction;
using test_support::random_rotation;
using test_support::random_vector;
using test_support::Segment;
using test_support::segment_at;
using test_support::uniform;

/// From spheres to needles and sheets of axis ratio 1e8, from millimetres to kilometres.
Ellipsoid extreme_ellipsoid(Generator& generator, int kind) {
  const double size = log_uniform(generator, 1e-3, 1e3);
  const double thin = size * log_uniform(generator, 1e-8, 1);
  Eigen::Vector3d axes = Eigen::Vector3d::Constant(size);
  if (kind % 4 == 1) axes << thin, thin, size;
  if (kind % 4 == 2) axes << size, size, thin;
  if (kind % 4 == 3) axes << thin, size * uniform(generator, 0.3, 1), size;
  return {size * random_vector<3>(generator, 1), axes, random_rotation<3>(generator)};
}

/// Every third of random length is tangential, every seventh a point.
Segment extreme_segment(Generator& generator, const Ellipsoid& ellipsoid, int number) {
  const double size = ellipsoid.semi_axes().maxCoeff();
  const double length = number % 7 == 0 ? 0 : size * log_uniform(generator, 1e-3, 1e2);
  const double side = number % 2 == 0 ? 1 : -1;
  const double gap = side * size * log_uniform(generator, 1e-10, 1);
  return segment_at(generator, ellipsoid, length, gap, number % 3 == 0);
}

double size_of(const Segment& segment, const Ellipsoid& ellipsoid) {
  return std::max({(segment.a - ellipsoid.center()).norm(), (segment.b - ellipsoid.center()).norm(),
                   ellipsoid.semi_axes().maxCoeff()});
}

TEST(ExactDistance, EqualsALongDoubleReference) {
  Generator generator(1);
  int apart = 0, meeting = 0;
  double worst = 0;
  for (int k = 0; k < 8000; ++k) {
    const Ellipsoid ellipsoid = extreme_ellipsoid(generator, k);
    const Segment segment = extreme_segment(generator, ellipsoid, k);
    const SegmentDistance result = exact_distance(segment.a, segment.b, ellipsoid);
    const DistanceOracle oracle(segment.a, segment.b, ellipsoid);
    const double error = std::abs(result.distance - static_cast<double>(oracle.distance()));
    worst = std::max(worst, error / size_of(segment, ellipsoid));
    ASSERT_LE(error, 1e-12 * size_of(segment, ellipsoid)) << "case " << k;
    ++(result.distance > 0 ? apart : meeting);
  }
  EXPECT_GT(apart, 2000);
  EXPECT_GT(meeting, 2000);
  RecordProperty("worst_relative_error_in_1e-15", std::to_string(worst * 1e15));
}

TEST(ExactDistance, IsProvenByItsPointsAndItsPlane) {
  Generator generator(2);
  int apart = 0, meeting = 0;
  for (int k = 0; k < 100000; ++k) {
    const Ellipsoid ellipsoid = extreme_ellipsoid(generator, k);
    const Segment segment = extreme_segment(generator, ellipsoid, k);
    const SegmentDistance result = exact_distance(segment.a, segment.b, ellipsoid);
    const double rounding = 1e-12 * size_of(segment, ellipsoid);
    const auto height = [&](const Eigen::Vector3d& x) {
      return result.normal.dot(x - ellipsoid.center()) - ellipsoid.support(result.normal);
    };
    ASSERT_NEAR(result.normal.norm(), 1, 1e-12) << "case " << k;
    ASSERT_NEAR(std::min(height(segment.a), height(segment.b)), result.clearance(), rounding)
        << "case " << k;
    ASSERT_LE(height(result.on_ellipsoid), rounding) << "case " << k;
    const Eigen::Vector3d at = segment.a + result.t * (segment.b - segment.a);
    ASSERT_LE((result.on_segment - at).norm(), rounding) << "case " << k;
    if (result.distance > 0) {
      ASSERT_NEAR((result.on_segment - result.on_ellipsoid).norm(), result.distance, rounding)
          << "case " << k;
      ASSERT_EQ(result.depth, 0) << "case " << k;
      ++apart;
    } else {
      ++meeting;
    }
  }
  EXPECT_GT(apart, 20000);
  EXPECT_GT(meeting, 20000);
}

TEST(ExactDistance, ATranslationByTheDepthSeparates) {
  Generator generator(3);
  int meeting = 0;
  for (int k = 0; k < 20000; ++k) {
    const Ellipsoid ellipsoid = extreme_ellipsoid(generator, k);
    const Segment segment = extreme_segment(generator, ellipsoid, k);
    const SegmentDistance result = exact_distance(segment.a, segment.b, ellipsoid);
    if (result.distance > 0) continue;
    ++meeting;
    const double beyond = 1e-9 * size_of(segment, ellipsoid);
    const Eigen::Vector3d shift = (result.depth + beyond) * result.normal;
    ASSERT_GT(exact_distance(segment.a + shift, segment.b + shift, ellipsoid).distance, 0)
        << "case " << k;
  }
  EXPECT_GT(meeting, 5000);
}

TEST(ExactDistance, DepthIsExactToFirstOrderForShallowPenetrations) {
  Generator generator(4);
  for (int k = 0; k < 2000; ++k) {
    const Ellipsoid ellipsoid = test_support::random_ellipsoid<3>(generator, 0.1, 1);
    const Segment segment = segment_at(generator, ellipsoid, 0.01, -1e-6, true);
    const double depth = exact_distance(segment.a, segment.b, ellipsoid).depth;
    ASSERT_NEAR(depth, 1e-6, 1e-9) << "case " << k;
  }
}

TEST(ExactDistance, SphereHasAClosedForm) {
  Generator generator(5);
  for (int k = 0; k < 2000; ++k) {
    const Eigen::Vector3d center = random_vector<3>(generator, 1);
    const double radius = log_uniform(generator, 1e-3, 1);
    const Eigen::Vector3d a = random_vector<3>(generator, 2), b = random_vector<3>(generator, 2);
    const double t = std::clamp((center - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    const double clearance = (a + t * (b - a) - center).norm() - radius;
    const Ellipsoid sphere(center, Eigen::Vector3d::Constant(radius),
                           random_rotation<3>(generator));
    ASSERT_NEAR(exact_distance(a, b, sphere).distance, std::max(clearance, 0.0), 1e-13)
        << "case " << k;
  }
}

TEST(ExactDistance, CentreOfASheetIsAsDeepAsTheSheetIsThin) {
  const Ellipsoid sheet({1, 2, 3}, {10, 10, 1e-4});
  const SegmentDistance point = exact_distance(sheet.center(), sheet.center(), sheet);
  EXPECT_EQ(point.distance, 0);
  EXPECT_NEAR(point.depth, 1e-4, 1e-15);
  const SegmentDistance through = exact_distance({1, 2, 2.5}, {1, 2, 3.5}, sheet);
  EXPECT_EQ(through.distance, 0);
  EXPECT_NEAR(through.depth, 0.5 + 1e-4, 1e-12);
}

TEST(ExactDistance, SwappingTheEndsMirrorsTheParameter) {
  Generator generator(6);
  for (int k = 0; k < 2000; ++k) {
    const Ellipsoid ellipsoid = test_support::random_ellipsoid<3>(generator, 0.1, 1);
    const Segment segment = segment_at(generator, ellipsoid, 1, 0.01, true);
    const SegmentDistance there = exact_distance(segment.a, segment.b, ellipsoid);
    const SegmentDistance back = exact_distance(segment.b, segment.a, ellipsoid);
    ASSERT_NEAR(there.distance, back.distance, 1e-14) << "case " << k;
    ASSERT_NEAR(there.t, 1 - back.t, 1e-6) << "case " << k;
  }
}

}  // namespace
}  // namespace bqsa::harness
