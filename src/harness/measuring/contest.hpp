/// @file
/// Times of several contestants in one process, block by block in random order, so that what slows the
/// machine down slows all of them alike.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace bqsa::harness {

/// One that takes part. What `repeat` computes it has to make its own and to consume: an answer that
/// nobody looks at is optimised away.
struct Contestant {
  std::string name;
  std::function<void(int repetitions)> repeat;  ///< one after the other, nothing else
};

/// Time since some moment in the past [s].
using ContestClock = std::function<double()>;

/// Processor time of the calling thread: what others do meanwhile does not count [s].
double thread_cpu_seconds();

struct ContestSettings {
  int rounds = 20;
  double block_s = 2e-4;   ///< aimed at for a block; one repetition that takes longer is a block
  double budget_s = 0.02;  ///< of one contestant: it has fewer blocks where they would take longer,
  int fewest_rounds = 3;   ///< but not fewer than these
  std::uint64_t seed = 1;  ///< of the order
};

/// What came out of one contestant.
struct ContestTimes {
  std::string name;
  std::vector<double> seconds;   ///< of a repetition, in each round; not a number if it sat out [s]
  std::int64_t repetitions = 0;  ///< in all blocks together
};

/// Time of a repetition of each contestant in a typical round [s]. A round in which the machine is slow
/// is slow for all: logarithms of times are taken as contestant plus round, both found by Tukey's median
/// polish (Exploratory Data Analysis, 1977), so that single blocks do not count and neither does in which
/// rounds a contestant sat out.
/// @param times  of one contest
std::vector<double> typical_seconds(const std::vector<ContestTimes>& times);

/// First calibrates, which warms up: finds for each contestant the repetitions of a block. Then in
/// every round each contestant has one block, in an order drawn anew. Slow contestants sit out
/// rounds, evenly.
/// @param contestants  at least one
std::vector<ContestTimes> run_contest(const std::vector<Contestant>& contestants,
                                      const ContestSettings& settings,
                                      const ContestClock& clock = thread_cpu_seconds);

}  // namespace bqsa::harness
