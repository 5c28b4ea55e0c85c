#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <ostream>

#include "harness/judge/exact_distance.hpp"
#include "harness/judge/fcl_check.hpp"
#include "harness/judge/judge.hpp"
#include "harness/judge/link_scene.hpp"
#include "judge_scenes.hpp"

namespace bqsa::harness {
namespace {

using test_support::Generator;
using test_support::Shape;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct AgreementCase {
  Shape shape;
  bool thick;
};

std::ostream& operator<<(std::ostream& out, const AgreementCase& agreement) {
  return out << test_support::name_of(agreement.shape)
             << (agreement.thick ? "_capsule" : "_segment");
}

std::string name_of_case(const ::testing::TestParamInfo<AgreementCase>& info) {
  return ::testing::PrintToString(info.param);
}

class Checkers : public ::testing::TestWithParam<AgreementCase> {};

/// Eight shapes of pairs, 200,000 cases in all.
TEST_P(Checkers, FclAndTheExactDistanceAgreeOutsideTheTouchingBand) {
  const auto [shape, thick] = GetParam();
  Generator generator(17 + 2 * static_cast<unsigned>(shape) + (thick ? 1 : 0));
  int hits = 0, misses = 0, near_misses = 0;
  double worst = 0;
  for (int k = 0; k < 25000; ++k) {
    const double radius = thick ? test_support::uniform(generator, 1e-3, 0.05) : 0;
    const Ellipsoid ellipsoid(test_support::random_vector<3>(generator, 1),
                              test_support::semi_axes(generator, shape),
                              test_support::random_rotation<3>(generator));
    const double side = k % 2 == 0 ? 1 : -1;
    const double gap = radius + side * test_support::log_uniform(generator, 1e-6, 1);
    const test_support::Segment link =
        test_support::segment_at(generator, ellipsoid, 0.4, gap, k % 3 != 0);
    const double exact = exact_distance(link.a, link.b, ellipsoid).clearance() - radius;
    const FclCheck check({ellipsoid}, radius);
    const bool hit = check.collides(link.a, link.b, 0);
    ASSERT_EQ(contradiction(exact, hit), "") << "case " << k;
    if (hit) {
      ++hits;
      continue;
    }
    ++misses;
    if (exact < 1e-3) ++near_misses;
    const double distance = check.distance(link.a, link.b, 0);
    ASSERT_EQ(contradiction(exact, FclAnswer{hit, distance}, 0.4), "") << "case " << k;
    worst = std::max(worst, std::abs(distance - exact));
  }
  EXPECT_GT(hits, 5000);
  EXPECT_GT(misses, 5000);
  EXPECT_GT(near_misses, 1000);
  RecordProperty("hits", hits);
  RecordProperty("worst_difference_nanometres", std::to_string(worst * 1e9));
}

INSTANTIATE_TEST_SUITE_P(
    Pairs, Checkers,
    ::testing::Values(AgreementCase{Shape::kEgg, false}, AgreementCase{Shape::kEgg, true},
                      AgreementCase{Shape::kSphere, false}, AgreementCase{Shape::kSphere, true},
                      AgreementCase{Shape::kNeedle, false}, AgreementCase{Shape::kNeedle, true},
                      AgreementCase{Shape::kSheet, false}, AgreementCase{Shape::kSheet, true}),
    name_of_case);

TEST(FclCheck, TheInstalledLibraryPassesTheSelfTest) { EXPECT_NO_THROW(FclCheck::self_test()); }

TEST(FclCheck, AgreesUpToTheLargestRatioOfSemiAxesThatAScenarioMayHave) {
  Generator generator(5);
  int hits = 0, misses = 0;
  for (int k = 0; k < 20000; ++k) {
    const double thickness = k % 2 == 0 ? 1e-5 : 1e-4;
    const Eigen::Vector3d sheet(1e6 * thickness, 1e6 * thickness, thickness);
    const Eigen::Vector3d needle(thickness, thickness, 1e6 * thickness);
    const double radius = k % 3 == 0 ? 0.02 : 0;
    const Ellipsoid ellipsoid(test_support::random_vector<3>(generator, 1),
                              k % 4 < 2 ? sheet : needle,
                              test_support::random_rotation<3>(generator));
    const double side = k % 5 < 2 ? -1 : 1;
    const double gap = radius + side * test_support::log_uniform(generator, 1e-6, 1);
    const test_support::Segment link =
        test_support::segment_at(generator, ellipsoid, 1, gap, k % 7 < 4);
    const double exact = exact_distance(link.a, link.b, ellipsoid).clearance() - radius;
    const FclCheck check({ellipsoid}, radius);
    const bool hit = check.collides(link.a, link.b, 0);
    const double distance = hit ? 0 : check.distance(link.a, link.b, 0);
    ASSERT_EQ(contradiction(exact, FclAnswer{hit, distance}, 1), "")
        << "case " << k << ", exact " << exact << ", hit " << hit;
    ++(hit ? hits : misses);
  }
  EXPECT_GT(hits, 2000);
  EXPECT_GT(misses, 5000);
}

TEST(FclCheck, AgreesForLinksOfAKilometreAndThinSheets) {
  Generator generator(3);
  int hits = 0;
  for (int k = 0; k < 5000; ++k) {
    const Ellipsoid sheet(test_support::random_vector<3>(generator, 1), {10, 10, 1e-4},
                          test_support::random_rotation<3>(generator));
    const test_support::Segment link =
        test_support::segment_at(generator, sheet, 1000, -1e-5, false);
    const bool hit = FclCheck({sheet}, 0).collides(link.a, link.b, 0);
    ASSERT_EQ(contradiction(exact_distance(link.a, link.b, sheet).clearance(), hit), "")
        << "case " << k;
    if (hit) ++hits;
  }
  EXPECT_GT(hits, 4000);
}

TEST(Contradiction, NeedsAVerdictBeyondTheTouchingBand) {
  constexpr double kBand = Judge::kTouching;
  EXPECT_EQ(contradiction(0.9 * kBand, true), "");
  EXPECT_EQ(contradiction(-0.9 * kBand, false), "");
  EXPECT_NE(contradiction(1.1 * kBand, true), "");
  EXPECT_NE(contradiction(-1.1 * kBand, false), "");
  EXPECT_EQ(contradiction(0.1, false), "");
  EXPECT_EQ(contradiction(-0.1, true), "");
  EXPECT_NE(contradiction(std::nan(""), true), "");
  EXPECT_NE(contradiction(std::nan(""), false), "");
  EXPECT_NE(contradiction(kInfinity, false), "");
}

TEST(Contradiction, ComparesDistancesOfPairsThatMiss) {
  const auto of = [](double exact, double fcl) { return contradiction(exact, {false, fcl}, 1); };
  EXPECT_EQ(of(0.1, 0.1 + 0.9 * kFclTolerance), "");
  EXPECT_NE(of(0.1, 0.1 + 1.1 * kFclTolerance), "");
  EXPECT_NE(of(0.1, 0.1 - 1.1 * kFclTolerance), "");
  EXPECT_NE(of(0.1, -1), "");
  EXPECT_EQ(of(1e-9, -1), "");
  EXPECT_EQ(of(-1e-7, 1e-9), "");
  EXPECT_NE(of(-1e-7, 1e-3), "");
  EXPECT_NE(of(0.1, std::nan("")), "");
  EXPECT_NE(of(0.1, kInfinity), "");
}

TEST(Contradiction, AHitHasNoDistanceToCompare) {
  EXPECT_EQ(contradiction(-0.1, {true, 7}, 1), "");
  EXPECT_NE(contradiction(0.1, {true, 0.1}, 1), "");
}

}  // namespace
}  // namespace bqsa::harness
