#include "harness/measuring/speed_of_pairs.hpp"

#include <algorithm>
#include <deque>

#include "bqsa/geometry/segment_test.hpp"
#include "harness/measuring/detector_passes.hpp"
#include "harness/measuring/end_points.hpp"
#include "harness/measuring/machine_limits.hpp"
#include "harness/measuring/speed_contest.hpp"

namespace bqsa::harness {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr int kSparsePointPairs = 12;  ///< NM just below the paper's crossover of 12.5
constexpr const char* kTestPoints = "test_points_vectorized";

/// What is compared with batches. All take their time of the same workload.
constexpr const char* kDetectors[] = {
    "bqsa",           "fcl_collide_libccd", "fcl_collide_indep", "fcl_distance_libccd",
    "exact_distance", "fcl_distance_indep", "ccd_gjk",           "ccd_mpr"};

Workload workload_with(const baselines::TestPointCounts& test_points) {
  WorkloadSize size = kSpeedSize;
  size.test_points = test_points;
  return make_workload(size, kSeed);
}

/// Every pair by a call of its own, nothing shared between pairs.
class SingleCalls {
 public:
  explicit SingleCalls(const Workload& workload)
      : points_(workload),
        poses_(static_cast<int>(workload.poses.size())),
        obstacles_(workload.obstacles) {}

  void make(int passes) {
    for (int i = 0; i < passes; ++i) {
      const auto points = points_[pose_];
      for (const Ellipsoid& obstacle : obstacles_) {
        for (std::size_t k = 1; k < points.size(); ++k) {
          hits_ += hits(polar_form<3>(obstacle, points[k - 1], points[k]));
        }
      }
      pose_ = pose_ + 1 < poses_ ? pose_ + 1 : 0;
    }
  }

 private:
  EndPoints<3> points_;
  int poses_;
  int pose_ = 0;
  std::vector<Ellipsoid> obstacles_;
  std::uint64_t hits_ = 0;
};

MissRate misses_at(const PairPopulation& pairs, int point_pairs) {
  return pairs.ask(detector_named(kTestPoints),
                   workload_size(kSpeedSize.dimension, 1, point_pairs).test_points);
}

}  // namespace

MissRate safe_test_points() {
  constexpr double kSafe = 0.03;
  constexpr int kStep = 100, kMost = 200;  // steps
  const PairPopulation pairs(Population::kFirstContact, kSpeedSize.dimension, kSeed);
  int unsafe = 0, safe = kMost;
  while (safe - unsafe > 1) {
    const int middle = (safe + unsafe) / 2;
    (misses_at(pairs, kStep * middle).miss_rate() <= kSafe ? safe : unsafe) = middle;
  }
  return misses_at(pairs, kStep * safe);
}

void measure_speed_of_pairs(const ContestSettings& settings, int verified_pairs, Sweep& sweep) {
  sweep.sizes.push_back(kSpeedSize);
  const Workload workload = workload_with(kSpeedSize.test_points);
  std::vector<const Detector*> detectors;
  for (const char* name : kDetectors) detectors.push_back(&detector_named(name));
  require_right_answers(workload, detectors, verified_pairs);

  std::vector<SpeedContestant> contestants;
  std::deque<DetectorPasses> passes;  // where addresses stay
  const auto add_passes = [&](const std::string& name, const Detector& detector,
                              const Workload& of) {
    DetectorPasses& one = passes.emplace_back(detector, of);
    contestants.push_back({name, [&one](int repetitions) { one.make(repetitions); }});
  };
  for (const Detector* detector : detectors) {
    add_passes(std::string(detector->name), *detector, workload);
  }
  const Workload sparse = workload_with(
      workload_size(kSpeedSize.dimension, kSpeedSize.links, kSparsePointPairs).test_points);
  const Workload safe = workload_with(safe_test_points().size.test_points);
  const Detector& points = detector_named(kTestPoints);
  require_right_answers(sparse, {&points}, verified_pairs);
  require_right_answers(safe, {&points}, verified_pairs);
  add_passes("test_points_12", points, sparse);
  add_passes("test_points_safe", points, safe);

  SingleCalls single(workload);
  contestants.push_back({"single_call", [&](int repetitions) { single.make(repetitions); }});

  volatile double sink = 0;
  constexpr std::int64_t kMultiplyAdds =
      std::int64_t{kMultiplyAddsOfPair} * kSpeedSize.links * kSpeedSize.obstacles;
  contestants.push_back({"multiply_adds", [&](int repetitions) {
                           sink = make_multiply_adds(kMultiplyAdds * repetitions);
                         }});
  contestants.push_back({"multiply_adds_float", [&](int repetitions) {
                           sink = make_float_multiply_adds(kMultiplyAdds * repetitions);
                         }});
  run_speed_contest(contestants, settings, sweep);
}

}  // namespace bqsa::harness
