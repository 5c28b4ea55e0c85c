// The batched test against 113-bit arithmetic and against the scalar test, with all instruction sets.

#include "bqsa/batch/batched_test.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "batch_cases.hpp"
#include "bqsa/batch/single_precision.hpp"
#include "bqsa/geometry/rounding.hpp"
#include "support/allocation_guard.hpp"
#include "support/instruction_sets.hpp"

namespace bqsa {
namespace {

using test_support::BatchCase;
using test_support::exact_segment_test;
using test_support::ExactSegmentTest;
using test_support::Family;
using test_support::Generator;
using test_support::kAllFamilies;
using test_support::make_batch_case;
using test_support::scaled;
using test_support::with_all_instruction_sets;

constexpr int kObstacles = 21;  // a block, and part of another
constexpr int kCases = 400;

/// How far from touching double must be right, in semi-axes: 1e-9, and for links that are very long or
/// far away in semi-axes what single_precision.hpp derives, with the eps of double.
template <int Dim>
double band_of_double(const EllipsoidN<Dim>& shape, const ExactSegmentTest& exact,
                      const BatchCase<Dim>& batch, int link) {
  const double columns = shape.unit_map().colwise().norm().maxCoeff();
  const double size = batch.start(link).norm() + batch.end(link).norm() + shape.center().norm();
  return 1e-9 + 0x1p-53 * (28 + 3 * static_cast<double>(exact.length2) + 12 * columns * size);
}

template <int Dim, typename Real>
std::vector<HitMask> masks_of(const ObstacleBatch<Dim, Real>& batch,
                              const std::vector<Real>& points) {
  const int links = static_cast<int>(points.size()) / Dim - 1;
  std::vector<HitMask> masks(masks_needed(batch, links), 0xABCD);
  hit_masks<Dim, Real>(batch, points, masks);
  return masks;
}

bool is_set(const std::vector<HitMask>& masks, int links, int link, int obstacle) {
  return (masks[static_cast<std::size_t>(obstacle / 16 * links + link)] >> obstacle % 16 & 1) != 0;
}

template <int Dim>
void expect_exact_answers_in_double(Family family) {
  Generator generator(1);
  int hits = 0, in_band = 0;
  for (int number = 0; number < kCases; ++number) {
    const BatchCase<Dim> batch = make_batch_case<Dim>(family, kObstacles, generator);
    const ObstacleBatch<Dim, double> obstacles(batch.shapes, {});
    const std::vector<double> points = batch.template coordinates<double>();
    std::vector<bool> smaller_hit, larger_hit;
    for (int j = 0; j < kObstacles; ++j) {
      const int i = batch.own_link(j);
      const EllipsoidN<Dim>& shape = batch.shapes[static_cast<std::size_t>(j)];
      const ExactSegmentTest exact = exact_segment_test<Dim>(shape, batch.start(i), batch.end(i));
      const double band = band_of_double(shape, exact, batch, i);
      smaller_hit.push_back(is_hit(scaled(exact, 1 - band)));
      larger_hit.push_back(is_hit(scaled(exact, 1 + band)));
    }
    with_all_instruction_sets([&] {
      const std::vector<HitMask> masks = masks_of(obstacles, points);
      for (int j = 0; j < kObstacles; ++j) {
        const bool hit = larger_hit[static_cast<std::size_t>(j)];
        if (hit != smaller_hit[static_cast<std::size_t>(j)]) {
          ++in_band;
          continue;
        }
        hits += hit;
        ASSERT_EQ(is_set(masks, batch.links(), batch.own_link(j), j), hit)
            << "case " << number << ", obstacle " << j;
      }
    });
  }
  const int asked = kCases * kObstacles * static_cast<int>(instruction_sets().size());
  const bool touches = family == Family::kTangent;
  const bool made_to_touch = touches || family == Family::kEndOnSurface;
  EXPECT_LE(in_band, made_to_touch ? asked : asked / 100);
  EXPECT_GE(hits, touches ? 0 : asked / 20);
}

/// All pairs of the chain and the obstacles, own or not.
template <int Dim>
void expect_answers_of_the_scalar_test(Family family) {
  Generator generator(2);
  for (int number = 0; number < kCases / 10; ++number) {
    const BatchCase<Dim> batch = make_batch_case<Dim>(family, kObstacles, generator);
    const ObstacleBatch<Dim, double> obstacles(batch.shapes, {});
    const std::vector<double> points = batch.template coordinates<double>();
    const int links = batch.links();
    with_all_instruction_sets([&] {
      const std::vector<HitMask> masks = masks_of(obstacles, points);
      std::vector<CategoryMasks> categories(masks.size());
      category_masks<Dim, double>(obstacles, points, categories);
      for (int i = 0; i < links; ++i) {
        for (int j = 0; j < kObstacles; ++j) {
          const EllipsoidN<Dim>& shape = batch.shapes[static_cast<std::size_t>(j)];
          const PolarForm<double> form = polar_form<Dim>(shape, batch.start(i), batch.end(i));
          // Twice the bound: one for each way to compute it.
          PolarRounding rounding = polar_rounding<Dim>(shape, batch.start(i), batch.end(i));
          const double far = 1 + shape.center().norm() / (batch.start(i) - shape.center()).norm();
          for (double* d : {&rounding.s11, &rounding.s12, &rounding.s22, &rounding.discriminant}) {
            *d *= 2 * far;
          }
          if (is_hit_certain(form, rounding)) {
            ASSERT_EQ(is_set(masks, links, i, j), hits(form)) << number << ": " << i << ", " << j;
          }
          const CategoryMasks& found = categories[static_cast<std::size_t>(j / 16 * links + i)];
          const HitMask of[] = {found.no_collision_1, found.no_collision_2, found.crossing,
                                found.one_end_inside, found.contained};
          int category_found = 0;
          for (int k = 0; k < 5; ++k) {
            if ((of[k] >> j % 16 & 1) == 0) continue;
            ASSERT_EQ(category_found, 0) << "two categories";
            category_found = k + 1;
          }
          ASSERT_NE(category_found, 0) << "no category";
          ASSERT_EQ(category_found >= 3, is_set(masks, links, i, j));
          if (is_certain(form, rounding)) {
            ASSERT_EQ(category_found, static_cast<int>(category(form))) << number << ": " << i;
          }
        }
      }
    });
  }
}

/// Never free where exact arithmetic finds a hit, nor a hit where the obstacle with twice the growth
/// is free.
template <int Dim>
void expect_float_to_miss_nothing(Family family, double point_error) {
  Generator generator(3);
  int hits = 0, free = 0;
  for (int number = 0; number < kCases; ++number) {
    const BatchCase<Dim> batch = make_batch_case<Dim>(family, kObstacles, generator);
    Workspace workspace = batch.workspace();
    workspace.reach += point_error;
    workspace.point_error = point_error;
    const ObstacleBatch<Dim, float> obstacles(batch.shapes, workspace);
    BatchCase<Dim> moved = batch;
    for (auto& p : moved.points) {
      p += point_error * test_support::random_direction<Dim>(generator);
    }
    const std::vector<float> points = moved.template coordinates<float>();
    std::vector<bool> must_hit, must_be_free;
    for (int j = 0; j < kObstacles; ++j) {
      const int i = batch.own_link(j);
      const EllipsoidN<Dim>& shape = batch.shapes[static_cast<std::size_t>(j)];
      must_hit.push_back(is_hit(exact_segment_test<Dim>(shape, batch.start(i), batch.end(i))));
      const std::optional<EllipsoidN<Dim>> grown = grown_for_float(shape, workspace);
      ASSERT_TRUE(grown);
      const double growth = grown->semi_axes().maxCoeff() / shape.semi_axes().maxCoeff();
      must_be_free.push_back(
          !is_hit(scaled(exact_segment_test<Dim>(*grown, moved.start(i), moved.end(i)), growth)));
    }
    with_all_instruction_sets([&] {
      const std::vector<HitMask> masks = masks_of(obstacles, points);
      for (int j = 0; j < kObstacles; ++j) {
        const bool hit = is_set(masks, batch.links(), batch.own_link(j), j);
        const auto k = static_cast<std::size_t>(j);
        hits += must_hit[k];
        free += must_be_free[k];
        if (must_hit[k] || must_be_free[k]) {
          ASSERT_EQ(hit, must_hit[k]) << "case " << number << ", obstacle " << j;
        }
      }
    });
  }
  const int asked = kCases * kObstacles * static_cast<int>(instruction_sets().size());
  EXPECT_GE(hits, asked / 20);
  const bool can_be_free = family == Family::kRandom || family == Family::kVertical ||
                           family == Family::kHorizontal || family == Family::kZeroLength;
  EXPECT_GE(free, can_be_free ? asked / 20 : 0);
}

class BatchedTest : public testing::TestWithParam<Family> {};

TEST_P(BatchedTest, DoubleAnswersAsExactArithmetic) {
  expect_exact_answers_in_double<2>(GetParam());
  expect_exact_answers_in_double<3>(GetParam());
}

TEST_P(BatchedTest, DoubleAnswersAsTheScalarTestWithAllCategories) {
  expect_answers_of_the_scalar_test<2>(GetParam());
  expect_answers_of_the_scalar_test<3>(GetParam());
}

TEST_P(BatchedTest, FloatMissesNoHit) {
  expect_float_to_miss_nothing<2>(GetParam(), 0);
  expect_float_to_miss_nothing<3>(GetParam(), 0);
}

TEST_P(BatchedTest, FloatMissesNoHitOfPointsThatAreOff) {
  expect_float_to_miss_nothing<2>(GetParam(), 1e-4);
  expect_float_to_miss_nothing<3>(GetParam(), 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Families, BatchedTest, testing::ValuesIn(kAllFamilies),
                         [](const auto& family) { return test_support::name_of(family.param); });

/// Links whose every intermediate result is representable, also without fused operations.
TEST(BatchedTestTouching, IsAHitWithAllInstructionSets) {
  const std::vector<Ellipsoid> shapes = {
      {Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(0.5, 2, 0.25)},
      {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 1, 1)},
      {Eigen::Vector3d(-0.25, 0.5, 8), Eigen::Vector3d(4, 0.125, 1)},
  };
  const ObstacleBatch<3, double> obstacles(shapes, {});
  constexpr double kStep = 0x1p-20;
  const auto expect = [&](const Eigen::Vector3d& u1, const Eigen::Vector3d& u2, bool hit) {
    for (std::size_t j = 0; j < shapes.size(); ++j) {
      const Eigen::Vector3d p1 = shapes[j].center() + shapes[j].semi_axes().cwiseProduct(u1);
      const Eigen::Vector3d p2 = shapes[j].center() + shapes[j].semi_axes().cwiseProduct(u2);
      ASSERT_EQ(hits(polar_form<3>(shapes[j], p1, p2)), hit);
      const std::vector<double> points = {p1.x(), p1.y(), p1.z(), p2.x(), p2.y(), p2.z()};
      with_all_instruction_sets([&] {
        EXPECT_EQ(is_set(masks_of(obstacles, points), 1, 0, static_cast<int>(j)), hit)
            << u1.transpose() << " to " << u2.transpose() << ", obstacle " << j;
      });
    }
  };
  for (const double far : {1.0, 3.0, 16.0}) {
    for (const double further : {0.0, 1.0, 5.0}) {
      expect({-far, 1, 0}, {further, 1, 0}, true);
      expect({-far, 1 + kStep, 0}, {further, 1 + kStep, 0}, false);
      expect({-far, 1 - kStep, 0}, {further, 1 - kStep, 0}, true);
      expect({0, far, -1}, {0, -further, -1}, true);
      expect({0, far, -1 - kStep}, {0, -further, -1 - kStep}, false);
    }
    expect({1, 0, 0}, {1 + far, 0, 0}, true);
    expect({0, -1 - far, 0}, {0, -1, 0}, true);
    expect({1 + kStep, 0, 0}, {1 + far, 0, 0}, false);
    expect({far, far, far}, {far, far, far}, false);
  }
  expect({0, 0, 1}, {0, 0, 1}, true);
  expect({0, 0, 1 + kStep}, {0, 0, 1 + kStep}, false);
}

template <typename Real>
void expect_hits_with_what_is_out_of_reach() {
  Generator generator(4);
  std::vector<Ellipsoid> shapes;
  for (int j = 0; j < 19; ++j) {
    shapes.push_back(test_support::random_ellipsoid<3>(generator, 0.01, 0.02, 0.1));
  }
  const ObstacleBatch<3, Real> obstacles(shapes, {.reach = 10, .link_length = 1});
  const Real inf = std::numeric_limits<Real>::infinity();
  for (const Real bad :
       {std::numeric_limits<Real>::quiet_NaN(), -std::numeric_limits<Real>::quiet_NaN(), inf, -inf,
        Real(10.01), Real(-10.01), std::numeric_limits<Real>::max()}) {
    for (std::size_t k = 0; k < 15; ++k) {
      std::vector<Real> points(15, Real(5));  // four links of zero length, away from everything
      points[k] = bad;
      with_all_instruction_sets([&] {
        const std::vector<HitMask> masks = masks_of(obstacles, points);
        std::vector<CategoryMasks> categories(8);
        category_masks<3, Real>(obstacles, points, categories);
        const int point = static_cast<int>(k) / 3;
        for (int i = 0; i < 4; ++i) {
          const bool hit = i == point || i + 1 == point;
          const auto link = static_cast<std::size_t>(i);
          EXPECT_EQ(masks[link], hit ? 0xFFFF : 0) << bad << " in " << k << ", link " << i;
          EXPECT_EQ(masks[4 + link], hit ? 7 : 0) << bad << " in " << k << ", link " << i;
          EXPECT_EQ(categories[link].hits(), hit ? 0xFFFF : 0);
          EXPECT_EQ(categories[4 + link].hits(), hit ? 7 : 0);
        }
        EXPECT_TRUE((any_hit<3, Real>(obstacles, points)));
      });
    }
  }
}

TEST(BatchedTestReach, WhatIsBeyondItOrNoNumberIsAHit) {
  expect_hits_with_what_is_out_of_reach<double>();
  expect_hits_with_what_is_out_of_reach<float>();
}

TEST(BatchedTestReach, WhatWouldOverflowIsHitByEverything) {
  const std::vector<Ellipsoid> shapes = {
      {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(1, 1, 1e-80)},
      {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(1e-160, 1e-160, 1e-160)},
      {Eigen::Vector3d(1e75, 1, 1), Eigen::Vector3d(1, 1, 1)},
      {Eigen::Vector3d(3, 3, 3), Eigen::Vector3d(1e-6, 1e-6, 1e-6)}};
  with_all_instruction_sets([&] {
    const ObstacleBatch<3, double> doubles(shapes, {});
    EXPECT_EQ(masks_of<3>(doubles, std::vector<double>{0, 0, 0, 0, 0, 0}).front(), 0b0111);
    const ObstacleBatch<3, float> floats(shapes, {.reach = 10});
    EXPECT_EQ(masks_of<3>(floats, std::vector<float>{0, 0, 0, 0, 0, 0}).front(), 0b0100);
  });
}

template <int Dim, typename Real>
void expect_any_hit_to_agree() {
  Generator generator(5);
  int hits = 0;
  for (int number = 0; number < 300; ++number) {
    std::vector<EllipsoidN<Dim>> shapes;
    for (int j = 0; j < number % 70; ++j) {
      shapes.push_back(test_support::random_ellipsoid<Dim>(generator, 0.01, 0.1));
    }
    const ObstacleBatch<Dim, Real> obstacles(shapes, {.reach = 2});
    std::vector<Real> points;
    for (int k = 0; k < Dim * (2 + number % 9); ++k) {
      points.push_back(static_cast<Real>(test_support::uniform(generator, -1, 1)));
    }
    with_all_instruction_sets([&] {
      bool expected = false;
      for (const HitMask mask : masks_of(obstacles, points)) expected = expected || mask != 0;
      hits += expected;
      EXPECT_EQ((any_hit<Dim, Real>(obstacles, points)), expected) << "case " << number;
    });
  }
  EXPECT_GT(hits, 50);
}

TEST(AnyHit, IsWhatTheMasksSay) {
  expect_any_hit_to_agree<2, double>();
  expect_any_hit_to_agree<3, double>();
  expect_any_hit_to_agree<2, float>();
  expect_any_hit_to_agree<3, float>();
}

TEST(ObstacleBatch, AnObstacleThatMovedIsWhereItWasPut) {
  Generator generator(6);
  std::vector<Ellipsoid> shapes;
  for (int j = 0; j < 40; ++j) {
    shapes.push_back(test_support::random_ellipsoid<3>(generator, 0.05, 0.5));
  }
  const Workspace workspace{.reach = 3, .link_length = 1};
  ObstacleBatch<3, float> moved(40, workspace);
  std::vector<float> points;
  for (int k = 0; k < 24; ++k) {
    points.push_back(static_cast<float>(test_support::uniform(generator, -1, 1)));
  }
  EXPECT_EQ(masks_of(moved, points), std::vector<HitMask>(21, 0)) << "not there yet";
  for (int j = 0; j < 40; ++j) moved.set(j, shapes[static_cast<std::size_t>(39 - j)]);
  for (int j = 0; j < 40; ++j) moved.set(j, shapes[static_cast<std::size_t>(j)]);
  const std::vector<HitMask> masks = masks_of(ObstacleBatch<3, float>(shapes, workspace), points);
  EXPECT_EQ(masks_of(moved, points), masks);
  EXPECT_NE(masks, std::vector<HitMask>(21, 0));
}

TEST(ObstacleBatch, BadWorkspacesAreRefused) {
  using Batch = ObstacleBatch<3, float>;
  EXPECT_THROW(Batch(-1, {}), std::invalid_argument);
  EXPECT_THROW(Batch(1, {.reach = 0}), std::invalid_argument);
  EXPECT_THROW(Batch(1, {.reach = std::numeric_limits<double>::infinity()}), std::invalid_argument);
  EXPECT_THROW(Batch(1, {.link_length = 0}), std::invalid_argument);
  EXPECT_THROW(Batch(1, {.point_error = -1e-9}), std::invalid_argument);
  EXPECT_THROW(Batch(1, {.point_error = std::nan("")}), std::invalid_argument);
}

TEST(BatchedTestAllocations, ThereAreNone) {
  Generator generator(7);
  const BatchCase<3> batch = make_batch_case<3>(Family::kRandom, kObstacles, generator);
  ObstacleBatch<3, float> obstacles(batch.shapes, batch.workspace());
  const std::vector<float> points = batch.coordinates<float>();
  std::vector<HitMask> masks(masks_needed(obstacles, batch.links()));
  std::vector<CategoryMasks> categories(masks.size());
  const test_support::AllocationGuard guard;
  obstacles.set(3, batch.shapes[4]);
  hit_masks<3, float>(obstacles, points, masks);
  category_masks<3, float>(obstacles, points, categories);
  EXPECT_TRUE((any_hit<3, float>(obstacles, points)));
  EXPECT_EQ(guard.allocations(), 0U);
}

}  // namespace
}  // namespace bqsa
