#include "harness/measuring/contest.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace bqsa::harness {
namespace {

/// A machine whose time passes only when contestants work, and whose pace changes as it likes.
class FakeMachine {
 public:
  std::function<double(double now)> pace = [](double) { return 1.0; };  ///< 1: as fast as ever

  Contestant contestant(const std::string& name, double seconds) {
    return {name, [this, name, seconds](int repetitions) {
              now_ += repetitions * seconds * pace(now_);
              log.emplace_back(name, repetitions);
            }};
  }
  ContestClock clock() {
    return [this] { return now_; };
  }

  std::vector<std::pair<std::string, int>> log;  ///< blocks, those of the calibration included

 private:
  double now_ = 0;
};

const ContestSettings kSettings{
    .rounds = 300, .block_s = 1e-3, .budget_s = 1e9, .fewest_rounds = 3, .seed = 5};

TEST(Contests, FindTheTimeOfARepetition) {
  FakeMachine machine;
  const auto times = run_contest({machine.contestant("a", 1e-7), machine.contestant("b", 3e-5)},
                                 kSettings, machine.clock());
  ASSERT_EQ(times.size(), 2u);
  EXPECT_EQ(times[0].name, "a");
  ASSERT_EQ(times[0].seconds.size(), 300u);
  for (const double time : times[0].seconds) EXPECT_NEAR(time, 1e-7, 1e-12);
  for (const double time : times[1].seconds) EXPECT_NEAR(time, 3e-5, 1e-12);
  EXPECT_THAT(typical_seconds(times), testing::ElementsAre(testing::DoubleNear(1e-7, 1e-12),
                                                           testing::DoubleNear(3e-5, 1e-12)));
}

TEST(Contests, CalibrateBlocksToTheLengthAskedFor) {
  FakeMachine machine;
  const auto times =
      run_contest({machine.contestant("quick", 1e-8), machine.contestant("middling", 4e-4),
                   machine.contestant("slow", 2.0)},
                  kSettings, machine.clock());
  std::map<std::string, int> block;
  for (const auto& [name, repetitions] : machine.log) block[name] = repetitions;
  EXPECT_NEAR(block["quick"], 100'000, 10);
  EXPECT_EQ(block["middling"], 3);  // 1.2 ms rather than 0.8
  EXPECT_EQ(block["slow"], 1);
  EXPECT_EQ(times[2].repetitions, 300);
  EXPECT_EQ(times[1].repetitions, 900);
}

TEST(Contests, LetSlowContestantsSitOutRoundsEvenly) {
  FakeMachine machine;
  ContestSettings settings = kSettings;
  settings.rounds = 12;
  settings.budget_s = 0.21;
  const auto times =
      run_contest({machine.contestant("quick", 1e-6), machine.contestant("slow", 0.05),
                   machine.contestant("slowest", 1.0)},
                  settings, machine.clock());
  const auto rounds_of = [](const ContestTimes& contestant) {
    std::vector<int> rounds;
    for (int r = 0; r < 12; ++r) {
      if (!std::isnan(contestant.seconds[static_cast<std::size_t>(r)])) rounds.push_back(r);
    }
    return rounds;
  };
  EXPECT_EQ(rounds_of(times[0]).size(), 12u);
  EXPECT_THAT(rounds_of(times[1]), testing::ElementsAre(2, 5, 8, 11));
  EXPECT_THAT(rounds_of(times[2]), testing::ElementsAre(3, 7, 11));  // over the budget all the same
  EXPECT_NEAR(typical_seconds(times)[2], 1.0, 1e-9);
}

/// Contestants of 2, 10 and three of 3 s, a machine of two speeds, and two blocks that were disturbed. By medians over blocks alone the second, of which only slow rounds are left, would seem to
/// take 16 s.
TEST(Contests, TypicalTimesDoNotDependOnTheRoundsThatWereSlow) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> pace{1, 1.6, 1, 1, 1.6, 1, 1.6, 1, 1};
  std::vector<ContestTimes> times(5);
  for (const double slower : pace) {
    times[0].seconds.push_back(2 * slower);
    times[1].seconds.push_back(slower > 1 ? 10 * slower : none);
    for (const std::size_t c : {2, 3, 4}) times[c].seconds.push_back(3 * slower);
  }
  times[0].seconds[3] *= 50;
  times[2].seconds[0] *= 7;
  const std::vector<double> seconds = typical_seconds(times);
  EXPECT_NEAR(seconds[0], 2, 1e-9);
  EXPECT_NEAR(seconds[1], 10, 1e-9);
  for (const std::size_t c : {2, 3, 4}) EXPECT_NEAR(seconds[c], 3, 1e-9);
}

/// Halfway the machine becomes three times slower, and its pace wavers: alone, one contestant would have
/// been lucky. Interleaved, their ratio is the true one.
TEST(Contests, PairingRemovesWhatSlowsTheMachineDown) {
  FakeMachine machine;
  machine.pace = [](double now) { return (now > 0.3 ? 3 : 1) * (1 + 0.3 * std::sin(3 * now)); };
  const auto times = run_contest({machine.contestant("a", 1e-6), machine.contestant("b", 1.25e-6)},
                                 kSettings, machine.clock());
  std::vector<double> ratios;
  for (std::size_t r = 0; r < times[0].seconds.size(); ++r) {
    ratios.push_back(times[1].seconds[r] / times[0].seconds[r]);
  }
  std::sort(ratios.begin(), ratios.end());
  EXPECT_NEAR(ratios[ratios.size() / 2], 1.25, 0.01);
  const auto [least, most] = std::minmax_element(times[0].seconds.begin(), times[0].seconds.end());
  EXPECT_GT(*most / *least, 2.5);  // the drift was there
}

TEST(Contests, DrawTheOrderOfEveryRoundAnewAndFairly) {
  FakeMachine machine;
  run_contest(
      {machine.contestant("a", 1e-3), machine.contestant("b", 1e-3), machine.contestant("c", 1e-3)},
      kSettings, machine.clock());
  std::map<std::string, int> orders;
  const std::size_t first = machine.log.size() - 900;
  for (std::size_t i = first; i < machine.log.size(); i += 3) {
    std::string order = machine.log[i].first + machine.log[i + 1].first + machine.log[i + 2].first;
    ++orders[order];
    std::sort(order.begin(), order.end());
    EXPECT_EQ(order, "abc");
  }
  ASSERT_EQ(orders.size(), 6u);
  // 300 rounds, six orders: 50 each, standard deviation 6.5.
  for (const auto& [order, count] : orders) EXPECT_NEAR(count, 50, 4 * 6.5) << order;
}

TEST(Contests, KeepTheOrderOfTheirSeed) {
  const auto order = [](std::uint64_t seed) {
    FakeMachine machine;
    ContestSettings settings = kSettings;
    settings.seed = seed;
    run_contest({machine.contestant("a", 1e-3), machine.contestant("b", 1e-3)}, settings,
                machine.clock());
    return machine.log;
  };
  EXPECT_EQ(order(1), order(1));
  EXPECT_NE(order(1), order(2));
}

TEST(Contests, CountProcessorTimeOfTheThread) {
  const double before = thread_cpu_seconds();
  volatile double sink = 0;
  for (int i = 0; i < 1'000'000; ++i) sink = sink + 1;
  EXPECT_GT(thread_cpu_seconds(), before);
}

}  // namespace
}  // namespace bqsa::harness
