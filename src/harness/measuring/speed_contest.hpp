/// @file
/// Times of contestants that do the same work in different portions, all at one size.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "harness/measuring/contest.hpp"
#include "harness/measuring/sweep.hpp"

namespace bqsa::harness {

/// As a Contestant; its repetition is so many units of the work that a sweep takes the time of.
struct SpeedContestant {
  std::string name;
  std::function<void(int repetitions)> repeat;
  double units = 1;
};

/// Adds their times of one unit to a sweep of one size. There are few of them, so that each has more
/// rounds than the settings say.
void run_speed_contest(const std::vector<SpeedContestant>& contestants, ContestSettings settings,
                       Sweep& sweep, const ContestClock& clock = thread_cpu_seconds);

}  // namespace bqsa::harness
