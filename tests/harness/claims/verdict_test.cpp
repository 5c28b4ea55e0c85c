// The rule from figures to verdicts, tried on everything small.
#include "harness/claims/verdict.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace bqsa::harness::claims {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Bound bound_of(Relation relation, double lower, double upper) {
  return {.figure = "f", .relation = relation, .lower = lower, .upper = upper, .unit = "-"};
}

bool satisfies(double x, const Bound& bound) {
  switch (bound.relation) {
    case Relation::kLess:
      return x < bound.lower;
    case Relation::kAtMost:
      return x <= bound.lower;
    case Relation::kGreater:
      return x > bound.lower;
    case Relation::kAtLeast:
      return x >= bound.lower;
    case Relation::kEqual:
      return x == bound.lower;
    case Relation::kWithin:
      return bound.lower <= x && x <= bound.upper;
  }
  return false;
}

/// By asking every quarter of the interval; ends of intervals and bounds are whole numbers.
Outcome by_sampling(const Bound& bound, int lower, int upper) {
  bool all = true, none = true;
  for (int quarter = 4 * lower; quarter <= 4 * upper; ++quarter) {
    const bool good = satisfies(quarter / 4.0, bound);
    all = all && good;
    none = none && !good;
  }
  return all ? Outcome::kHolds : none ? Outcome::kFails : Outcome::kUndecided;
}

TEST(Outcome, IsThatOfAllPointsOfTheInterval) {
  int cases = 0;
  for (const Relation relation : {Relation::kLess, Relation::kAtMost, Relation::kGreater,
                                  Relation::kAtLeast, Relation::kEqual, Relation::kWithin}) {
    for (int from = -2; from <= 2; ++from) {
      const int last = relation == Relation::kWithin ? 2 : from;
      for (int to = from; to <= last; ++to) {
        const Bound bound = bound_of(relation, from, to);
        for (int lower = -3; lower <= 3; ++lower) {
          for (int upper = lower; upper <= 3; ++upper) {
            const std::vector<Figure> figures = {
                {"f", (lower + upper) / 2.0, Interval{double(lower), double(upper)}}};
            EXPECT_EQ(outcome_of(bound, figures), by_sampling(bound, lower, upper))
                << text_of(bound) << " on [" << lower << ", " << upper << "]";
            ++cases;
          }
          EXPECT_EQ(outcome_of(bound, std::vector<Figure>{{"f", double(lower), {}}}),
                    by_sampling(bound, lower, lower));
        }
      }
    }
  }
  EXPECT_EQ(cases, (5 * 5 + 15) * 28);
}

TEST(Outcome, IsUndecidedWithoutANumber) {
  const Bound bound = bound_of(Relation::kLess, 1, 1);
  EXPECT_EQ(outcome_of(bound, {}), Outcome::kUndecided);
  EXPECT_EQ(outcome_of(bound, std::vector<Figure>{{"g", 0, {}}}), Outcome::kUndecided);
  EXPECT_EQ(outcome_of(bound, std::vector<Figure>{{"f", kNan, {}}}), Outcome::kUndecided);
  EXPECT_EQ(outcome_of(bound, std::vector<Figure>{{"f", 0, Interval{kNan, 0}}}),
            Outcome::kUndecided);
  EXPECT_EQ(outcome_of(bound, std::vector<Figure>{{"f", 0, Interval{-kInfinity, kInfinity}}}),
            Outcome::kUndecided);
  Bound unknown = bound;
  unknown.unknown = "lost";
  EXPECT_EQ(outcome_of(unknown, std::vector<Figure>{{"f", 0, {}}}), Outcome::kUndecided);
}

/// All lists of up to `most` outcomes.
std::vector<std::vector<Outcome>> lists_of_outcomes(int most) {
  std::vector<std::vector<Outcome>> lists = {{}};
  for (std::size_t k = 0; k < lists.size(); ++k) {
    if (static_cast<int>(lists[k].size()) == most) continue;
    for (const Outcome one : {Outcome::kHolds, Outcome::kFails, Outcome::kUndecided}) {
      lists.push_back(lists[k]);
      lists.back().push_back(one);
    }
  }
  return lists;
}

TEST(Verdict, FollowsTheRuleForAllListsOfUpToThreeOutcomes) {
  int counts[4] = {};
  for (const auto& as_stated : lists_of_outcomes(3)) {
    if (as_stated.empty()) continue;
    int failed = 0, held = 0;
    for (const Outcome one : as_stated) {
      failed += one == Outcome::kFails;
      held += one == Outcome::kHolds;
    }
    for (const auto& corrected : lists_of_outcomes(3)) {
      int corrected_held = 0, corrected_failed = 0;
      for (const Outcome one : corrected) corrected_held += one == Outcome::kHolds;
      for (const Outcome one : corrected) corrected_failed += one == Outcome::kFails;
      const bool saved = !corrected.empty() && corrected_held == static_cast<int>(corrected.size());
      const bool lost = corrected.empty() || corrected_failed > 0;
      const Verdict expected = held == static_cast<int>(as_stated.size()) ? Verdict::kConfirmed
                               : failed == 0                              ? Verdict::kUndecided
                               : saved                                    ? Verdict::kCorrected
                               : lost                                     ? Verdict::kRefuted
                                                                          : Verdict::kUndecided;
      EXPECT_EQ(verdict_of(as_stated, corrected), expected);
      ++counts[static_cast<int>(expected)];
    }
  }
  // 39 lists as stated: 3 hold in full, 25 have a failure; of 40 corrections 3 hold in full, 1 is
  // empty, 25 have a failure, 11 are undecided.
  EXPECT_EQ(counts[static_cast<int>(Verdict::kConfirmed)], 3 * 40);
  EXPECT_EQ(counts[static_cast<int>(Verdict::kCorrected)], 25 * 3);
  EXPECT_EQ(counts[static_cast<int>(Verdict::kRefuted)], 25 * 26);
  EXPECT_EQ(counts[static_cast<int>(Verdict::kUndecided)], 11 * 40 + 25 * 11);
}

}  // namespace
}  // namespace bqsa::harness::claims
