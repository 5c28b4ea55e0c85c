#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "bqsa/neighbourhood/obstacle_index.hpp"
#include "harness/claims/estimator_lists.hpp"
#include "harness/claims/laboratory.hpp"
#include "harness/generator/nominal_motion.hpp"
#include "harness/generator/random_stream.hpp"
#include "harness/measuring/bystanders.hpp"
#include "harness/measuring/contest.hpp"
#include "harness/methods.hpp"

namespace bqsa::harness::claims {
namespace {

/// An arm in a cube full of obstacles, as many a cubic metre whatever their number.
class Crowd {
 public:
  Crowd(int obstacles, std::uint64_t seed) : problem_(lonely_problem(3)) {
    constexpr double kDensity = 30;                      // [1/m³]
    constexpr double kShortest = 0.03, kLongest = 0.12;  // semi-axes [m]
    const double half = std::cbrt(obstacles / kDensity) / 2;
    Problem period = problem_;
    period.ticks = kBystanderPeriod;
    const NominalMotion nominal(period);
    RandomStream random{seed, static_cast<std::uint64_t>(obstacles)};
    problem_.obstacles.reserve(static_cast<std::size_t>(obstacles));
    while (static_cast<int>(problem_.obstacles.size()) < obstacles) {
      Eigen::Vector3d center, axes;
      for (double& x : center) x = random.uniform(-half, half);
      for (double& axis : axes) axis = random.uniform(kShortest, kLongest);
      const Eigen::Vector4d turn = random.quaternion();
      const Eigen::Quaterniond rotation(turn(0), turn(1), turn(2), turn(3));
      Obstacle obstacle{"", Ellipsoid(center, axes, rotation.toRotationMatrix())};
      if (is_in_the_way(nominal, obstacle)) continue;
      problem_.obstacles.push_back(std::move(obstacle));
    }
    loop_ = std::make_unique<ControlLoop>(parse_method_spec("bqsa", methods()), problem_);
  }

  ControlLoop& loop() { return *loop_; }
  const Problem& problem() const { return problem_; }

 private:
  /// Within reach of the arm; whether it is clear of the motion is only asked of such.
  static bool is_in_the_way(const NominalMotion& nominal, const Obstacle& obstacle) {
    constexpr double kReach =
        1.6;  // of the arm, from its base, an obstacle's longest axis added [m]
    if (obstacle.shape.center().norm() > kReach) return false;
    for (int tick = 0; tick <= kBystanderPeriod; ++tick) {
      if (!nominal.is_clear(tick, obstacle, kClearance)) return true;
    }
    return false;
  }

  static constexpr double kClearance = 0.05;  // [m]

  Problem problem_;
  std::unique_ptr<ControlLoop> loop_;
};

/// Whole periods of the motion: neighbour lists are made anew where they have to be.
std::function<void(int)> periods_of(ControlLoop& loop) {
  return [&loop](int periods) { loop.run(periods * kBystanderPeriod); };
}

Findings many_obstacles(const Arguments&, Laboratory& laboratory) {
  constexpr int kSizes[] = {1000, 10'000, 100'000, 1'000'000};
  constexpr double kMicrosecond = 1e-6;
  const int scenes = laboratory.full() ? 5 : 3;
  Sweep sweep{.name = "", .axis = SweepAxis::kPairs, .sizes = {}, .series = {{"step", {}, {}}}};
  Series& series = sweep.series.front();
  series.seconds.resize(std::size(kSizes));
  for (const int k : kSizes) sweep.sizes.push_back({.dimension = 3, .links = 1, .obstacles = k});
  double bytes = 0;
  for (int scene = 1; scene <= scenes; ++scene) {
    std::vector<std::unique_ptr<Crowd>> crowds;
    std::vector<Contestant> contestants;
    for (const int k : kSizes) {
      crowds.push_back(std::make_unique<Crowd>(k, static_cast<std::uint64_t>(scene)));
      contestants.push_back({std::to_string(k), periods_of(crowds.back()->loop())});
    }
    const std::vector<double> seconds = typical_seconds(run_contest(
        contestants, {.rounds = 40, .budget_s = 0.2, .seed = static_cast<std::uint64_t>(scene)}));
    for (std::size_t i = 0; i < seconds.size(); ++i) {
      series.seconds[i].push_back(seconds[i] / kBystanderPeriod);
    }
    for (const auto& crowd : crowds) {
      if (crowd->loop().infeasible() == 0) continue;
      return {.figures = {}, .remarks = {"the arm gave up, so that there are no times"}};
    }
    const Crowd& largest = *crowds.back();
    bytes = static_cast<double>(ObstacleIndex(largest.problem().obstacles).bytes()) /
            static_cast<double>(largest.problem().obstacles.size());
  }
  const auto at = [&](std::size_t size) {
    Estimate time = time_of(sweep, "step", size);
    return Figure{size == 0 ? "step_least" : "step_most", time.value / kMicrosecond,
                  Interval{time.interval.lower / kMicrosecond, time.interval.upper / kMicrosecond}};
  };
  const Estimate exponent = time_exponent(sweep, "step");
  return {.figures = {{"obstacles", static_cast<double>(kSizes[std::size(kSizes) - 1])},
                      {"exponent", exponent.value, exponent.interval},
                      at(0),
                      at(std::size(kSizes) - 1),
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
