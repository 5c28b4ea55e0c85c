// The ellipsoid of least volume around points: that it contains them, that none is smaller, and
// what degenerate points give.

#include "bqsa/envelope/least_ellipsoid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/exact_containment.hpp"
#include "support/sampling.hpp"

namespace bqsa {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using test_support::exact_level;
using test_support::Generator;
using test_support::log_uniform;
using test_support::Quad;
using test_support::random_direction;
using test_support::random_ellipsoid;
using test_support::random_rotation;
using test_support::random_vector;
using test_support::Rational;
using test_support::surface_point;
using test_support::uniform;

template <int Dim>
using VectorN = Eigen::Matrix<double, Dim, 1>;
template <int Dim>
using MatrixN = Eigen::Matrix<double, Dim, Dim>;
template <int Dim>
using Cloud = std::vector<VectorN<Dim>>;

// --- Points to envelope -------------------------------------------------------------------------

enum class Kind { kBox, kBall, kNormal, kEllipsoid, kFew, kGrid };
constexpr Kind kKinds[] = {Kind::kBox,       Kind::kBall, Kind::kNormal,
                           Kind::kEllipsoid, Kind::kFew,  Kind::kGrid};

template <int Dim>
Cloud<Dim> cloud(Kind kind, int count, Generator& generator) {
  const EllipsoidN<Dim> ellipsoid = random_ellipsoid<Dim>(generator, 0.01, 1);
  Cloud<Dim> points;
  if (kind == Kind::kFew) count = Dim + 1;
  for (int i = 0; i < count; ++i) {
    switch (kind) {
      case Kind::kBox:
      case Kind::kFew:
        points.push_back(random_vector<Dim>(generator, 1));
        break;
      case Kind::kBall:
        points.push_back(random_direction<Dim>(generator) *
                         std::pow(uniform(generator, 0, 1), 1.0 / Dim));
        break;
      case Kind::kNormal:
        points.push_back(VectorN<Dim>::NullaryExpr(
            [&](Eigen::Index) { return test_support::normal(generator); }));
        break;
      case Kind::kEllipsoid:
        points.push_back(surface_point<Dim>(ellipsoid, random_direction<Dim>(generator)));
        break;
      case Kind::kGrid:  // many in the same place, many touch
        points.push_back((2 * random_vector<Dim>(generator, 1)).array().round());
        break;
    }
  }
  return points;
}

/// Stretched, turned and moved: axis ratios up to `ratio`.
template <int Dim>
Cloud<Dim> distorted(Cloud<Dim> points, double ratio, double offset, double scale,
                     Generator& generator) {
  const MatrixN<Dim> turn = random_rotation<Dim>(generator);
  const VectorN<Dim> stretch =
      VectorN<Dim>::NullaryExpr([&](Eigen::Index) { return log_uniform(generator, 1 / ratio, 1); });
  const VectorN<Dim> shift = random_vector<Dim>(generator, offset);
  for (VectorN<Dim>& p : points) p = scale * (turn * stretch.cwiseProduct(p) + shift);
  return points;
}

// --- Containment --------------------------------------------------------------------------------

template <int Dim>
void expect_a_million_points_inside() {
  Generator generator(700 + Dim);
  for (const Kind kind : {Kind::kBall, Kind::kEllipsoid, Kind::kBox}) {
    const Cloud<Dim> points =
        distorted<Dim>(cloud<Dim>(kind, 1'000'000, generator), 100, 3, 1, generator);
    const LeastEllipsoid<Dim> least = least_ellipsoid<Dim>(points);
    EXPECT_LE(least.volume_gap, 1e-6);
    EXPECT_GE(least.volume_gap, 0);
    std::size_t inside = 0;
    for (const VectorN<Dim>& p : points) {
      inside += exact_level<Quad>(least.shape, p) <= 0 && least.shape.level(p) <= 0;
    }
    EXPECT_EQ(inside, points.size()) << "kind " << static_cast<int>(kind);
  }
}

TEST(LeastEllipsoid, ContainsAMillionPoints) {
  expect_a_million_points_inside<2>();
  expect_a_million_points_inside<3>();
}

/// In exact arithmetic, for thin sets and all scales, and as `level` computes it.
template <int Dim>
void expect_all_points_inside_exactly() {
  Generator generator(710 + Dim);
  int cases = 0;
  for (const double ratio : {1.0, 1e3, 1e7}) {
    for (const double offset : {0.0, 1e4}) {
      for (const double scale : {1e-40, 1e-3, 1.0, 1e40}) {
        for (const Kind kind : kKinds) {
          const Cloud<Dim> points =
              distorted<Dim>(cloud<Dim>(kind, 40, generator), ratio, offset, scale, generator);
          const LeastEllipsoid<Dim> least = least_ellipsoid<Dim>(points);
          for (const VectorN<Dim>& p : points) {
            ASSERT_LE(exact_level<Rational>(least.shape, p), 0)
                << "ratio " << ratio << " offset " << offset << " scale " << scale << " kind "
                << static_cast<int>(kind);
            ASSERT_LE(least.shape.level(p), 0) << "as computed";
          }
          ++cases;
        }
      }
    }
  }
  EXPECT_EQ(cases, 144);
}

TEST(LeastEllipsoid, ContainsItsPointsInExactArithmetic) {
  expect_all_points_inside_exactly<2>();
  expect_all_points_inside_exactly<3>();
}

// --- Least volume -------------------------------------------------------------------------------

/// The determinant of S of the contacts, in exact arithmetic.
template <int Dim>
Rational spread(const Cloud<Dim>& points, const std::vector<Contact>& contacts) {
  Rational total = 0, S[Dim][Dim], center[Dim];
  for (const Contact& contact : contacts) {
    const Rational weight(contact.weight);
    total += weight;
    for (int j = 0; j < Dim; ++j) center[j] += weight * Rational(points[contact.point](j));
  }
  for (int j = 0; j < Dim; ++j) center[j] /= total;
  for (const Contact& contact : contacts) {
    const Rational weight = Rational(contact.weight) / total;
    for (int j = 0; j < Dim; ++j) {
      for (int k = 0; k < Dim; ++k) {
        S[j][k] += weight * (Rational(points[contact.point](j)) - center[j]) *
                   (Rational(points[contact.point](k)) - center[k]);
      }
    }
  }
  if constexpr (Dim == 2) return S[0][0] * S[1][1] - S[0][1] * S[1][0];
  return S[0][0] * (S[1][1] * S[2][2] - S[1][2] * S[2][1]) -
         S[0][1] * (S[1][0] * S[2][2] - S[1][2] * S[2][0]) +
         S[0][2] * (S[1][0] * S[2][1] - S[1][1] * S[2][0]);
}

/// The proof of the header in exact arithmetic: product² <= (1 + gap)² d^d det S, and the gap is
/// small.
template <int Dim>
void expect_contacts_to_prove_the_gap() {
  Generator generator(720 + Dim);
  int cases = 0;
  for (const double ratio : {1.0, 1e3, 1e6}) {
    for (const Kind kind : kKinds) {
      for (const int count : {20, 1000}) {
        const Cloud<Dim> points =
            distorted<Dim>(cloud<Dim>(kind, count, generator), ratio, 1, 1, generator);
        const LeastEllipsoid<Dim> least = least_ellipsoid<Dim>(points);
        Rational product = 1;
        for (const double axis : least.shape.semi_axes()) product *= Rational(axis);
        for (const Contact& contact : least.contacts) ASSERT_GT(contact.weight, 0);
        const Rational bound = Rational(Dim == 2 ? 4 : 27) * spread<Dim>(points, least.contacts);
        const double ratio_of_squares = static_cast<double>(Rational(product * product / bound));
        const double gap = std::sqrt(ratio_of_squares) - 1;
        ASSERT_NEAR(gap, least.volume_gap, 1e-10) << "kind " << static_cast<int>(kind);
        ASSERT_LE(gap, 1e-6) << "ratio " << ratio << " kind " << static_cast<int>(kind);
        ASSERT_GE(gap, 0);
        ++cases;
      }
    }
  }
  EXPECT_EQ(cases, 36);
}

TEST(LeastEllipsoid, ProvesThatNoneIsMuchSmaller) {
  expect_contacts_to_prove_the_gap<2>();
  expect_contacts_to_prove_the_gap<3>();
}

template <int Dim>
void expect_product(const Cloud<Dim>& points, double product, const std::string& what) {
  const double found = least_ellipsoid<Dim>(points).shape.semi_axes().prod();
  EXPECT_NEAR(found / product, 1, 2e-6) << what;
}

/// Corners of the box [-1, 1]^Dim.
template <int Dim>
Cloud<Dim> cube_corners() {
  Cloud<Dim> points;
  for (int corner = 0; corner < 1 << Dim; ++corner) {
    points.push_back(VectorN<Dim>::NullaryExpr(
        [&](Eigen::Index k) { return (corner >> k & 1) != 0 ? 1.0 : -1.0; }));
  }
  return points;
}

/// Corners of a regular simplex on the unit sphere.
template <int Dim>
Cloud<Dim> simplex_corners() {
  if constexpr (Dim == 2) {
    const double h = std::sqrt(3.0) / 2;
    return {{1, 0}, {-0.5, h}, {-0.5, -h}};
  } else {
    Cloud<3> points = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    for (Vector3d& p : points) p /= std::sqrt(3.0);
    return points;
  }
}

/// Points whose least ellipsoid is known, and its affine images, whose product of axes is |det|
/// times as much.
template <int Dim>
void expect_known_volumes() {
  Generator generator(730 + Dim);
  Cloud<Dim> cross;
  for (int k = 0; k < Dim; ++k) {
    cross.push_back(VectorN<Dim>::Unit(k));
    cross.push_back(-VectorN<Dim>::Unit(k));
  }
  for (int i = 0; i < 200; ++i) {
    const MatrixN<Dim> M = random_rotation<Dim>(generator) *
                           VectorN<Dim>::NullaryExpr([&](Eigen::Index) {
                             return log_uniform(generator, 1e-3, 1);
                           }).asDiagonal() *
                           random_rotation<Dim>(generator);
    const VectorN<Dim> shift = random_vector<Dim>(generator, 1);
    const double det = std::abs(M.determinant());
    const auto image = [&](Cloud<Dim> points) {
      for (VectorN<Dim>& p : points) p = M * p + shift;
      return points;
    };
    const std::string number = " of case " + std::to_string(i);
    expect_product<Dim>(image(cube_corners<Dim>()), det * std::pow(Dim, Dim / 2.0), "box" + number);
    expect_product<Dim>(image(simplex_corners<Dim>()), det, "simplex" + number);
    Cloud<Dim> samples = cross;  // of the unit sphere, of which these alone suffice
    for (int k = 0; k < 100; ++k) samples.push_back(random_direction<Dim>(generator));
    expect_product<Dim>(image(cross), det, "axes" + number);
    expect_product<Dim>(image(samples), det, "ellipsoid" + number);
  }
}

TEST(LeastEllipsoid, IsTheKnownOneOfBoxesSimplicesAndEllipsoids) {
  expect_known_volumes<2>();
  expect_known_volumes<3>();
}

TEST(LeastEllipsoid, OfATriangleIsSteinersEllipse) {
  Generator generator(740);
  for (int i = 0; i < 300; ++i) {
    const Cloud<2> corners = cloud<2>(Kind::kFew, 3, generator);
    const Vector2d u = corners[1] - corners[0], v = corners[2] - corners[0];
    const double area = std::abs(u.x() * v.y() - u.y() * v.x()) / 2;
    const LeastEllipsoid<2> least = least_ellipsoid<2>(corners);
    EXPECT_NEAR(least.shape.semi_axes().prod() / (4 / (3 * std::sqrt(3.0)) * area), 1, 1e-6);
    const Vector2d centroid = (corners[0] + corners[1] + corners[2]) / 3;
    EXPECT_LT((least.shape.center() - centroid).norm(), 1e-6) << "case " << i;
  }
}

TEST(LeastEllipsoid, FindsPlaceAndAxesOfAnEllipsoidByItsSurface) {
  Generator generator(741);
  for (int i = 0; i < 50; ++i) {
    const Ellipsoid e = random_ellipsoid<3>(generator, 0.01, 1);
    Cloud<3> points;
    for (int k = 0; k < 2000; ++k) {
      points.push_back(surface_point<3>(e, random_direction<3>(generator)));
    }
    const Ellipsoid found = least_ellipsoid<3>(points).shape;
    for (int k = 0; k < 100; ++k) {
      const Vector3d n = random_direction<3>(generator);
      ASSERT_NEAR(found.support(n) + n.dot(found.center() - e.center()), e.support(n),
                  1e-2 * e.support(n))
          << "case " << i;
    }
  }
}

/// Khachiyan's algorithm as first published (1996), to the volume over which the optimum is at most
/// (1 + e)^(d/2) smaller: slow and simple.
template <int Dim>
double khachiyan(const Cloud<Dim>& points, double e) {
  const auto m = static_cast<Eigen::Index>(points.size());
  Eigen::Matrix<double, Dim + 1, Eigen::Dynamic> q(Dim + 1, m);
  for (Eigen::Index i = 0; i < m; ++i) q.col(i) << points[static_cast<std::size_t>(i)], 1;
  Eigen::VectorXd u = Eigen::VectorXd::Constant(m, 1.0 / static_cast<double>(m));
  constexpr double kN = Dim + 1;
  for (;;) {
    const Eigen::Matrix<double, Dim + 1, Dim + 1> X = q * u.asDiagonal() * q.transpose();
    const Eigen::VectorXd kappa = (q.array() * (X.inverse() * q).array()).colwise().sum();
    Eigen::Index j = 0;
    const double most = kappa.maxCoeff(&j);
    if (most <= kN * (1 + e)) return std::sqrt(X.determinant()) * std::pow(Dim, Dim / 2.0);
    const double step = (most - kN) / (kN * (most - 1));
    u *= 1 - step;
    u(j) += step;
  }
}

TEST(LeastEllipsoid, IsKhachiyansOfRandomPoints) {
  Generator generator(750);
  int cases = 0;
  for (const Kind kind : {Kind::kBox, Kind::kBall, Kind::kNormal, Kind::kFew}) {
    for (int i = 0; i < 5; ++i) {
      const Cloud<3> solid = cloud<3>(kind, 30, generator);
      EXPECT_NEAR(least_ellipsoid<3>(solid).shape.semi_axes().prod() / khachiyan<3>(solid, 3e-5), 1,
                  1e-4);
      const Cloud<2> flat = cloud<2>(kind, 30, generator);
      EXPECT_NEAR(least_ellipsoid<2>(flat).shape.semi_axes().prod() / khachiyan<2>(flat, 3e-5), 1,
                  1e-4);
      ++cases;
    }
  }
  EXPECT_EQ(cases, 20);
}

TEST(LeastEllipsoid, TakesTheGapAskedFor) {
  Generator generator(751);
  const Cloud<3> points = cloud<3>(Kind::kBall, 10'000, generator);
  for (const double gap : {1e-2, 1e-4, 1e-6, 1e-9}) {
    EXPECT_LE(least_ellipsoid<3>(points, {.volume_gap = gap}).volume_gap, gap);
  }
}

// --- Flat and thin sets -------------------------------------------------------------------------

template <int Dim>
std::string refusal(const Cloud<Dim>& points, const LeastEllipsoidSettings& settings = {}) {
  try {
    least_ellipsoid<Dim>(points, settings);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

/// Points of a plane, a line or a point (columns of `directions`), with as much rounding as tilted
/// ones have.
Cloud<3> flat_points(const Eigen::Matrix<double, 3, Eigen::Dynamic>& directions, int count,
                     Generator& generator) {
  const Vector3d origin = random_vector<3>(generator, 1);
  Cloud<3> points;
  for (int i = 0; i < count; ++i) {
    const Eigen::VectorXd x = Eigen::VectorXd::NullaryExpr(
        directions.cols(), [&](Eigen::Index) { return uniform(generator, -1, 1); });
    points.emplace_back(origin + directions * x);
  }
  return points;
}

TEST(LeastEllipsoid, RefusesFlatPointsWithoutThickness) {
  using testing::HasSubstr;
  Generator generator(760);
  const Matrix3d R = random_rotation<3>(generator);
  EXPECT_THAT(refusal<3>(flat_points(R.leftCols(0), 1, generator)), HasSubstr("points on a point"));
  EXPECT_THAT(refusal<3>(flat_points(R.leftCols(0), 9, generator)), HasSubstr("points on a point"));
  EXPECT_THAT(refusal<3>(flat_points(R.leftCols(1), 9, generator)), HasSubstr("points on a line"));
  EXPECT_THAT(refusal<3>(flat_points(R.leftCols(2), 9, generator)), HasSubstr("points on a plane"));
  EXPECT_THAT(refusal<3>({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), HasSubstr("points on a plane"));
  EXPECT_THAT(refusal<2>({{0.1, 0.3}, {0.2, 0.6}, {0.3, 0.9}}), HasSubstr("points on a line"));
  EXPECT_THAT(refusal<2>({{1, 2}, {1, 2}}), HasSubstr("points on a point"));
}

TEST(LeastEllipsoid, OfFlatPointsIsTheLeastOneInTheirFlatWithTheLeastSemiAxisAcross) {
  Generator generator(761);
  constexpr double kThin = 1e-4;
  const LeastEllipsoidSettings settings{.least_semi_axis = kThin};
  for (int i = 0; i < 100; ++i) {
    const Matrix3d R = random_rotation<3>(generator);
    for (int span = 0; span < 3; ++span) {
      Cloud<3> points = flat_points(R.leftCols(span), 30, generator);
      const LeastEllipsoid<3> least = least_ellipsoid<3>(points, settings);
      ASSERT_EQ(least.span, span) << "case " << i;
      ASSERT_LE(least.volume_gap, 1e-6);
      for (int k = span; k < 3; ++k) ASSERT_NEAR(least.shape.semi_axes()(k), kThin, 1e-6 * kThin);
      for (const Vector3d& p : points) ASSERT_LE(exact_level<Rational>(least.shape, p), 0);
      if (span == 2) {
        Cloud<2> in_plane;
        for (const Vector3d& p : points) in_plane.push_back(R.leftCols<2>().transpose() * p);
        ASSERT_NEAR(least.shape.semi_axes().head<2>().prod() /
                        least_ellipsoid<2>(in_plane).shape.semi_axes().prod(),
                    1, 2e-6);
      }
    }
  }
}

TEST(LeastEllipsoid, OfThePapersWallIsASheet) {
  // A rectangle of 200 mm by 20 m, at (547, 170, 634) mm in a plane x = const.
  Cloud<3> corners;
  for (const double y : {-0.1, 0.1}) {
    for (const double z : {-10.0, 10.0}) corners.emplace_back(0.547, 0.17 + y, 0.634 + z);
  }
  const Ellipsoid wall = least_ellipsoid<3>(corners, {.least_semi_axis = 1e-4}).shape;
  EXPECT_TRUE(wall.semi_axes().isApprox(
      Vector3d(10 * std::numbers::sqrt2, 0.1 * std::numbers::sqrt2, 1e-4), 1e-6))
      << wall.semi_axes().transpose();
  EXPECT_NEAR(std::abs(wall.rotation()(0, 2)), 1, 1e-9);
}

TEST(LeastEllipsoid, GrowsThinSetsToTheLeastSemiAxisAndSaysWhatThatCosts) {
  Generator generator(762);
  for (int i = 0; i < 50; ++i) {
    Cloud<3> points = cloud<3>(Kind::kBox, 50, generator);
    const Matrix3d R = random_rotation<3>(generator);
    for (Vector3d& p : points) p = R * p.cwiseProduct(Vector3d(1, 1, 1e-3));
    const double own = least_ellipsoid<3>(points).shape.semi_axes().minCoeff();
    const LeastEllipsoid<3> grown = least_ellipsoid<3>(points, {.least_semi_axis = 3 * own});
    EXPECT_EQ(grown.span, 3);
    EXPECT_NEAR(grown.shape.semi_axes().minCoeff(), 3 * own, 1e-6 * own);
    EXPECT_NEAR(grown.volume_gap, 2, 1e-5);
    for (const Vector3d& p : points) ASSERT_LE(exact_level<Rational>(grown.shape, p), 0);
  }
}

TEST(LeastEllipsoid, ContainsSetsOnBothSidesOfFlat) {
  Generator generator(763);
  int flat = 0, thin = 0;
  for (int i = 0; i < 200; ++i) {
    Cloud<3> points = cloud<3>(Kind::kBox, 20, generator);
    const Matrix3d R = random_rotation<3>(generator);
    const double thickness = log_uniform(generator, 1e-11, 1e-6);
    for (Vector3d& p : points) p = R * p.cwiseProduct(Vector3d(1, 1, thickness));
    const LeastEllipsoid<3> least = least_ellipsoid<3>(points, {.least_semi_axis = 1e-12});
    (least.span == 2 ? flat : thin) += 1;
    for (const Vector3d& p : points) ASSERT_LE(exact_level<Rational>(least.shape, p), 0) << i;
  }
  EXPECT_GT(flat, 20);
  EXPECT_GT(thin, 20);
}

// --- Input that is none -------------------------------------------------------------------------

TEST(LeastEllipsoid, RefusesWhatAreNoPointsAndSaysWhy) {
  using testing::HasSubstr;
  const Cloud<3> good = cube_corners<3>();
  EXPECT_THAT(refusal<3>({}), HasSubstr("expected points, got none"));
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1e60}) {
    Cloud<3> points = good;
    points[5].y() = bad;
    EXPECT_THAT(refusal<3>(points), HasSubstr("in point 5")) << bad;
  }
  EXPECT_THAT(refusal<3>(good, {.volume_gap = 0}), HasSubstr("positive volume gap"));
  EXPECT_THAT(refusal<3>(good, {.least_semi_axis = -1}), HasSubstr("least semi-axis"));
  EXPECT_EQ(refusal<3>(good), "accepted");
}

}  // namespace
}  // namespace bqsa
