// Whole-number geometry against 113-bit arithmetic from centre, axes and rotation, and counts against
// the closed forms that detectors declare.
#include "harness/claims/whole_number_geometry.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>

#include "harness/claims/estimator.hpp"
#include "harness/claims/laboratory.hpp"
#include "harness/measuring/detector.hpp"
#include "harness/methods.hpp"
#include "support/exact_segment_test.hpp"

namespace bqsa::harness::claims {
namespace {

template <int Dim>
Eigen::Matrix<double, Dim, 1> as_double(const WholeVector<Dim>& p) {
  Eigen::Matrix<double, Dim, 1> v;
  for (int k = 0; k < Dim; ++k) v(k) = static_cast<double>(p[static_cast<std::size_t>(k)]);
  return v;
}

/// The same ellipsoid by the singular values of L.
template <int Dim>
EllipsoidN<Dim> as_ellipsoid(const WholeEllipsoid<Dim>& whole) {
  Eigen::Matrix<double, Dim, Dim> L;
  for (int row = 0; row < Dim; ++row) {
    L.row(row) = as_double<Dim>(whole.L[static_cast<std::size_t>(row)]).transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix<double, Dim, Dim>> svd(L, Eigen::ComputeFullU);
  Eigen::Matrix<double, Dim, Dim> R = svd.matrixU();
  if (R.determinant() < 0) R.col(0) *= -1;
  return {as_double<Dim>(whole.center), svd.singularValues(), R};
}

template <int Dim>
void compare_with_the_exact_test(std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  int compared = 0, counts[6] = {};
  for (int pair = 0; pair < 20000; ++pair) {
    const auto ellipsoid = random_ellipsoid<Dim>(generator, 4);
    const int half_width = pair % 2 == 0 ? 8 : 2;
    const auto p1 = random_point<Dim>(generator, half_width);
    const auto p2 = random_point<Dim>(generator, half_width);
    const auto u1 = ball_point<Dim>(ellipsoid, p1), u2 = ball_point<Dim>(ellipsoid, p2);
    const Whole radius = ball_radius<Dim>(ellipsoid);
    const BallPosition position = ball_position<Dim>(u1, u2, radius);
    const auto exact = test_support::exact_segment_test<Dim>(
        as_ellipsoid<Dim>(ellipsoid), as_double<Dim>(p1), as_double<Dim>(p2));
    // Axes and rotation are rounded to 16 digits: what is closer to a decision than that is left out.
    const auto close = [](test_support::Quad x) { return x > -1e-9 && x < 1e-9; };
    if (close(exact.start_level) || close(exact.end_level) || close(exact.discriminant())) continue;
    ++compared;
    ++counts[exact.category()];
    ASSERT_EQ(static_cast<int>(position.category()), exact.category()) << "pair " << pair;
    ASSERT_EQ(static_cast<int>(category(polar_form_of<Dim>(u1, u2, radius))), exact.category());
    EXPECT_FALSE(position.touches);
  }
  EXPECT_GT(compared, 15000);
  for (int c = 1; c <= 5; ++c) EXPECT_GT(counts[c], 100) << "category " << c;
}

TEST(WholeNumberGeometry, HasTheCategoriesOfTheExactTest) {
  compare_with_the_exact_test<2>(1);
  compare_with_the_exact_test<3>(2);
}

TEST(WholeNumberGeometry, KnowsTouching) {
  const WholeEllipsoid<2> circle{{WholeVector<2>{5, 0}, WholeVector<2>{0, 5}}, {0, 0}};
  const auto position = [&](WholeVector<2> p1, WholeVector<2> p2) {
    return ball_position<2>(ball_point<2>(circle, p1), ball_point<2>(circle, p2),
                            ball_radius<2>(circle));
  };
  EXPECT_TRUE(position({-1, 5}, {7, 5}).touches);                         // tangent
  EXPECT_TRUE(position({3, 4}, {6, 8}).touches);                          // ends on it, outwards
  EXPECT_FALSE(position({3, 4}, {0, 0}).touches);                         // ends on it, inwards
  EXPECT_FALSE(position({1, 5}, {7, 5}).meets);                           // tangent beyond its end
  EXPECT_EQ(position({3, 4}, {-3, 4}).category(), Category::kContained);  // a chord
}

TEST(WholeNumberGeometry, ShadowsAreThoseOfTheEllipsoid) {
  std::mt19937_64 generator(3);
  int compared = 0;
  for (int pair = 0; pair < 5000; ++pair) {
    const auto ellipsoid = random_ellipsoid<3>(generator, 4);
    const auto p1 = random_point<3>(generator, 8), p2 = random_point<3>(generator, 8);
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3;
      Eigen::Matrix<double, 2, 3> selector = Eigen::Matrix<double, 2, 3>::Zero();
      selector(0, k) = selector(1, l) = 1;
      const auto exact = test_support::exact_segment_test<2>(
          shadow(as_ellipsoid<3>(ellipsoid), selector), selector * as_double<3>(p1),
          selector * as_double<3>(p2));
      const auto close = [](test_support::Quad x) { return x > -1e-9 && x < 1e-9; };
      if (close(exact.start_level) || close(exact.end_level) || close(exact.discriminant()))
        continue;
      ++compared;
      ASSERT_EQ(hits(shadow_polar_form(ellipsoid, k, l, p1, p2)), exact.category() >= 3);
    }
  }
  EXPECT_GT(compared, 12000);
}

TEST(WholeNumberGeometry, ConicsVanishOnTheEllipse) {
  std::mt19937_64 generator(4);
  for (int n = 0; n < 1000; ++n) {
    auto ellipse = random_ellipsoid<2>(generator, 5);
    ellipse.center = random_point<2>(generator, 5);
    const Conic<Whole> G = conic_of(ellipse);
    // c + L (3, 4) / 5 lies on it: five times the point, 25 times the value.
    const Whole r2 = ball_radius<2>(ellipse) * ball_radius<2>(ellipse);
    const Whole x = 5 * ellipse.center[0] + 3 * ellipse.L[0][0];
    const Whole y = 5 * ellipse.center[1] + 3 * ellipse.L[1][0] + 4 * ellipse.L[1][1];
    const Whole value =
        G.A * x * x + G.B * x * y + G.C * y * y + 5 * G.D * x + 5 * G.E * y + 25 * G.F;
    EXPECT_TRUE(value == 0);
    const Whole cx = ellipse.center[0], cy = ellipse.center[1];
    const Whole at_center =
        G.A * cx * cx + G.B * cx * cy + G.C * cy * cy + G.D * cx + G.E * cy + G.F;
    EXPECT_TRUE(at_center == -r2);
  }
}

TEST(Counts, AreThoseThatTheDetectorsDeclare) {
  for (const int dimension : {2, 3}) {
    const WorkloadSize size{
        .dimension = dimension, .links = 9, .obstacles = 3, .test_points = {5, 8}};
    Arguments arguments;
    for (const auto& [name, value] :
         std::vector<std::pair<std::string, int>>{{"dimension", dimension},
                                                  {"links", 9},
                                                  {"obstacles", 3},
                                                  {"points_of_link", 5},
                                                  {"points_of_obstacle", 8}}) {
      arguments.set(name, std::to_string(value));
    }
    const std::vector<Sweep> none;
    Laboratory laboratory({}, methods(), none);
    const Findings found = find_estimator("pass_multiplications")->estimate(arguments, laboratory);
    const auto value = [&](const std::string& name) {
      for (const Figure& figure : found.figures) {
        if (figure.name == name) return figure.value;
      }
      return -1.0;
    };
    const auto declared = [&](const char* detector) {
      return detector_named(detector).multiplications(size);
    };
    EXPECT_EQ(value("bqsa_per_pair"), declared(dimension == 2 ? "bqsa_paper" : "bqsa_projections"));
    EXPECT_DOUBLE_EQ(value("polar_per_pair"), declared("bqsa"));
    EXPECT_EQ(value("points"), 27 * declared("test_points"));
    EXPECT_EQ(value("points_per_point_pair"), dimension);
  }
}

}  // namespace
}  // namespace bqsa::harness::claims
