#include "harness/measuring/speed_contest.hpp"

#include <cassert>

namespace bqsa::harness {

void run_speed_contest(const std::vector<SpeedContestant>& contestants, ContestSettings settings,
                       Sweep& sweep, const ContestClock& clock) {
  assert(sweep.sizes.size() == 1);
  constexpr int kMoreRounds = 3;
  settings.rounds *= kMoreRounds;
  settings.budget_s *= kMoreRounds;
  std::vector<Contestant> plain;
  plain.reserve(contestants.size());
  for (const SpeedContestant& one : contestants) plain.push_back({one.name, one.repeat});
  const std::vector<double> seconds = typical_seconds(run_contest(plain, settings, clock));
  for (std::size_t i = 0; i < contestants.size(); ++i) {
    sweep.series.push_back({.name = contestants[i].name,
                            .seconds = {{seconds[i] / contestants[i].units}},
                            .paper_seconds = {}});
  }
}

}  // namespace bqsa::harness
