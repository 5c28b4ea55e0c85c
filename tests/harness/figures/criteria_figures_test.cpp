// Criteria and categories in figures against a reference in 113-bit arithmetic and other forms.
#include "harness/figures/criteria_figures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "figure_data.hpp"
#include "support/exact_segment_test.hpp"

namespace bqsa::harness {
namespace {

using test_support::exact_segment_test;

const LinkSegment& link_numbered(const JudgedRun& run, int number) {
  for (const LinkSegment& link : run.links) {
    if (link.number == number) return link;
  }
  throw std::runtime_error("no such link");
}

/// Division by the squared width makes the paper's criteria those of the quadratic over t.
void expect_parameter_form(const Criteria& criteria, const Ellipse& ellipse,
                           const Eigen::Vector2d& left, const Eigen::Vector2d& right) {
  const ParameterForm<double> f =
      parameter_form<double, 2>(unit_point(ellipse, left), unit_point(ellipse, right));
  const double size = f.alpha + std::abs(f.beta) + std::abs(f.gamma);
  EXPECT_NEAR(criteria.f_min, f.gamma, 1e-9 * size);
  EXPECT_NEAR(criteria.f_max, f.alpha + f.beta + f.gamma, 1e-9 * size);
  EXPECT_NEAR(criteria.slope_product, f.beta * (2 * f.alpha + f.beta), 1e-9 * size * size);
  EXPECT_NEAR(criteria.delta, f.beta * f.beta - 4 * f.alpha * f.gamma, 1e-9 * size * size);
}

TEST(Criteria, OfThePaperAreThoseOfTheQuadraticOverTheLink) {
  const Ellipse ellipse = rotated_ellipse({0.3, -0.2}, {0.5, 0.2}, 0.7);
  int compared = 0;
  for (int k = 0; k < 200; ++k) {
    const double angle = 0.031 * k + 0.01;
    const Eigen::Vector2d p1(0.9 * std::cos(angle), 0.7 * std::sin(2 * angle));
    const Eigen::Vector2d p2(p1.x() + 0.4 * std::cos(3 * angle),
                             p1.y() + 0.4 * std::sin(3 * angle));
    if (std::abs(p2.x() - p1.x()) < 0.05) continue;
    const bool in_order = p1.x() < p2.x();
    expect_parameter_form(paper_criteria(ellipse, p1, p2), ellipse, in_order ? p1 : p2,
                          in_order ? p2 : p1);
    ++compared;
  }
  EXPECT_GT(compared, 150);
}

TEST(Criteria, InSpaceAreLevelsAtTheEnds) {
  const Ellipsoid ellipsoid({0.1, 0.2, 0.3}, {0.3, 0.2, 0.1});
  const Eigen::Vector3d p1(0.5, 0.1, 0.2);
  const Eigen::Vector3d p2(-0.1, 0.6, 0.35);
  const Criteria criteria = space_criteria(ellipsoid, p1, p2);
  EXPECT_NEAR(criteria.f_min, ellipsoid.level(p1), 1e-12);
  EXPECT_NEAR(criteria.f_max, ellipsoid.level(p2), 1e-12);
  constexpr double kStep = 1e-6;
  const auto level = [&](double t) { return ellipsoid.level(p1 + t * (p2 - p1)); };
  const double slope1 = (level(kStep) - level(-kStep)) / (2 * kStep);
  const double slope2 = (level(1 + kStep) - level(1 - kStep)) / (2 * kStep);
  EXPECT_NEAR(criteria.slope_product, slope1 * slope2, 1e-6);
}

/// The defect of the paper's form, which figures have to show: a vertical link through the middle.
TEST(Criteria, OfAVerticalLinkCallAHitFree) {
  const Ellipse ellipse = rotated_ellipse({0, 0}, {0.5, 0.2}, 0);
  const Eigen::Vector2d below(0, -1);
  const Eigen::Vector2d above(0, 1);
  EXPECT_EQ(paper_criteria(ellipse, below, above).category, Category::kNoCollision1);
  EXPECT_EQ(exact_segment_test(ellipse, below, above).category(), 3);
}

void expect_categories(const Figure& figure, const JudgedRun& run) {
  ASSERT_EQ(run.outcome.clamped_pairs.size(), 2);
  for (std::size_t p = 0; p < 2; ++p) {
    const ClampedPair& pair = run.outcome.clamped_pairs[p];
    const std::string part = "link" + std::to_string(pair.link) + "_" + std::to_string(p);
    const ReadTable table = data_of(figure, part);
    ASSERT_EQ(table.rows.size(), run.rows());
    const LinkSegment& link = link_numbered(run, pair.link);
    const Ellipse ellipse =
        planar_section(run.problem().obstacles[static_cast<std::size_t>(pair.obstacle)].shape);
    for (std::size_t row = 0; row < run.rows(); ++row) {
      const Eigen::Vector2d p1 = run.start_of(link, row).head<2>();
      const Eigen::Vector2d p2 = run.end_of(link, row).head<2>();
      const int exact = exact_segment_test(ellipse, p1, p2).category();
      EXPECT_EQ(table.text(row, "category"), std::to_string(exact)) << part << " row " << row;
      EXPECT_EQ(table.text(row, "category by the exact test"), std::to_string(exact));
      EXPECT_LE(exact, 2);
      EXPECT_EQ(exact == 1, table.number(row, "Delta") <= 0);
      EXPECT_GT(table.number(row, "f(x_min)"), 0);
      EXPECT_GT(table.number(row, "f(x_max)"), 0);
      if (exact == 2) {
        EXPECT_GT(table.number(row, "f'(x_min) f'(x_max)"), 0);
      }
    }
  }
}

TEST(CriteriaFigures, GiveTheCategoriesOfTheReferenceAtEveryTick) {
  const JudgedRun paper = run_of("planar_7r", "bqsa_paper");
  expect_categories(planar_criteria(paper, "a"), paper);
  const JudgedRun exact = run_of("planar_7r", "bqsa");
  expect_categories(planar_criteria(exact, "b"), exact);
}

TEST(CriteriaFigures, ShadeTheWholeRunWithoutGaps) {
  const JudgedRun run = run_of("planar_7r", "bqsa_paper");
  const Figure figure = planar_criteria(run, "a");
  for (const char* part : {"spans_link6_0", "spans_link7_1"}) {
    const ReadTable spans = data_of(figure, part);
    const double half = run.problem().dt / 2;
    EXPECT_NEAR(spans.number(0, "from [s]"), -half, 1e-9);
    EXPECT_NEAR(spans.number(spans.rows.size() - 1, "to [s]"), run.problem().duration() + half,
                1e-9);
    for (std::size_t k = 1; k < spans.rows.size(); ++k) {
      EXPECT_NEAR(spans.number(k, "from [s]"), spans.number(k - 1, "to [s]"), 1e-9);
      EXPECT_NE(spans.text(k, "category"), spans.text(k - 1, "category"));
    }
  }
  EXPECT_EQ(data_of(figure, "spans_link7_1").rows.size(), 3);
}

/// What the projections are for: at every tick some plane is free (Lemma 1). The exact method needs none.
TEST(CriteriaFigures, ShowThatSomeProjectionIsFree) {
  const JudgedRun projection = run_of("puma560_ellipsoid", "bqsa_projection");
  const JudgedRun exact = run_of("puma560_ellipsoid", "bqsa");
  const Figure figure = spatial_criteria(projection, exact);
  const auto hit_planes = [](const ReadTable& spans, double t) {
    int planes = 0;
    for (std::size_t k = 0; k < spans.rows.size(); ++k) {
      planes += spans.number(k, "from [s]") <= t && t < spans.number(k, "to [s]");
    }
    return planes;
  };
  int all_hit_exact = 0;
  for (std::size_t row = 0; row < projection.rows(); ++row) {
    EXPECT_LT(hit_planes(data_of(figure, "planes_bqsa_projection"), projection.time(row)), 3);
    all_hit_exact += hit_planes(data_of(figure, "planes_bqsa"), exact.time(row)) == 3;
  }
  EXPECT_GT(all_hit_exact, 10);
}

}  // namespace
}  // namespace bqsa::harness
