// The five categories, touching, the vertex, and the paper form with its defect.

#include "bqsa/geometry/segment_test.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "bqsa/geometry/paper_form.hpp"
#include "segment_families.hpp"

namespace bqsa {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test_support::Family;

struct ExactCase {
  const char* name;
  Vector2d p1, p2;
  Category category;
};

void PrintTo(const ExactCase& c, std::ostream* out) { *out << c.name; }

/// Against the unit disc at the origin, so that every product and sum is exact.
const ExactCase kExactCases[] = {
    {"FarLine", {-2, 2}, {2, 2}, Category::kNoCollision1},
    {"BeforeTheDisc", {-4, 0}, {-2, 0}, Category::kNoCollision2},
    {"BeyondTheDisc", {2, 0.5}, {4, 0.5}, Category::kNoCollision2},
    {"Through", {-2, 0}, {2, 0}, Category::kCrossing},
    {"VerticalThrough", {0, -2}, {0, 2}, Category::kCrossing},
    {"StartInside", {0, 0}, {2, 0}, Category::kOneEndInside},
    {"EndInside", {0, 2}, {0, 0.5}, Category::kOneEndInside},
    {"ChordThroughTheCentre", {-0.5, 0}, {0.5, 0}, Category::kContained},
    {"TouchingSideways", {-1, 1}, {1, 1}, Category::kCrossing},
    {"TouchingVertically", {1, -1}, {1, 1}, Category::kCrossing},
    {"TangentLineBeyondTheLink", {1, 1}, {2, 1}, Category::kNoCollision1},
    {"TouchingWithTheEnd", {3, 0}, {1, 0}, Category::kOneEndInside},
    {"TouchingWithTheStartOfATangent", {0, 1}, {1, 1}, Category::kOneEndInside},
    {"SurfaceToSurface", {-1, 0}, {0, 1}, Category::kContained},
    {"PointOutside", {0, 2}, {0, 2}, Category::kNoCollision1},
    {"PointOnTheSurface", {0, 1}, {0, 1}, Category::kContained},
    {"PointInside", {0, 0.5}, {0, 0.5}, Category::kContained},
};

class ExactArithmetic : public testing::TestWithParam<ExactCase> {};

TEST_P(ExactArithmetic, GivesTheCategoryByBothFormsInPlaneAndSpace) {
  const auto& [name, p1, p2, expected] = GetParam();
  const Ellipse disc({0, 0}, {1, 1});
  const Ellipsoid ball({0, 0, 0}, {1, 1, 1});
  const Vector3d q1(p1.x(), p1.y(), 0), q2(p2.x(), p2.y(), 0);
  EXPECT_EQ(category(polar_form<2>(disc, p1, p2)), expected);
  EXPECT_EQ(category(polar_form<3>(ball, q1, q2)), expected);
  EXPECT_EQ(category(polar_form<3>(ball, q2, q1)), expected) << "turned round";
  EXPECT_EQ(category(parameter_form<double, 2>(unit_point<2>(disc, p1), unit_point<2>(disc, p2))),
            expected);
  EXPECT_EQ(category(parameter_form<double, 3>(unit_point<3>(ball, q1), unit_point<3>(ball, q2))),
            expected);
  EXPECT_EQ(hits(polar_form<2>(disc, p1, p2)), is_hit(expected));
}

INSTANTIATE_TEST_SUITE_P(Cases, ExactArithmetic, testing::ValuesIn(kExactCases),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

TEST(Categories, AreCompleteAndDisjoint) {
  // On a grid of all sign patterns, zeros included, exactly one of the five definitions holds.
  const std::array<double, 7> values{-2, -1, -0.5, 0, 0.5, 1, 2};
  int cases = 0;
  std::array<int, 6> seen{};
  for (const double s11 : values) {
    for (const double s12 : values) {
      for (const double s22 : values) {
        const int inside = (s11 <= 0) + (s22 <= 0);
        const double quarter_delta = s12 * s12 - s11 * s22;
        const bool contained = inside == 2;
        const bool one_end = inside == 1;
        const bool crossing = inside == 0 && s12 < 0 && quarter_delta >= 0;
        const bool free1 = inside == 0 && !crossing && quarter_delta <= 0;
        const bool free2 = inside == 0 && s12 > 0 && quarter_delta > 0;
        ASSERT_EQ(contained + one_end + crossing + free1 + free2, 1)
            << s11 << " " << s12 << " " << s22;
        const int expected = free1 ? 1 : free2 ? 2 : crossing ? 3 : one_end ? 4 : 5;
        const PolarForm<double> f{s11, s12, s22};
        ASSERT_EQ(static_cast<int>(category(f)), expected) << s11 << " " << s12 << " " << s22;
        ASSERT_EQ(hits(f), expected >= 3);
        ++seen[static_cast<std::size_t>(expected)];
        ++cases;
      }
    }
  }
  EXPECT_EQ(cases, 343);
  EXPECT_TRUE(std::all_of(seen.begin() + 1, seen.end(), [](int count) { return count > 0; }));
}

template <int Dim>
void expect_vertex_is_deepest() {
  test_support::Generator generator(7 + Dim);
  constexpr int kCases = 300, kSamples = 2000;
  int within = 0, at_start = 0, at_end = 0;
  for (int i = 0; i < kCases; ++i) {
    const auto [ellipsoid, p1, p2] = test_support::make_pair<Dim>(Family::kRandom, generator);
    double lowest = ellipsoid.level(p1);
    int best = 0;
    for (int k = 1; k <= kSamples; ++k) {
      const double level = ellipsoid.level(p1 + (p2 - p1) * (double(k) / kSamples));
      if (level < lowest) lowest = level, best = k;
    }
    const double polar = vertex(polar_form<Dim>(ellipsoid, p1, p2));
    const double parameter = vertex(parameter_form<double, Dim>(unit_point<Dim>(ellipsoid, p1),
                                                                unit_point<Dim>(ellipsoid, p2)));
    ASSERT_NEAR(polar, double(best) / kSamples, 1.0 / kSamples) << "case " << i;
    ASSERT_NEAR(parameter, polar, 1e-9) << "case " << i;
    ASSERT_LE(ellipsoid.level(p1 + polar * (p2 - p1)), lowest + 1e-9 * (1 + std::abs(lowest)))
        << "case " << i;
    within += polar > 0 && polar < 1;
    at_start += polar == 0;
    at_end += polar == 1;
  }
  EXPECT_GT(within, 50);
  EXPECT_GT(at_start, 10);
  EXPECT_GT(at_end, 10);
}

TEST(Vertex, IsTheDeepestPointOfTheLink) {
  expect_vertex_is_deepest<2>();
  expect_vertex_is_deepest<3>();
}

TEST(Vertex, OfALinkOfZeroLengthIsItsStart) {
  const Ellipse disc({0, 0}, {1, 1});
  const Vector2d p(0.3, 2);
  EXPECT_EQ(vertex(polar_form<2>(disc, p, p)), 0);
  EXPECT_EQ(vertex(parameter_form<double, 2>(unit_point<2>(disc, p), unit_point<2>(disc, p))), 0);
}

Category by_paper_form(const Ellipse& ellipse, const Vector2d& p1, const Vector2d& p2) {
  return paper_category(paper_form(conic_from_ellipse(ellipse), p1, p2), p1.x(), p2.x());
}

TEST(PaperForm, GivesTheCategoriesOfTheParameterFormForOrdinaryLinks) {
  test_support::Generator generator(11);
  constexpr int kCases = 20000;
  std::array<int, 6> seen{};
  for (int i = 0; i < kCases; ++i) {
    const auto [ellipse, p1, p2] = test_support::make_pair<2>(Family::kRandom, generator);
    const Category expected = category(polar_form<2>(ellipse, p1, p2));
    if (std::abs(p1.x() - p2.x()) < 1e-2 * (p1 - p2).norm()) continue;  // where the defect begins
    const PaperForm<double> printed = paper_form(conic_from_ellipse(ellipse), p1, p2);
    const PaperForm<double> shared = paper_form_shared(conic_from_ellipse(ellipse), p1, p2);
    ASSERT_EQ(paper_category(printed, p1.x(), p2.x()), expected) << "case " << i;
    ASSERT_EQ(paper_category(shared, p1.x(), p2.x()), expected) << "case " << i;
    ++seen[static_cast<std::size_t>(expected)];
  }
  EXPECT_TRUE(std::all_of(seen.begin() + 1, seen.end(), [](int count) { return count > 500; }));
}

TEST(PaperForm, MissesEveryHitOfAVerticalLinkInExactArithmetic) {
  // Semi-axes are powers of two and coordinates eighths, so that nothing is rounded.
  const Ellipse ellipse({0.5, -0.25}, {2, 1});
  int through = 0;
  for (int x = -11; x <= 19; ++x) {
    const Vector2d p1(x / 8.0, -3), p2(x / 8.0, 3);
    ASSERT_EQ(category(polar_form<2>(ellipse, p1, p2)), Category::kCrossing) << "x = " << x / 8.0;
    ASSERT_EQ(by_paper_form(ellipse, p1, p2), Category::kNoCollision1) << "x = " << x / 8.0;
    ++through;
  }
  EXPECT_EQ(through, 31);
}

/// How often the paper form errs on a family, counted over hits and over free links.
struct PaperErrors {
  int hits = 0, missed = 0, free = 0, false_hits = 0;
};

PaperErrors paper_errors(Family family) {
  test_support::Generator generator(13);
  PaperErrors errors;
  for (int i = 0; i < 50000; ++i) {
    const auto [ellipse, p1, p2] = test_support::make_pair<2>(family, generator);
    const bool hit = hits(polar_form<2>(ellipse, p1, p2));
    const bool claimed = is_hit(by_paper_form(ellipse, p1, p2));
    ++(hit ? errors.hits : errors.free);
    errors.missed += hit && !claimed;
    errors.false_hits += !hit && claimed;
  }
  testing::Test::RecordProperty("hits", errors.hits);
  testing::Test::RecordProperty("missed", errors.missed);
  testing::Test::RecordProperty("free", errors.free);
  testing::Test::RecordProperty("false_hits", errors.false_hits);
  return errors;
}

// In double precision the sign of a discriminant that should be 0 is noise: more than half of the
// hits are missed, and some free links are called hits.

TEST(PaperForm, MissesHitsOfVerticalLinks) {
  const PaperErrors vertical = paper_errors(Family::kVertical);
  EXPECT_GT(vertical.hits, 10000);
  EXPECT_GT(vertical.missed, vertical.hits / 2);
  EXPECT_GT(vertical.false_hits, 0);
}

TEST(PaperForm, MissesHitsOfNearVerticalLinks) {
  const PaperErrors near_vertical = paper_errors(Family::kNearVertical);  // dx = 1e-12 dy
  EXPECT_GT(near_vertical.hits, 10000);
  EXPECT_GT(near_vertical.missed, near_vertical.hits / 2);
  EXPECT_GT(near_vertical.false_hits, 0);
}

}  // namespace
}  // namespace bqsa
