// Envelopes: ellipsoid of least volume and hull of many points, ledger and cover of solids.

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "bqsa/envelope/convex_hull.hpp"
#include "bqsa/envelope/cover.hpp"
#include "bqsa/envelope/least_ellipsoid.hpp"
#include "support/sampling.hpp"

namespace bqsa {
namespace {

using Eigen::Vector3d;

enum Cloud : std::int64_t { kOnEllipsoid, kInBall, kInBox };

std::vector<Vector3d> points(const benchmark::State& state) {
  test_support::Generator generator(1);
  const Ellipsoid ellipsoid({5, -3, 2}, {3, 1, 0.01}, test_support::random_rotation<3>(generator));
  std::vector<Vector3d> result;
  for (std::int64_t i = 0; i < state.range(1); ++i) {
    const Vector3d direction = test_support::random_direction<3>(generator);
    if (state.range(0) == kOnEllipsoid) {
      result.push_back(test_support::surface_point<3>(ellipsoid, direction));
    } else if (state.range(0) == kInBall) {
      result.emplace_back(std::cbrt(test_support::uniform(generator, 0, 1)) * direction);
    } else {
      result.push_back(test_support::random_vector<3>(generator, 1));
    }
  }
  return result;
}

void least_ellipsoid_of_points(benchmark::State& state) {
  const std::vector<Vector3d> cloud = points(state);
  double gap = 0;
  for (auto _ : state) {
    const LeastEllipsoid<3> least = least_ellipsoid<3>(cloud);
    benchmark::DoNotOptimize(least);
    gap = least.volume_gap;
  }
  state.counters["volume_gap"] = gap;
}

void hull_of_points(benchmark::State& state) {
  const std::vector<Vector3d> cloud = points(state);
  for (auto _ : state) benchmark::DoNotOptimize(convex_hull(cloud));
}

const auto kClouds = [](benchmark::internal::Benchmark* work) {
  work->ArgsProduct({{kOnEllipsoid, kInBall, kInBox}, {8, 1000, 100'000, 1'000'000}})
      ->Unit(benchmark::kMillisecond);
};
BENCHMARK(least_ellipsoid_of_points)->Apply(kClouds);
BENCHMARK(hull_of_points)->Apply(kClouds);

void cover_of_cylinder(benchmark::State& state) {
  const Cylinder rod{{0, 0, 0}, {2, 0, 0}, 0.1};
  const CoverSettings settings{.inflation = 1e-6,
                               .max_ellipsoids = static_cast<int>(state.range(0))};
  for (auto _ : state) benchmark::DoNotOptimize(cover(rod, settings));
}
BENCHMARK(cover_of_cylinder)->Arg(1)->Arg(8)->Arg(64)->Unit(benchmark::kMillisecond);

void cover_of_hull(benchmark::State& state) {
  test_support::Generator generator(2);
  std::vector<Vector3d> cloud;
  for (int i = 0; i < 2000; ++i) {
    cloud.push_back(
        test_support::random_direction<3>(generator).cwiseProduct(Vector3d(2, 0.5, 0.3)));
  }
  const ConvexHull hull = convex_hull(cloud);
  const CoverSettings settings{.inflation = 1e-6,
                               .max_ellipsoids = static_cast<int>(state.range(0))};
  for (auto _ : state) benchmark::DoNotOptimize(cover(hull, settings));
}
BENCHMARK(cover_of_hull)->Arg(1)->Arg(8)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace bqsa

BENCHMARK_MAIN();
