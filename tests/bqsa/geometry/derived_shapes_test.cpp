// Shadows (the paper's Lemma 1) and the outer bound of a link's radius.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "bqsa/geometry/ellipsoid.hpp"
#include "bqsa/geometry/segment_test.hpp"
#include "segment_families.hpp"
#include "support/sampling.hpp"

namespace bqsa {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Selector = Eigen::Matrix<double, 2, 3>;
using test_support::Generator;
using test_support::random_direction;
using test_support::random_ellipsoid;
using test_support::surface_point;

Selector plane(const Vector3d& u, const Vector3d& v) {
  Selector selector;
  selector << u.transpose(), v.transpose();
  return selector;
}

struct NamedPlane {
  std::string name;
  Selector selector;
};

void PrintTo(const NamedPlane& plane, std::ostream* out) { *out << plane.name; }

const Vector3d kX = Vector3d::UnitX(), kY = Vector3d::UnitY(), kZ = Vector3d::UnitZ();
const NamedPlane kPlanes[] = {{"XY", plane(kX, kY)},
                              {"YZ", plane(kY, kZ)},
                              {"XZ", plane(kX, kZ)},
                              {"Oblique", plane(Vector3d(2, 1, 2) / 3, Vector3d(-2, 2, 1) / 3)}};

class Shadow : public testing::TestWithParam<NamedPlane> {};

TEST_P(Shadow, IsWhatTheProjectedPointsFill) {
  const Selector& S = GetParam().selector;
  Generator generator(60);
  for (int i = 0; i < 200; ++i) {
    const Ellipsoid e = random_ellipsoid<3>(generator, 0.01, 1);
    const Ellipse dark = shadow(e, S);
    for (int k = 0; k < 200; ++k) {
      const Vector3d p = surface_point<3>(e, random_direction<3>(generator));
      ASSERT_LE(dark.level(S * p), 1e-9) << "case " << i << ": a projected point outside";
      // The surface point whose normal lies in the plane projects onto the shadow's outline.
      const Vector2d n = random_direction<2>(generator);
      const Vector3d normal = S.transpose() * n;
      const Vector3d s = e.semi_axes().cwiseProduct(e.rotation().transpose() * normal).normalized();
      ASSERT_NEAR(dark.level(S * surface_point<3>(e, s)), 0, 1e-9) << "case " << i;
      ASSERT_NEAR(dark.support(n), e.support(normal), 1e-12) << "case " << i;
    }
  }
}

TEST_P(Shadow, HasTheMatrixOfLemma1) {
  const Selector& S = GetParam().selector;
  Generator generator(61);
  for (int i = 0; i < 500; ++i) {
    const Ellipsoid e = random_ellipsoid<3>(generator, 0.05, 1);
    const Eigen::Matrix2d expected =
        (S * e.quadratic_form().inverse() * S.transpose()).eval().inverse();
    ASSERT_LT((shadow(e, S).quadratic_form() - expected).norm(), 1e-9 * expected.norm())
        << "case " << i;
  }
}

TEST_P(Shadow, DisjointImpliesDisjointInSpace) {
  const Selector& S = GetParam().selector;
  Generator generator(62);
  int disjoint_shadows = 0, overlooked = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto [e, p1, p2] = test_support::make_pair<3>(test_support::Family::kRandom, generator);
    const bool shadow_hit = hits(polar_form<2>(shadow(e, S), Vector2d(S * p1), Vector2d(S * p2)));
    const bool hit = hits(polar_form<3>(e, p1, p2));
    ASSERT_TRUE(shadow_hit || !hit) << "case " << i;
    disjoint_shadows += !shadow_hit;
    overlooked += shadow_hit && !hit;
  }
  EXPECT_GT(disjoint_shadows, 500);
  EXPECT_GT(overlooked, 500) << "the converse would hold";
}

TEST_P(Shadow, OfANeedleKeepsItsThickness) {
  const Selector& S = GetParam().selector;
  const Vector3d along = S.row(0).transpose();
  Eigen::Matrix3d rotation;
  rotation << along, S.row(1).transpose(), along.cross(Vector3d(S.row(1).transpose()));
  const Ellipse dark = shadow({Vector3d::Zero(), {1, 1e-5, 1e-5}, rotation}, S);
  EXPECT_NEAR(dark.semi_axes().maxCoeff(), 1, 1e-12);
  EXPECT_NEAR(dark.semi_axes().minCoeff(), 1e-5, 1e-12 * 1e-5 + 1e-15);
}

INSTANTIATE_TEST_SUITE_P(Planes, Shadow, testing::ValuesIn(kPlanes),
                         [](const auto& parameter) { return parameter.param.name; });

TEST(Lemma1, HasNoConverse) {
  // All three coordinate shadows meet; the link passes a corner that the ball does not reach.
  const Ellipsoid ball(Vector3d::Zero(), Vector3d::Ones());
  const Vector3d p1(0.7, 0.7, 0.7), p2(2, 2, 2);
  for (const NamedPlane& plane : kPlanes) {
    if (plane.name == "Oblique") continue;
    const Selector& S = plane.selector;
    EXPECT_TRUE(hits(polar_form<2>(shadow(ball, S), Vector2d(S * p1), Vector2d(S * p2))))
        << plane.name;
  }
  EXPECT_FALSE(hits(polar_form<3>(ball, p1, p2)));
}

TEST(ShadowSelector, MustBeOrthonormal) {
  const Ellipsoid ball(Vector3d::Zero(), Vector3d::Ones());
  EXPECT_THROW(shadow(ball, plane(kX, kX)), std::invalid_argument);
  EXPECT_THROW(shadow(ball, plane(2 * kX, kY)), std::invalid_argument);
  EXPECT_THROW(shadow(ball, Selector::Constant(std::numeric_limits<double>::quiet_NaN())),
               std::invalid_argument);
}

}  // namespace
}  // namespace bqsa
