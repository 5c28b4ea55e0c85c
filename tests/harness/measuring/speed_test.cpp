// What speed is compared with does the work that its name says.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "harness/measuring/bystanders.hpp"
#include "harness/measuring/kdl_control_loop.hpp"
#include "harness/measuring/machine_limits.hpp"
#include "harness/measuring/speed_contest.hpp"
#include "harness/measuring/speed_of_pairs.hpp"
#include "support/instruction_sets.hpp"

namespace bqsa::harness {
namespace {

/// All chains go to 1, each a rounding away from it after 60 steps, and start at 1/2. The sum is their number, twelve a lane.
TEST(MachineLimits, MultiplyAddsAreMadeInAllLanes) {
  test_support::with_all_instruction_sets([] {
    const int bytes = instruction_set().bytes;
    const int doubles = bytes / 8;
    const int floats = instruction_set().name == "SCALAR" ? 1 : bytes / 4;
    EXPECT_NEAR(make_multiply_adds(60L * 12 * doubles), 12 * doubles, 1e-9);
    EXPECT_NEAR(make_float_multiply_adds(60L * 12 * floats), 12 * floats, 1e-3);
    // Halfway there the distance from 1 tells how many were made in each chain: 2^-(n + 1).
    EXPECT_NEAR(12 * doubles - make_multiply_adds(5L * 12 * doubles), 12 * doubles / 64.0, 1e-9);
    const double half_way = make_float_multiply_adds(5L * 12 * floats);
    EXPECT_NEAR(12 * floats - half_way, 12 * floats / 64.0, 1e-3);
  });
}

TEST(MachineLimits, EveryNumberIsRead) {
  constexpr std::size_t kCount = 64 * 5;
  alignas(64) double values[kCount];
  std::iota(values, values + kCount, 0.0);
  test_support::with_all_instruction_sets(
      [&] { EXPECT_EQ(read_all(values, kCount), kCount * (kCount - 1) / 2.0); });
}

/// A clock that work moves, 3 s a repetition: what is kept is the time of a unit, of blocks of more rounds.
TEST(SpeedContest, TimesAreOfOneUnit) {
  Sweep sweep{.name = "s", .axis = SweepAxis::kPairs, .sizes = {{}}, .series = {}};
  double now = 0;
  int blocks = 0;
  const auto work = [&](int repetitions) {
    now += 3.0 * repetitions;
    ++blocks;
  };
  const ContestSettings settings{.rounds = 5, .block_s = 3, .budget_s = 15};
  run_speed_contest({{"one", work, 1}, {"thousand", work, 1000}}, settings, sweep,
                    [&now] { return now; });
  ASSERT_EQ(sweep.series.size(), 2u);
  EXPECT_DOUBLE_EQ(sweep.find("one")->seconds[0][0], 3);
  EXPECT_DOUBLE_EQ(sweep.find("thousand")->seconds[0][0], 0.003);
  EXPECT_GE(blocks, 2 * 3 * settings.rounds);
}

TEST(KdlControlLoop, FollowsThePath) {
  for (const KdlTask task : {KdlTask::kPosition, KdlTask::kPose}) {
    for (const Problem& problem : {lonely_problem(2), lonely_puma()}) {
      if (problem.dimension() == 2 && task == KdlTask::kPose)
        continue;  // no such task in the plane
      KdlControlLoop loop(problem, task);
      double turned = 0;
      for (int i = 0; i < 30; ++i) {
        loop.run(7);
        EXPECT_LT(loop.tip_error(), 1e-3) << i;
        turned = std::max(turned, loop.turn_error());
      }
      EXPECT_EQ(turned < 1e-3, task == KdlTask::kPose) << turned;
    }
  }
}

TEST(SafeTestPoints, MissFewAndFewerPointsMissMore) {
  const MissRate safe = safe_test_points();
  EXPECT_LE(safe.miss_rate(), 0.03);
  EXPECT_GT(safe.hits, 10000);
  const PairPopulation pairs(Population::kFirstContact, 3, 1);
  const auto fewer = workload_size(3, 1, safe.size.point_pairs() - 100).test_points;
  EXPECT_GT(pairs.ask(detector_named("test_points_vectorized"), fewer).miss_rate(), 0.03);
}

}  // namespace
}  // namespace bqsa::harness
