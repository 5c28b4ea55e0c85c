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

template <int Dim>
void expect_outer_bound_contains_the_sum() {
  Generator generator(70 + Dim);
  for (int i = 0; i < 500; ++i) {
    const EllipsoidN<Dim> e = random_ellipsoid<Dim>(generator, 1e-3, 1);
    const double radius = test_support::log_uniform(generator, 1e-4, 0.3);
    const EllipsoidN<Dim> outer = outer_bound(e, radius);
    const double excess = outer_bound_excess(e, radius);
    double widest = 0;
    for (int k = 0; k < 200; ++k) {
      const Eigen::Matrix<double, Dim, 1> n = random_direction<Dim>(generator);
      const Eigen::Matrix<double, Dim, 1> p =
          surface_point<Dim>(e, random_direction<Dim>(generator)) + radius * n;
      ASSERT_LE(outer.level(p), 1e-11) << "case " << i << ": a point of the sum outside";
      const double gap = outer.support(n) - (e.support(n) + radius);
      ASSERT_GE(gap, -1e-12) << "case " << i;
      ASSERT_LE(gap, excess + 1e-12) << "case " << i;
    }
    for (int axis = 0; axis < Dim; ++axis) {
      const Eigen::Matrix<double, Dim, 1> n = e.rotation().col(axis);
      widest = std::max(widest, outer.support(n) - (e.support(n) + radius));
    }
    ASSERT_NEAR(widest, excess, 1e-12) << "case " << i << ": the excess is not attained";
  }
}

TEST(OuterBound, ContainsTheSumWithABallAndSticksOutNoFurtherThanStated) {
  expect_outer_bound_contains_the_sum<2>();
  expect_outer_bound_contains_the_sum<3>();
}

TEST(OuterBound, OfABallIsExact) {
  const Ellipsoid ball(Vector3d::Zero(), Vector3d::Constant(0.5));
  EXPECT_NEAR(outer_bound_excess(ball, 0.1), 0, 1e-15);
  EXPECT_LT((outer_bound(ball, 0.1).semi_axes() - Vector3d::Constant(0.6)).norm(), 1e-15);
}

TEST(OuterBound, OfRadiusZeroIsTheEllipsoidItself) {
  const Ellipse e({1, 2}, {0.3, 0.1});
  EXPECT_EQ(outer_bound(e, 0).semi_axes(), e.semi_axes());
  EXPECT_EQ(outer_bound_excess(e, 0), 0);
}

TEST(OuterBound, RefusesARadiusThatIsNone) {
  const Ellipse e({1, 2}, {0.3, 0.1});
  EXPECT_THROW(outer_bound(e, -1e-3), std::invalid_argument);
  EXPECT_THROW(outer_bound(e, std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
  EXPECT_THROW(outer_bound(e, std::numeric_limits<double>::infinity()), std::invalid_argument);
}

TEST(Grown, DoesNotContainTheSumWithABall) {
  // The figure for the semi-axes 0.4 m and 0.08 m and the radius 2 cm: up to 4.6 mm short.
  const Ellipse e({0, 0}, {0.4, 0.08});
  const double radius = 0.02;
  const Ellipse grown = e.grown(radius);
  double shortfall = 0;
  for (int k = 0; k <= 1000; ++k) {
    const double angle = k * 1e-3 * std::acos(0.0);
    const Vector2d n(std::cos(angle), std::sin(angle));
    shortfall = std::max(shortfall, e.support(n) + radius - grown.support(n));
  }
  EXPECT_NEAR(shortfall, 4.6e-3, 0.1e-3);
}

}  // namespace
}  // namespace bqsa
