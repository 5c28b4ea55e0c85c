#include <deque>
#include <functional>
#include <string>

#include "bqsa/neighbourhood/obstacle_index.hpp"
#include "harness/claims/estimator_lists.hpp"
#include "harness/claims/laboratory.hpp"
#include "harness/measuring/bystanders.hpp"
#include "harness/measuring/contest.hpp"
#include "harness/measuring/crowds.hpp"
#include "harness/methods.hpp"

namespace bqsa::harness::claims {
namespace {

/// Whole periods of the motion: neighbour lists are made anew where they have to be.
std::function<void(int)> periods_of(ControlLoop& loop) {
  return [&loop](int periods) { loop.run(periods * kBystanderPeriod); };
}

/// The crowd is the same in all contests; what differs is what the machine does meanwhile.
Findings many_obstacles(const Arguments&, Laboratory& laboratory) {
  constexpr int kSizes[] = {1000, 10'000, 100'000, 1'000'000};
  constexpr double kMicrosecond = 1e-6;
  const std::size_t last = std::size(kSizes) - 1;
  const int contests = laboratory.full() ? 10 : 4;
  Sweep sweep{.name = "", .axis = SweepAxis::kPairs, .sizes = {}, .series = {{"step", {}, {}}}};
  Series& series = sweep.series.front();
  series.seconds.resize(std::size(kSizes));
  const Problem lonely = lonely_problem(3);
  const std::vector<Obstacle> crowd = draw_crowd(lonely, kSizes[last]);
  const MethodSpec method = parse_method_spec("bqsa", methods());
  std::deque<Problem> problems;  // where addresses stay, as with the loops
  std::deque<ControlLoop> loops;
  std::vector<Contestant> contestants;
  for (const int k : kSizes) {
    sweep.sizes.push_back({.dimension = 3, .links = 1, .obstacles = k});
    Problem& problem = problems.emplace_back(lonely);
    problem.obstacles.assign(crowd.begin(), crowd.begin() + k);
    contestants.push_back({std::to_string(k), periods_of(loops.emplace_back(method, problem))});
  }
  for (int contest = 1; contest <= contests; ++contest) {
    const std::vector<double> seconds = typical_seconds(
        run_contest(contestants, {.budget_s = 0.1, .seed = static_cast<std::uint64_t>(contest)}));
    for (std::size_t i = 0; i < seconds.size(); ++i) {
      series.seconds[i].push_back(seconds[i] / kBystanderPeriod);
    }
  }
  for (const ControlLoop& loop : loops) require_left_alone(method, lonely, loop);
  const double bytes =
      static_cast<double>(ObstacleIndex(problems.back().obstacles).bytes()) / kSizes[last];
  const auto at = [&](std::size_t size) {
    Estimate time = time_of(sweep, "step", size);
    return Figure{size == 0 ? "step_least" : "step_most", time.value / kMicrosecond,
                  Interval{time.interval.lower / kMicrosecond, time.interval.upper / kMicrosecond}};
  };
  const Estimate exponent = time_exponent(sweep, "step");
  return {.figures = {{"obstacles", static_cast<double>(kSizes[last])},
                      {"exponent", exponent.value, exponent.interval},
                      at(0),
                      at(last),
                      {"bytes", bytes}},
          .remarks = {}};
}

}  // namespace

std::vector<Estimator> crowd_estimators() {
  return {{.name = "many_obstacles",
           .what = "Control steps of bqsa in space among 1,000 to 1,000,000 obstacles of the same "
                   "number a cubic metre",
           .timing = true,
           .arguments = {},
           .figures = {{"obstacles", "-", "the largest number"},
                       {"exponent", "-", "slope of log(time) against log(obstacles)"},
                       {"step_least", "us", "a step among the fewest", true},
                       {"step_most", "us", "a step among the most", true},
                       {"bytes", "-", "of memory that the index takes, an obstacle"}},
           .estimate = many_obstacles}};
}

}  // namespace bqsa::harness::claims
