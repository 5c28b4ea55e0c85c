#include "harness/measuring/batch_errors.hpp"

#include <gtest/gtest.h>

#include "bqsa/batch/instruction_set.hpp"

namespace bqsa::harness {
namespace {

constexpr std::int64_t kPairs = 4000;

void expect_no_errors(const BatchErrors& errors, PairFamily family) {
  EXPECT_EQ(errors.pairs, kPairs);
  EXPECT_EQ(errors.missed, 0);
  EXPECT_EQ(errors.false_alarms, 0);
  EXPECT_GT(errors.hits, kPairs / 20);
  EXPECT_EQ(errors.hits == kPairs, family == PairFamily::kContained);
}

TEST(BatchErrors, ThereAreNone) {
  for (const PairFamily family : kPairFamilies) {
    for (const int dimension : {2, 3}) {
      const testing::ScopedTrace trace(__FILE__, __LINE__, std::string(name_of(family)));
      const BatchErrors in_double = batch_errors_in_double(family, dimension, kPairs, 1);
      expect_no_errors(in_double, family);
      if (family == PairFamily::kTangent) {
        EXPECT_GT(in_double.in_band, kPairs / 2);
        EXPECT_LT(in_double.in_band, kPairs * 9 / 10);
      } else {
        EXPECT_EQ(in_double.in_band, 0);
      }
      const BatchErrors in_float = batch_errors_in_float(family, dimension, kPairs, 1);
      expect_no_errors(in_float, family);
      EXPECT_EQ(in_float.hits, in_double.hits) << "the same pairs";
    }
  }
  EXPECT_EQ(instruction_set().name, instruction_sets().front().name);
}

}  // namespace
}  // namespace bqsa::harness
