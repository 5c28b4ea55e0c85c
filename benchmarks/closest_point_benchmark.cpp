// Time of finding the closest points of links and obstacles, search by search: on the arm and
// obstacles of the paper's planar scene, and on the same arm among 40 spatial ellipsoids. The time
// of a pair is that of the tick over all pairs, those left out by a search included.

#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <limits>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "baselines/closest/exact_distance_search.hpp"
#include "baselines/closest/fcl_distance_search.hpp"
#include "baselines/closest/segment_ellipsoid_distance.hpp"
#include "baselines/closest/test_point_search.hpp"
#include "baselines/closest/vectorized_test_point_search.hpp"

namespace bqsa::baselines {
namespace {

constexpr int kPoses = 1000;
constexpr TestPointCounts kTestPoints{.link = 25, .obstacle = 240};  // the defaults of test_point

struct Inputs {
  explicit Inputs(bool crowded) {
    std::mt19937_64 generator(1);
    std::uniform_real_distribution<double> unit(-1, 1);
    if (crowded) {
      problem.obstacles.clear();
      while (problem.obstacles.size() < 40) {
        const Eigen::Vector3d center(2.5 * unit(generator), 2.5 * unit(generator), unit(generator));
        const Eigen::Vector3d semi_axes(0.12 + 0.08 * unit(generator),
                                        0.12 + 0.08 * unit(generator),
                                        0.12 + 0.08 * unit(generator));
        const Eigen::AngleAxisd turn(3 * unit(generator), Eigen::Vector3d::UnitX());
        problem.obstacles.push_back(
            {"ellipsoid", Ellipsoid(center, semi_axes, turn.toRotationMatrix())});
      }
    }
    JointVector start(7);
    start << 1.36, -0.44, -0.68, -0.26, -0.72, -0.80, -0.63;
    while (poses.size() < kPoses) {
      JointVector q = start;
      for (double& angle : q) angle += 0.5 * unit(generator);
      ChainPose pose;
      problem.chain.forward(q, pose);
      if (crowded || apart(pose)) poses.push_back(pose);
    }
  }

  bool apart(const ChainPose& pose) const {
    for (const Obstacle& obstacle : problem.obstacles) {
      for (const Link& link : problem.chain.links()) {
        if (segment_distance(pose.p_WO.col(link.start), pose.p_WO.col(link.end), obstacle.shape)
                .distance == 0) {
          return false;
        }
      }
    }
    return true;
  }

  std::size_t pairs() const { return problem.chain.links().size() * problem.obstacles.size(); }

  Problem problem{
      .name = "benchmark",
      .chain = SerialChain(planar_chain(std::vector<double>(7, 0.4))),
      .obstacles = {{"object", embedded(rotated_ellipse({1.6, -0.35}, {0.45, 0.30}, 0))},
                    {"obstacle", embedded(rotated_ellipse({1.75, 0.58}, {0.21, 0.10}, 0))}}};
  std::vector<ChainPose> poses;
};

using MakeSearch = std::unique_ptr<ClosestPointSearch> (*)();

void search(benchmark::State& state, MakeSearch make, const Inputs& inputs, double reach) {
  const std::unique_ptr<ClosestPointSearch> search = make();
  WorkCounters counters;
  search->assign(inputs.problem, 0.066, counters);
  std::vector<ClosestPoint> found;
  found.reserve(inputs.pairs());
  std::size_t k = 0;
  for (auto _ : state) {
    search->search(inputs.poses[k++ % kPoses], reach, found);
    benchmark::DoNotOptimize(found.data());
  }
  const auto ticks = static_cast<double>(state.iterations());
  state.counters["pairs/s"] =
      benchmark::Counter(ticks * static_cast<double>(inputs.pairs()), benchmark::Counter::kIsRate);
  state.counters["queries/tick"] = static_cast<double>(counters.distance_queries) / ticks;
}

template <FclSolver Solver, bool Broadphase>
std::unique_ptr<ClosestPointSearch> fcl() {
  return std::make_unique<FclDistanceSearch>(Solver, Broadphase);
}

void register_all() {
  static const Inputs kPlanar(false), kCrowded(true);
  const std::pair<const char*, MakeSearch> searches[] = {
      {"exact", [] { return std::unique_ptr<ClosestPointSearch>(new ExactDistanceSearch); }},
      {"test_points",
       [] { return std::unique_ptr<ClosestPointSearch>(new TestPointSearch(kTestPoints)); }},
      {"test_points_vectorized",
       [] {
         return std::unique_ptr<ClosestPointSearch>(new VectorizedTestPointSearch(kTestPoints));
       }},
      {"fcl/indep_mm", fcl<FclSolver::kIndepMillimetres, false>},
      {"fcl/indep_mm/broadphase", fcl<FclSolver::kIndepMillimetres, true>},
      {"fcl/libccd_mm", fcl<FclSolver::kLibccdMillimetres, false>},
      {"fcl/libccd_m", fcl<FclSolver::kLibccdMetres, false>},
  };
  const auto add = [](const std::string& scene, const Inputs& inputs, const char* name,
                      MakeSearch make, double reach) {
    benchmark::RegisterBenchmark(
        (scene + "/" + name).c_str(),
        [make, &inputs, reach](benchmark::State& state) { search(state, make, inputs, reach); });
  };
  for (const auto& [name, make] : searches) {
    add("planar_all_pairs", kPlanar, name, make, std::numeric_limits<double>::infinity());
    add("planar_within_4cm", kPlanar, name, make, 0.04);
    add("crowded_within_4cm", kCrowded, name, make, 0.04);
  }
}

}  // namespace
}  // namespace bqsa::baselines

int main(int argc, char** argv) {
  bqsa::baselines::register_all();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
