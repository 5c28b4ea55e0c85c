#include "harness/measuring/distance_errors.hpp"

#include <gtest/gtest.h>

#include "bqsa/batch/instruction_set.hpp"

namespace bqsa::harness {
namespace {

TEST(DistanceErrors, AreBelowTheBound) {
  constexpr std::int64_t kPairs = 256 * 12;
  const DistanceErrors errors = batched_distance_errors(kPairs, 1);
  EXPECT_EQ(errors.pairs, kPairs);
  EXPECT_GT(errors.meeting, kPairs / 100);
  EXPECT_LT(errors.meeting, kPairs / 2);
  EXPECT_EQ(errors.disagreed, 0);
  EXPECT_LT(errors.distance, 1e-9);
  EXPECT_LT(errors.point, 1e-9);
  EXPECT_GT(errors.distance, 0) << "doubles round";
  EXPECT_GT(errors.point, 0);
  EXPECT_EQ(instruction_set().name, instruction_sets().front().name);
}

}  // namespace
}  // namespace bqsa::harness
