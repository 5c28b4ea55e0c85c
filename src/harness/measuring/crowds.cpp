#include "harness/measuring/crowds.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

#include "bqsa/neighbourhood/obstacle_index.hpp"
#include "harness/generator/nominal_motion.hpp"
#include "harness/generator/random_stream.hpp"
#include "harness/measuring/bystanders.hpp"

namespace bqsa::harness {
namespace {

constexpr double kTurn = std::numbers::pi / 2;       // about the base [rad]
constexpr double kCell = 0.3;                        // [m]
constexpr double kShortest = 0.03, kLongest = 0.12;  // semi-axes [m]

/// A cell of the lattice around the base, by its steps from there.
struct Cell {
  int x, y, z;

  int squared_distance() const { return x * x + y * y + z * z; }
};

/// Those within `radius` cells of the base, nearest first.
std::vector<Cell> cells_within(int dimension, int radius) {
  std::vector<Cell> cells;
  const int height = dimension == 2 ? 0 : radius;
  for (int x = -radius; x <= radius; ++x) {
    for (int y = -radius; y <= radius; ++y) {
      for (int z = -height; z <= height; ++z) {
        const Cell cell{x, y, z};
        if (cell.squared_distance() <= radius * radius) cells.push_back(cell);
      }
    }
  }
  std::ranges::sort(cells, {}, [](const Cell& cell) {
    return std::tuple(cell.squared_distance(), cell.x, cell.y, cell.z);
  });
  return cells;
}

Obstacle draw(const Cell& cell, int dimension, RandomStream& random) {
  const auto somewhere_in = [&random](int step) {
    return kCell * (step + random.uniform(-0.5, 0.5));
  };
  Eigen::Vector3d center(somewhere_in(cell.x), somewhere_in(cell.y), somewhere_in(cell.z));
  Eigen::Vector3d axes;
  for (double& axis : axes) axis = random.uniform(kShortest, kLongest);
  if (dimension == 2) {
    const double turn = random.uniform(0, std::numbers::pi);
    return {"crowd", embedded(rotated_ellipse(center.head<2>(), axes.head<2>(), turn))};
  }
  const Eigen::Vector4d turn = random.quaternion();
  const Eigen::Quaterniond rotation(turn(0), turn(1), turn(2), turn(3));
  return {"crowd", Ellipsoid(center, axes, rotation.toRotationMatrix())};
}

/// Whether the arm comes near the obstacle; far away that is told by its reach.
bool is_in_the_way(const NominalMotion& nominal, const Obstacle& obstacle) {
  const SerialChain& chain = nominal.problem().chain;
  const Eigen::Vector3d base = nominal.pose(0).p_WO.col(0);
  double length = 0;
  for (const Link& link : chain.links()) {
    const auto& p_WO = nominal.pose(0).p_WO;
    length += (p_WO.col(link.end) - p_WO.col(link.start)).norm();
  }
  const double away = (obstacle.shape.center() - base).norm();
  if (away > length + kLongest + kBystanderClearance) return false;
  for (int tick = 0; tick <= nominal.problem().ticks; ++tick) {
    if (!nominal.is_clear(tick, obstacle, kBystanderClearance)) return true;
  }
  return false;
}

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

Problem wandering_problem(int dimension) {
  Problem problem = lonely_problem(dimension);
  problem.name = "crowd";
  ChainPose pose;
  problem.chain.forward(problem.start, pose);
  const Eigen::Vector3d base = pose.p_WO.col(0), from = pose.tip() - base;
  const double period = kBystanderPeriod * problem.dt;
  problem.desired_tip = [base, from, period](double t) -> Eigen::Vector3d {
    const double turn = kTurn / 2 * (1 - std::cos(2 * std::numbers::pi * t / period));
    return base + Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()) * from;
  };
  return problem;
}

std::vector<Obstacle> draw_crowd(const Problem& wandering, int count) {
  Problem period = wandering;
  period.ticks = kBystanderPeriod;
  const NominalMotion nominal(period);
  const int dimension = wandering.dimension();
  for (int radius = 8;; radius += radius / 4) {
    RandomStream random{static_cast<std::uint64_t>(dimension), 7};
    std::vector<Obstacle> crowd;
    for (const Cell& cell : cells_within(dimension, radius)) {
      Obstacle obstacle = draw(cell, dimension, random);
      if (is_in_the_way(nominal, obstacle)) continue;
      crowd.push_back(std::move(obstacle));
      if (static_cast<int>(crowd.size()) == count) return crowd;
    }
  }
}

CrowdedSteps run_crowded(const MethodEntry& method, int dimension, int obstacles, int periods,
                         const ContestClock& clock) {
  assert(periods > 0);
  Problem problem = wandering_problem(dimension);
  problem.obstacles = draw_crowd(problem, obstacles);
  CrowdedSteps result{.obstacles = obstacles};
  const double before = wall_seconds();
  ControlLoop loop(with_defaults(method), problem);
  result.prepare_s = wall_seconds() - before;
  loop.run(1);
  result.first_bounds = static_cast<double>(loop.counters().bounds);
  loop.run(2 * kBystanderPeriod - 1);
  const WorkCounters warm = loop.counters();
  std::vector<double> times;
  const int steps = periods * kBystanderPeriod;
  times.reserve(static_cast<std::size_t>(steps));
  for (int step = 0; step < steps; ++step) {
    const double start = clock();
    loop.run(1);
    times.push_back(clock() - start);
  }
  result.mean_s = std::accumulate(times.begin(), times.end(), 0.0) / steps;
  std::ranges::sort(times);
  result.median_s = times[times.size() / 2];
  result.worst_s = times.back();
  result.infeasible = loop.infeasible();
  result.quadratics = static_cast<double>(loop.counters().quadratics - warm.quadratics) / steps;
  result.bounds = static_cast<double>(loop.counters().bounds - warm.bounds) / steps;
  result.index_bytes =
      static_cast<double>(ObstacleIndex(problem.obstacles).bytes()) / std::max(obstacles, 1);
  return result;
}

double growth_exponent(std::span<const CrowdedSteps> runs, double CrowdedSteps::*quantity) {
  assert(runs.size() > 1);
  double mean_x = 0, mean_y = 0;
  for (const CrowdedSteps& run : runs) {
    mean_x += std::log(run.obstacles) / static_cast<double>(runs.size());
    mean_y += std::log(run.*quantity) / static_cast<double>(runs.size());
  }
  double xy = 0, xx = 0;
  for (const CrowdedSteps& run : runs) {
    const double x = std::log(run.obstacles) - mean_x;
    xy += x * (std::log(run.*quantity) - mean_y);
    xx += x * x;
  }
  return xy / xx;
}

}  // namespace bqsa::harness
