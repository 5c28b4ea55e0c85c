#include "harness/measuring/contest.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <ctime>
#include <limits>
#include <numeric>

#include "harness/generator/random_stream.hpp"
#include "harness/statistics/estimates.hpp"

namespace bqsa::harness {
namespace {

constexpr int kMostRepetitions = 1 << 24;  ///< also where the clock stands still
constexpr int kFactor = 4;                 ///< from one attempt of the calibration to the next

double seconds_of(const Contestant& contestant, int repetitions, const ContestClock& clock) {
  const double start = clock();
  contestant.repeat(repetitions);
  return clock() - start;
}

/// What a contestant does in a block, and in how many rounds.
struct Plan {
  int repetitions = 1;
  int rounds = 1;
};

Plan calibrate(const Contestant& contestant, const ContestSettings& settings,
               const ContestClock& clock) {
  seconds_of(contestant, 1, clock);  // cold: memory is touched for the first time
  int repetitions = 1;
  double taken = seconds_of(contestant, repetitions, clock);
  while (taken < settings.block_s / kFactor && repetitions < kMostRepetitions) {
    repetitions *= kFactor;
    taken = seconds_of(contestant, repetitions, clock);
  }
  const double each = taken / repetitions;
  const double wanted = each > 0 ? std::round(settings.block_s / each) : kMostRepetitions;
  Plan plan;
  plan.repetitions = static_cast<int>(std::clamp(wanted, 1.0, double{kMostRepetitions}));
  const double block = std::max(each * plan.repetitions, std::numeric_limits<double>::min());
  const int fewest = std::min(settings.fewest_rounds, settings.rounds);
  plan.rounds = static_cast<int>(
      std::clamp(std::floor(settings.budget_s / block), double(fewest), double(settings.rounds)));
  return plan;
}

/// Whether a contestant with so many rounds of all takes part in this one: evenly spread.
bool takes_part(int round, int its_rounds, int all_rounds) {
  const auto begun = [&](int r) { return std::int64_t{r} * its_rounds / all_rounds; };
  return begun(round + 1) > begun(round);
}

/// Fisher and Yates: every order is equally likely.
void shuffle(std::vector<std::size_t>& order, RandomStream& random) {
  for (std::size_t i = order.size(); i > 1; --i) {
    std::swap(order[i - 1], order[static_cast<std::size_t>(random.whole(0, int(i) - 1))]);
  }
}

/// The middle of value(0) .. value(count - 1), those that are not a number left out.
template <typename Value>
double median_of_known(std::size_t count, const Value& value) {
  std::vector<double> known;
  for (std::size_t i = 0; i < count; ++i) {
    const double one = value(i);
    if (!std::isnan(one)) known.push_back(one);
  }
  std::sort(known.begin(), known.end());
  return known.empty() ? 0 : median_of(known);
}

}  // namespace

double thread_cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::vector<double> typical_seconds(const std::vector<ContestTimes>& times) {
  const std::size_t rounds = times.front().seconds.size();
  std::vector<double> contestant(times.size()), round(rounds);  // effects on the logarithm
  constexpr int kPolishings = 10;
  for (int i = 0; i < kPolishings; ++i) {
    for (std::size_t c = 0; c < times.size(); ++c) {
      contestant[c] = median_of_known(
          rounds, [&](std::size_t r) { return std::log(times[c].seconds[r]) - round[r]; });
    }
    for (std::size_t r = 0; r < rounds; ++r) {
      round[r] = median_of_known(times.size(), [&](std::size_t c) {
        return std::log(times[c].seconds[r]) - contestant[c];
      });
    }
    const double typical = median_of_known(rounds, [&](std::size_t r) { return round[r]; });
    for (double& effect : round) effect -= typical;
  }
  for (double& effect : contestant) effect = std::exp(effect);
  return contestant;
}

std::vector<ContestTimes> run_contest(const std::vector<Contestant>& contestants,
                                      const ContestSettings& settings, const ContestClock& clock) {
  assert(!contestants.empty() && settings.rounds >= 1);
  const auto rounds = static_cast<std::size_t>(settings.rounds);
  std::vector<Plan> plans;
  std::vector<ContestTimes> times;
  for (const Contestant& contestant : contestants) {
    plans.push_back(calibrate(contestant, settings, clock));
    times.push_back({.name = contestant.name,
                     .seconds = std::vector(rounds, std::numeric_limits<double>::quiet_NaN())});
  }
  RandomStream random{settings.seed};
  std::vector<std::size_t> order(contestants.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (int round = 0; round < settings.rounds; ++round) {
    shuffle(order, random);
    for (const std::size_t c : order) {
      const Plan& plan = plans[c];
      if (!takes_part(round, plan.rounds, settings.rounds)) continue;
      times[c].seconds[static_cast<std::size_t>(round)] =
          seconds_of(contestants[c], plan.repetitions, clock) / plan.repetitions;
      times[c].repetitions += plan.repetitions;
    }
  }
  return times;
}

}  // namespace bqsa::harness
