#include "harness/statistics/comparison.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "harness/generator/random_stream.hpp"

namespace bqsa::harness {
namespace {

TEST(PairedComparison, OfTableWorkedByHand) {
  const std::vector<double> a{5, 3, 8, 8, 2, 9}, b{6, 5, 8, 9, 4, 7};
  const PairedComparison found = compare_pairs(a, b);  // differences -1 -2 0 -1 -2 2
  EXPECT_EQ(found.a_less, 4);
  EXPECT_EQ(found.equal, 1);
  EXPECT_EQ(found.b_less, 1);
  EXPECT_EQ(found.median, -1);
  EXPECT_NEAR(found.sign_test_p, 2 * (1 + 5) / 32.0, 1e-12);  // at most 1 of 5
  EXPECT_TRUE(found.is_tie());
}

TEST(PairedComparison, SeesThroughDifferencesBetweenProblems) {
  RandomStream random{2};
  std::vector<double> a, b;
  for (int k = 0; k < 60; ++k) {
    const double problem = random.log_uniform(1, 1000);
    a.push_back(problem);
    b.push_back(problem + random.uniform(0.01, 0.02));
  }
  const PairedComparison found = compare_pairs(a, b);
  EXPECT_FALSE(found.is_tie());
  EXPECT_LT(found.interval.upper, -0.01);
  EXPECT_EQ(found.a_less, 60);
  EXPECT_LT(found.sign_test_p, 1e-15);
  EXPECT_GT(mann_whitney(a, b).p, 0.5) << "unpaired, the problems drown the difference";
  const PairedComparison same = compare_pairs(a, a);
  EXPECT_TRUE(same.is_tie());
  EXPECT_EQ(same.sign_test_p, 1);
}

TEST(MannWhitneyTest, OfTablesWorkedByHand) {
  // Only 1 of the 20 orders has all of a first.
  MannWhitney found = mann_whitney(std::vector{1.0, 2.0, 3.0}, std::vector{4.0, 5.0, 6.0});
  EXPECT_EQ(found.u, 0);
  EXPECT_NEAR(found.p, 2 / 20.0, 1e-12);
  // a a b a b b: U = 1; orders with U <= 1 are 2 of 20.
  found = mann_whitney(std::vector{1.0, 2.0, 4.0}, std::vector{3.0, 5.0, 6.0});
  EXPECT_EQ(found.u, 1);
  EXPECT_NEAR(found.p, 2 * 2 / 20.0, 1e-12);
  // Equal values count one half: U is what the halves of chance would give.
  found = mann_whitney(std::vector{1.0, 2.0}, std::vector{1.0, 2.0});
  EXPECT_EQ(found.u, 2);
  EXPECT_EQ(found.p, 1);
  found = mann_whitney(std::vector{3.0, 3.0}, std::vector{3.0, 3.0, 3.0});
  EXPECT_EQ(found.p, 1);
}

/// The critical values of the published table (Mann and Whitney 1947; two-sided 5 %): the largest U
/// that is significant.
TEST(MannWhitneyTest, HasTheCriticalValuesOfThePublishedTable) {
  struct Row {
    int n, m, critical;
  };
  for (const Row& row :
       {Row{4, 4, 0}, {5, 5, 2}, {6, 6, 5}, {8, 8, 13}, {10, 10, 23}, {5, 9, 7}, {20, 20, 127}}) {
    // a: the n smallest values, of which the largest is moved up past b one by one.
    const auto p_of = [&row](int u) {
      std::vector<double> a, b;
      for (int j = 1; j <= row.m; ++j) b.push_back(j);
      for (int i = 0; i < row.n; ++i) {
        const int past = std::min(u, row.m);
        u -= past;
        a.push_back(past + 0.5 - 0.001 * i);
      }
      return mann_whitney(a, b).p;
    };
    EXPECT_LE(p_of(row.critical), 0.05) << row.n << ", " << row.m;
    EXPECT_GT(p_of(row.critical + 1), 0.05) << row.n << ", " << row.m;
  }
}

TEST(MannWhitneyTest, ApproximatesWhatIsExactAndIsSymmetric) {
  RandomStream random{6};
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<double> a(20), b(20);
    for (double& value : a) value = random.uniform(0, 1.3);
    for (double& value : b) value = random.uniform(0, 1);
    const MannWhitney exact = mann_whitney(a, b);
    const MannWhitney turned = mann_whitney(b, a);
    EXPECT_NEAR(exact.p, turned.p, 1e-12);
    EXPECT_EQ(exact.u + turned.u, 400);
    // A pair of equal values far from all else leaves the order of the rest.
    std::vector<double> a_tied = a, b_tied = b;
    a_tied.push_back(9);
    b_tied.push_back(9);
    EXPECT_NEAR(mann_whitney(a_tied, b_tied).p, exact.p, 0.03 + 0.1 * exact.p) << trial;
  }
}

/// Of samples that do not differ, 5 % are called different.
TEST(MannWhitneyTest, ErrsAsOftenAsItSays) {
  RandomStream random{8};
  for (const bool rounded : {false, true}) {
    constexpr int kTrials = 4000;
    int significant = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
      std::vector<double> a(12), b(15);
      for (std::vector<double>* sample : {&a, &b}) {
        for (double& value : *sample) {
          value = random.uniform(0, 8);
          if (rounded) value = std::floor(value);
        }
      }
      significant += mann_whitney(a, b).p <= 0.05;
    }
    EXPECT_NEAR(significant, 0.05 * kTrials, 4 * std::sqrt(0.05 * 0.95 * kTrials)) << rounded;
  }
}

}  // namespace
}  // namespace bqsa::harness
