#include "harness/log_histogram.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "harness/statistics/estimates.hpp"

namespace bqsa::harness {
namespace {

TEST(LogHistogram, QuantilesAreThoseOfTheValuesToHalfABin) {
  std::mt19937_64 random(5);
  constexpr double kHalfBin = 0.0219;  // 2^(1/32) - 1
  int compared = 0;
  for (int round = 0; round < 50; ++round) {
    std::vector<double> values;
    LogHistogram parts[2];
    for (int i = 0; i < 997; ++i) {
      values.push_back(std::exp2(static_cast<double>(random() >> 11) * 0x1p-53 * (1 + round)));
      parts[i % 2].add(values.back());
    }
    LogHistogram pooled = parts[0];
    pooled.add_all(parts[1]);
    std::sort(values.begin(), values.end());
    EXPECT_EQ(pooled.total(), 997);
    for (const double share : {0.001, 0.25, 0.5, 0.99, 0.999, 1.0}) {
      const double exact = quantile_of(values, share);
      EXPECT_NEAR(pooled.quantile(share) / exact, 1, kHalfBin + 1e-4) << "round " << round;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 300);
}

TEST(LogHistogram, WholeNumbersUpTo22HaveABinEach) {
  for (int i = 0; i <= 22; ++i) {
    LogHistogram one;
    one.add(i);
    EXPECT_EQ(std::round(one.quantile(0.5)), i);
    EXPECT_NE(LogHistogram::bin_of(i), LogHistogram::bin_of(i + 1)) << i;
  }
}

TEST(LogHistogram, BinsBeginAtWholePowers) {
  EXPECT_EQ(LogHistogram::bin_of(0), 0);
  EXPECT_EQ(LogHistogram::bin_of(0.999), 0);
  EXPECT_EQ(LogHistogram::bin_of(1), 1);
  EXPECT_EQ(LogHistogram::bin_of(2), 17);
  EXPECT_EQ(LogHistogram::bin_of(1.9999), 16);
  EXPECT_EQ(LogHistogram::bin_of(-3), 0);
  EXPECT_EQ(LogHistogram::bin_of(std::numeric_limits<double>::quiet_NaN()), 0);
  EXPECT_EQ(LogHistogram::bin_of(std::numeric_limits<double>::infinity()), LogHistogram::kLastBin);
  EXPECT_EQ(LogHistogram::middle_of(0), 0);
}

TEST(LogHistogram, OfNothingHasNoQuantile) {
  EXPECT_TRUE(std::isnan(LogHistogram().quantile(0.5)));
}

}  // namespace
}  // namespace bqsa::harness
