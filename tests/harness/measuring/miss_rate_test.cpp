// Equal safety: how many collisions the detectors miss.

#include "harness/measuring/miss_rate.hpp"

#include <gtest/gtest.h>

namespace bqsa::harness {
namespace {

constexpr std::uint64_t kSeed = 61;
constexpr baselines::TestPointCounts kAny{.link = 1, .obstacle = 1};

struct Drawn {
  Population population;
  PairPopulation pairs;
};

/// Drawn once for all tests.
const std::vector<Drawn>& populations() {
  static const std::vector<Drawn> kAll = [] {
    std::vector<Drawn> all;
    for (const Population population : {Population::kAnywhere, Population::kFirstContact}) {
      for (const int dimension : {2, 3}) {
        all.push_back({population, PairPopulation(population, dimension, kSeed)});
      }
    }
    return all;
  }();
  return kAll;
}

TEST(MissRate, OfDetectorsThatPromiseExactAnswersIsZero) {
  for (const auto& [population, pairs] : populations()) {
    for (const Detector& detector : detectors()) {
      if (!detector.is_for(pairs.dimension()) || detector.accuracy == Accuracy::kSampled) continue;
      const MissRate rate = pairs.ask(detector, kAny);
      EXPECT_EQ(rate.detector, detector.name);
      EXPECT_GT(rate.hits, 5000) << detector.name;
      EXPECT_GT(rate.free, 10000) << detector.name;
      EXPECT_EQ(rate.missed, 0) << detector.name;
      EXPECT_EQ(rate.miss_rate(), 0);
      EXPECT_LT(rate.miss_interval().upper, 1e-3);
      const bool single = detector.accuracy == Accuracy::kSinglePrecision;
      if (single || detector.accuracy == Accuracy::kConservative) {
        EXPECT_LT(rate.false_alarms, (single ? 2e-2 : 1e-3) * rate.free) << detector.name;
        continue;
      }
      const bool conservative = detector.accuracy == Accuracy::kPaperConservative;
      EXPECT_EQ(rate.false_alarms > 0, conservative) << detector.name;
    }
  }
}

/// What its header says of the population: how far the link is from the first contact.
TEST(MissRate, AtFirstContactHitsAreShallowAndFreeLinksNear) {
  for (const auto& [population, pairs] : populations()) {
    const MissRate rate = pairs.ask(detector_named("bqsa"), kAny);
    if (population == Population::kFirstContact) {
      EXPECT_EQ(rate.far, 0);
      // A free and a hitting step each, but for those that graze between two steps.
      EXPECT_NEAR(rate.hits, rate.free, 0.002 * rate.free);
    } else {
      EXPECT_GT(rate.far, 0.9 * rate.free);
    }
    EXPECT_EQ(rate.far_alarms, 0);
  }
}

TEST(MissRate, FallsAsTestPointsIncrease) {
  for (const auto& [population, pairs] : populations()) {
    const Detector& detector = detector_named("test_points_vectorized");
    double before = 1;
    for (const int nm : {1, 12, 100, 600, 2000, 10000}) {
      const MissRate rate =
          pairs.ask(detector, workload_size(pairs.dimension(), 1, nm).test_points);
      EXPECT_LT(rate.miss_rate(), before) << nm;
      EXPECT_EQ(rate.size.point_pairs(), nm);
      EXPECT_EQ(rate.far_alarms, 0) << "nothing beyond the margin is a hit";
      before = rate.miss_rate();
      if (before == 0) break;
    }
    EXPECT_LT(before, 0.03);
  }
}

/// Both loops over test points, one of them compiled with vector instructions, on populations that
/// are not theirs.
TEST(MissRate, IsTheSameOfBothTestPointLoops) {
  for (const auto& [population, pairs] : populations()) {
    const baselines::TestPointCounts counts{.link = 7, .obstacle = 20};
    const MissRate one_by_one = pairs.ask(detector_named("test_points"), counts);
    const MissRate vectorized = pairs.ask(detector_named("test_points_vectorized"), counts);
    EXPECT_GT(one_by_one.missed, 1000);
    EXPECT_EQ(one_by_one.missed, vectorized.missed);
    EXPECT_EQ(one_by_one.false_alarms, vectorized.false_alarms);
  }
}

/// Links wholly inside an ellipse, further from its surface than the margin, are missed by any number
/// of points on the surface, and found by the inside test.
TEST(MissRate, AnywhereFallsToZeroInThePlaneWithTheInsideTestOnly) {
  const PairPopulation& pairs = populations().front().pairs;
  const Detector& detector = detector_named("test_points_vectorized");
  const MissRate many = pairs.ask(detector, {.link = 50, .obstacle = 200});
  const MissRate more = pairs.ask(detector, {.link = 100, .obstacle = 400});
  EXPECT_GT(more.missed, 30);
  EXPECT_NEAR(many.missed, more.missed, 5);
  const MissRate inside =
      pairs.ask(detector_named("test_points_inside"), {.link = 100, .obstacle = 400});
  EXPECT_EQ(inside.hits, more.hits);
  EXPECT_EQ(inside.missed, 0);
  EXPECT_EQ(inside.far_alarms, 0);
}

TEST(MissRate, ComesFromTheSeedAlone) {
  const auto missed = [](std::uint64_t seed) {
    const PairPopulation pairs(Population::kFirstContact, 2, seed);
    const MissRate rate = pairs.ask(detector_named("test_points"), {.link = 4, .obstacle = 10});
    return std::pair(rate.hits, rate.missed);
  };
  EXPECT_EQ(missed(1), missed(1));
  EXPECT_NE(missed(1), missed(2));
}

TEST(MissRate, IsSharesWithWilsonIntervals) {
  const MissRate rate{.detector = "any",
                      .size = {},
                      .hits = 10,
                      .missed = 2,
                      .free = 50,
                      .false_alarms = 5,
                      .far = 40,
                      .far_alarms = 0};
  EXPECT_DOUBLE_EQ(rate.miss_rate(), 0.2);
  EXPECT_DOUBLE_EQ(rate.false_alarm_rate(), 0.1);
  EXPECT_DOUBLE_EQ(rate.far_alarm_rate(), 0.0);
  EXPECT_NEAR(rate.miss_interval().lower, 0.0567, 1e-4);  // by the formula, by hand
  EXPECT_NEAR(rate.miss_interval().upper, 0.5098, 1e-4);
  EXPECT_NEAR(rate.false_alarm_interval().upper, 0.2136, 1e-4);
  EXPECT_NEAR(rate.far_alarm_interval().upper, 0.0876, 1e-4);
}

}  // namespace
}  // namespace bqsa::harness
