#include "bqsa/geometry/nearest_plane.hpp"

#include <gtest/gtest.h>

#include "bqsa/geometry/separation.hpp"
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
using test_support::random_rotation;
using test_support::random_vector;
using test_support::surface_point;
using test_support::uniform;

struct Family {
  const char* name;
  Vector3d (*semi_axes)(Generator&);
  /// How far the bound of `separation` falls short of the distance, at its worst, at least.
  double shortfall_of_separation;
};
void PrintTo(const Family& family, std::ostream* out) { *out << family.name; }

class NearestPlaneOf : public ::testing::TestWithParam<Family> {
 protected:
  Ellipsoid shape(Generator& generator) const {
    const Vector3d semi_axes = GetParam().semi_axes(generator);
    return {random_vector<3>(generator, 1), semi_axes, random_rotation<3>(generator)};
  }
};

/// Bound, oracle and what the header states of them.
void expect_tight(const Ellipsoid& shape, const Vector3d& p1, const Vector3d& p2, double distance,
                  int i) {
  const NearestPlane<3> plane = nearest_plane<3>(shape, p1, p2);
  const double length = std::max(
      {(p1 - shape.center()).norm(), (p2 - shape.center()).norm(), shape.semi_axes().maxCoeff()});
  ASSERT_LE(plane.distance, distance + 2e-15 * length) << "case " << i;
  ASSERT_GE(plane.distance, distance - 4e-15 * length) << "case " << i;
  // What is returned is that plane's distance, as anybody can recompute it.
  const Vector3d& n = plane.normal;
  ASSERT_NEAR(n.norm(), 1, 1e-14) << "case " << i;
  const double again =
      std::min(n.dot(p1 - shape.center()), n.dot(p2 - shape.center())) - shape.support(n);
  ASSERT_NEAR(again, plane.distance, 1e-14 * length) << "case " << i;
  ASSERT_LE(plane.planes, 30) << "case " << i;
}

TEST_P(NearestPlaneOf, ReachesTheDistanceAndNeverExceedsIt) {
  Generator generator(40);
  int free = 0;
  double shortfall_of_separation = 0;
  for (int i = 0; i < 2000; ++i) {
    const Ellipsoid e = shape(generator);
    const double reach = i % 4 == 0 ? 100 : 1;  // far away, in part
    const Vector3d a = random_vector<3>(generator, reach);
    const Vector3d b = i % 5 == 0 ? a : random_vector<3>(generator, reach);
    const auto distance = static_cast<double>(DistanceOracle(a, b, e).distance());
    if (distance == 0) {
      ASSERT_LE(nearest_plane<3>(e, a, b).distance, 1e-14) << "case " << i;
      continue;
    }
    ++free;
    expect_tight(e, a, b, distance, i);
    shortfall_of_separation =
        std::max(shortfall_of_separation, 1 - separation<3>(e, a, b) / distance);
  }
  EXPECT_GT(free, 1500);
  EXPECT_GE(shortfall_of_separation, GetParam().shortfall_of_separation);
}

TEST_P(NearestPlaneOf, ReachesTheDistanceNearContact) {
  Generator generator(41);
  for (int i = 0; i < 1000; ++i) {
    const Ellipsoid e = shape(generator);
    const Vector3d on_surface = surface_point<3>(e, random_direction<3>(generator));
    const Vector3d normal = (e.rotation() * (e.rotation().transpose() * (on_surface - e.center()))
                                                .cwiseQuotient(e.semi_axes().cwiseAbs2()))
                                .normalized();
    const Vector3d along = normal.cross(random_direction<3>(generator)).normalized();
    const Vector3d nearest = on_surface + log_uniform(generator, 1e-9, 1e-2) * normal;
    const Vector3d a = nearest - uniform(generator, 0, 1) * along;
    const Vector3d b = nearest + uniform(generator, 0, 1) * along;
    const auto distance = static_cast<double>(DistanceOracle(a, b, e).distance());
    ASSERT_GT(distance, 0) << "case " << i;
    expect_tight(e, a, b, distance, i);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Families, NearestPlaneOf,
    ::testing::Values(
        Family{"balls",
               [](Generator& g) -> Vector3d { return Vector3d::Constant(uniform(g, 0.01, 1)); }, 0},
        Family{"stones",
               [](Generator& g) -> Vector3d {
                 return {uniform(g, 0.1, 1), uniform(g, 0.1, 1), uniform(g, 0.1, 1)};
               },
               0.3},
        Family{
            "needles",
            [](Generator& g) -> Vector3d { return Vector3d(1e-5, 1e-5, 1) * uniform(g, 0.01, 1); },
            0.99},
        Family{"sheets",
               [](Generator& g) -> Vector3d { return Vector3d(1, 1e-5, 1) * uniform(g, 0.01, 1); },
               0.99},
        Family{"blades",
               [](Generator&) -> Vector3d {
                 return {3e-3, 1, 1e-5};
               },
               0.99},
        Family{"mixed",
               [](Generator& g) -> Vector3d {
                 return {log_uniform(g, 1e-4, 1), log_uniform(g, 1e-4, 1), log_uniform(g, 1e-4, 1)};
               },
               0.9}),
    [](const auto& family) { return std::string(family.param.name); });

TEST(NearestPlane, BesideTheEdgeOfASheetItSeesTheWholeDistance) {
  // The example of separation.hpp: 100 mm away, beyond the edge.
  const Ellipsoid sheet(Vector3d::Zero(), {1e-4, 0.1, 10});
  const Vector3d a(0.002, 0.2, -0.3), b(0.003, 0.2, 0.3);
  EXPECT_NEAR(nearest_plane<3>(sheet, a, b).distance, 0.1, 1e-3);
  EXPECT_LT(separation<3>(sheet, a, b), 0.005);
}

TEST(NearestPlane, InThePlaneIsThatOfTheEmbeddedEllipse) {
  Generator generator(42);
  int free = 0;
  for (int i = 0; i < 1000; ++i) {
    const Ellipse e = test_support::random_ellipsoid<2>(generator, 1e-4, 1);
    const Vector2d a = random_vector<2>(generator, 1), b = random_vector<2>(generator, 1);
    const Ellipsoid solid = embedded(e);
    const Vector3d a3(a.x(), a.y(), 0), b3(b.x(), b.y(), 0);
    const auto distance = static_cast<double>(DistanceOracle(a3, b3, solid).distance());
    if (distance == 0) continue;
    ++free;
    ASSERT_NEAR(nearest_plane<2>(e, a, b).distance, distance, 4e-15) << i;
  }
  EXPECT_GT(free, 500);
}

TEST(NearestPlane, EndsAtTheFirstThatIsFarEnough) {
  Generator generator(43);
  int ended_early = 0;
  for (int i = 0; i < 500; ++i) {
    const Ellipsoid e = test_support::random_ellipsoid<3>(generator, 1e-3, 0.3);
    const Vector3d a = random_vector<3>(generator, 1), b = random_vector<3>(generator, 1);
    const NearestPlane<3> best = nearest_plane<3>(e, a, b);
    if (best.distance <= 0) continue;
    const NearestPlane<3> half = nearest_plane<3>(e, a, b, 0.5 * best.distance);
    ASSERT_GT(half.distance, 0.5 * best.distance) << i;
    ASSERT_LE(half.planes, best.planes) << i;
    ended_early += half.planes < best.planes;
    ASSERT_EQ(nearest_plane<3>(e, a, b, best.distance).distance, best.distance) << i;
  }
  EXPECT_GT(ended_early, 200);
}

TEST(NearestPlane, OfASegmentThroughTheCentreIsNegative) {
  const Ellipsoid e(Vector3d::Zero(), {0.1, 0.2, 0.3});
  EXPECT_LT(nearest_plane<3>(e, {-1, 0, 0}, {1, 0, 0}).distance, 0);
  EXPECT_LT(nearest_plane<3>(e, Vector3d::Zero(), Vector3d::Zero()).distance, 0);
  EXPECT_NEAR(nearest_plane<3>(e, Vector3d::Zero(), Vector3d::Zero()).normal.norm(), 1, 1e-15);
}

}  // namespace
}  // namespace bqsa
