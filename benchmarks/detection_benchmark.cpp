// Time of telling which links hit which obstacles, detector by detector, against NM and against nk, and
// of the fields that BQSA asks, in space and by projections. Inputs are made, and all answers compared
// with the judge's exact distance, before anything is timed.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <list>
#include <string>
#include <vector>

#include "bqsa/obstacle_field.hpp"
#include "bqsa/shadow_field.hpp"
#include "harness/measuring/detector.hpp"
#include "harness/measuring/verify_detector.hpp"
#include "harness/measuring/workload.hpp"

namespace bqsa::harness {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr int kPairs = 27;        // nk, where NM is varied
constexpr int kPointPairs = 600;  // NM, where nk is varied
constexpr int kCheckedPairs = 2000;
constexpr int kCheckedPoses = 8;  // at least

/// Time a pair, in seconds, of iterations over so many pairs.
benchmark::Counter per_pair(int pairs) {
  using benchmark::Counter;
  return {static_cast<double>(pairs), Counter::kIsIterationInvariantRate | Counter::kInvert};
}

/// Times passes over all pairs, pose after pose.
void time_detector(benchmark::State& state, const Detector& detector, const Workload& workload,
                   const Verification& verification) {
  const std::unique_ptr<Detection> detection = detector.prepare(workload);
  std::vector<std::uint8_t> hit(static_cast<std::size_t>(workload.size.pairs()));
  const int poses = static_cast<int>(workload.poses.size());
  int pose = 0;
  for (auto _ : state) {
    detection->detect(pose, hit);
    benchmark::DoNotOptimize(hit.data());
    benchmark::ClobberMemory();
    if (++pose == poses) pose = 0;
  }
  const int hits = verification.hits;
  state.counters["per_pair"] = per_pair(workload.size.pairs());
  state.counters["hits"] = static_cast<double>(hits) / (hits + verification.free);
  state.counters["miss_rate"] = static_cast<double>(verification.missed) / hits;
  const double multiplications = detector.multiplications(workload.size);
  if (std::isfinite(multiplications)) state.counters["multiplications"] = multiplications;
}

/// Registers a detector at one size, if it keeps its promise there.
bool add(const std::string& sweep, int at, const Detector& detector, const Workload& workload,
         const ReferenceAnswers& reference) {
  const Verification verification = verify_detector(detector, workload, reference);
  const std::string broken = broken_promise(detector, verification);
  const std::string name = sweep + "/" + std::string(detector.name) + "/" + std::to_string(at);
  if (!broken.empty()) {
    std::fprintf(stderr, "detection_benchmark: %s: %s\n", name.c_str(), broken.c_str());
    return false;
  }
  benchmark::RegisterBenchmark(name.c_str(),
                               [&detector, &workload, verification](benchmark::State& state) {
                                 time_detector(state, detector, workload, verification);
                               });
  return true;
}

/// Registers all detectors at one size.
bool add_all(const std::string& sweep, int at, const WorkloadSize& size) {
  static std::list<Workload> kept;  // as long as the benchmarks that refer to them
  const Workload& workload = kept.emplace_back(make_workload(size, kSeed));
  const ReferenceAnswers reference =
      reference_answers(workload, std::max(kCheckedPairs, kCheckedPoses * size.pairs()));
  bool kept_promises = true;
  for (const Detector& detector : detectors()) {
    if (!detector.is_for(size.dimension)) continue;
    kept_promises = add(sweep, at, detector, workload, reference) && kept_promises;
  }
  return kept_promises;
}

bool add_sweeps() {
  bool kept_promises = true;
  for (const int dimension : {2, 3}) {
    const std::string scene = dimension == 2 ? "plane" : "space";
    for (const int nm : {1, 2, 4, 12, 25, 50, 100, 200, 600, 1000, 2000, 5000, 10000}) {
      kept_promises =
          add_all(scene + "_nm", nm, workload_size(dimension, kPairs, nm)) && kept_promises;
    }
    for (const int nk : {1, 3, 10, 27, 100, 300, 1000, 3000, 10000}) {
      kept_promises =
          add_all(scene + "_nk", nk, workload_size(dimension, nk, kPointPairs)) && kept_promises;
    }
  }
  return kept_promises;
}

/// An obstacle as Field sees it, and an arm as a pose.
template <typename Field>
struct Asked {
  std::vector<Obstacle> obstacles;
  Field field;
  ChainPose pose;
};

constexpr int kFields = 100;
constexpr int kLinks = 10;

/// A hundred arms of ten links, each with one obstacle.
std::vector<Workload> field_workloads() {
  std::vector<Workload> workloads;
  for (std::uint64_t seed = 0; seed < kFields; ++seed) {
    workloads.push_back(
        make_workload({.dimension = 3, .links = kLinks, .obstacles = 1}, kSeed + seed));
  }
  return workloads;
}

template <typename Field>
std::vector<Asked<Field>> asked(const std::vector<Workload>& workloads, WorkCounters& counters) {
  std::vector<Asked<Field>> all(workloads.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Workload& workload = workloads[k];
    Asked<Field>& one = all[k];
    one.obstacles = {{"obstacle", workload.obstacles.front()}};
    one.field.assign(one.obstacles, counters);
    one.pose.p_WO = workload.poses.front();
  }
  return all;
}

template <typename Field>
int field_hits(const std::vector<Asked<Field>>& all) {
  int hit_count = 0;
  for (const Asked<Field>& one : all) {
    for (int k = 0; k < kLinks; ++k) {
      hit_count += one.field.first_hit(one.pose, {k + 1, k, k + 1}) >= 0;
    }
  }
  return hit_count;
}

template <typename Field>
void add_field(const char* name, const std::vector<Workload>& workloads) {
  benchmark::RegisterBenchmark(name, [&workloads](benchmark::State& state) {
    WorkCounters work;
    const std::vector<Asked<Field>> all = asked<Field>(workloads, work);
    const int hit_count = field_hits(all);
    const auto quadratics = static_cast<double>(work.quadratics);
    for (auto _ : state) benchmark::DoNotOptimize(field_hits(all));
    state.counters["per_pair"] = per_pair(kFields * kLinks);
    state.counters["quadratics"] = quadratics / (kFields * kLinks);
    state.counters["hits"] = static_cast<double>(hit_count) / (kFields * kLinks);
  });
}

/// Registers the fields, if the one finds the hits of the reference and the other not fewer.
bool add_fields() {
  static const std::vector<Workload> kWorkloads = field_workloads();
  int hits = 0;
  for (const Workload& workload : kWorkloads) {
    for (const double clearance : reference_answers(workload, 1).clearance) hits += clearance < 0;
  }
  WorkCounters work;
  const int in_space = field_hits(asked<ObstacleField<3>>(kWorkloads, work));
  const int by_projections = field_hits(asked<ShadowField>(kWorkloads, work));
  if (hits == 0 || in_space != hits || by_projections < hits) {
    std::fprintf(stderr,
                 "detection_benchmark: expected %d hits of field/space and no fewer of "
                 "field/projections, got %d and %d\n",
                 hits, in_space, by_projections);
    return false;
  }
  add_field<ObstacleField<3>>("field/space", kWorkloads);
  add_field<ShadowField>("field/projections", kWorkloads);
  return true;
}

}  // namespace
}  // namespace bqsa::harness

int main(int argc, char** argv) {
  const bool fields_agree = bqsa::harness::add_fields();
  if (!bqsa::harness::add_sweeps() || !fields_agree) {
    std::fputs("detection_benchmark: wrong answers; nothing timed\n", stderr);
    return EXIT_FAILURE;
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return EXIT_FAILURE;
  benchmark::RunSpecifiedBenchmarks();
}
