#include "harness/measuring/speed_of_pairs.hpp"

#include <algorithm>
#include <deque>
#include <numbers>
#include <stdexcept>

#include "bqsa/batch/batched_test.hpp"
#include "bqsa/batch/configuration_check.hpp"
#include "bqsa/geometry/segment_test.hpp"
#include "harness/generator/random_stream.hpp"
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
constexpr const char* kDetectors[] = {"bqsa",
                                      "bqsa_batch",
                                      "bqsa_batch_float",
                                      "fcl_collide_libccd",
                                      "fcl_collide_indep",
                                      "fcl_distance_libccd",
                                      "fcl_distance_indep",
                                      "exact_distance",
                                      "exact_distance_batched",
                                      "bullet_gjk",
                                      "ccd_gjk",
                                      "ccd_mpr"};

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

/// Poses as the batched test reads them.
template <typename Real>
class FlatPoses {
 public:
  explicit FlatPoses(const Workload& workload)
      : numbers_a_pose_(3 * (static_cast<std::size_t>(workload.size.links) + 1)) {
    for (const Eigen::Matrix3Xd& pose : workload.poses) {
      for (const double x : pose.reshaped()) numbers_.push_back(static_cast<Real>(x));
    }
  }

  std::span<const Real> next() {
    const std::span pose = std::span<const Real>(numbers_).subspan(at_, numbers_a_pose_);
    at_ = at_ + numbers_a_pose_ < numbers_.size() ? at_ + numbers_a_pose_ : 0;
    return pose;
  }

 private:
  std::size_t numbers_a_pose_;
  std::vector<Real> numbers_;
  std::size_t at_ = 0;
};

constexpr Workspace kWorkspace{.reach = 2, .link_length = 1.01 * kLinkLength};

/// The batched test, which answers by a bit a pair.
template <typename Real>
class Batch {
 public:
  /// @param obstacles  those of the workload, over and over
  Batch(const Workload& workload, int obstacles)
      : poses_(workload),
        obstacles_(obstacles, kWorkspace),
        masks_(masks_needed(obstacles_, links(workload))) {
    for (int j = 0; j < obstacles; ++j) {
      obstacles_.set(j,
                     workload.obstacles[static_cast<std::size_t>(j) % workload.obstacles.size()]);
    }
  }

  void make(int passes) {
    for (int i = 0; i < passes; ++i) {
      hit_masks<3, Real>(obstacles_, poses_.next(), masks_);
      bits_ += masks_.back();
    }
  }

  /// Of as many as the workload has.
  double units() const { return double(obstacles_.size()) / kSpeedSize.obstacles; }
  const Real* coefficients() const { return obstacles_.coefficients(); }
  std::size_t numbers() const {
    return static_cast<std::size_t>(obstacles_.blocks()) * ObstacleBatch<3, Real>::kBlockSize;
  }

 private:
  static int links(const Workload& workload) { return workload.size.links; }

  FlatPoses<Real> poses_;
  ObstacleBatch<3, Real> obstacles_;
  std::vector<HitMask> masks_;
  std::uint64_t bits_ = 0;  ///< so that the answers are consumed
};

/// Configurations of an arm of seven links, all of which are free: none is done before all its pairs
/// were asked.
class Configurations {
 public:
  Configurations()
      : check_(arm(), obstacles(), 0),
        configurations_(kSpeedSize.links, kCount),
        free_(configurations_.blocks()) {
    RandomStream random{kSeed};
    for (int i = 0; i < kCount; ++i) {
      JointVector q(kSpeedSize.links);
      for (double& angle : q) angle = random.uniform(-1, 1);
      configurations_.set(i, q);
    }
  }

  void make(int passes) {
    for (int i = 0; i < passes; ++i) {
      check_.certainly_free(configurations_, free_);
      bits_ += free_.back();
    }
  }

  bool all_free() {
    make(1);
    return std::all_of(free_.begin(), free_.end(),
                       [](std::uint16_t block) { return block == 0xffff; });
  }

  static constexpr int kCount = 1024;

 private:
  static SerialChain arm() {
    ChainDescription arm;
    for (int j = 0; j < kSpeedSize.links; ++j) {
      const double turn = (j % 2 == 0 ? 1 : -1) * std::numbers::pi / 2;
      arm.rows.push_back({.a = kLinkLength, .alpha = turn});
    }
    return SerialChain(arm);
  }

  /// Beyond the arm's reach.
  static std::vector<Ellipsoid> obstacles() {
    constexpr double kAway = 1.5 * kSpeedSize.links * kLinkLength;
    RandomStream random{kSeed};
    std::vector<Ellipsoid> shapes;
    shapes.reserve(kSpeedSize.obstacles);
    for (int j = 0; j < kSpeedSize.obstacles; ++j) {
      shapes.emplace_back(kAway * random.direction(3), Eigen::Vector3d(0.1, 0.15, 0.2));
    }
    return shapes;
  }

  ConfigurationCheck check_;
  ConfigurationArray configurations_;
  std::vector<std::uint16_t> free_;
  std::uint64_t bits_ = 0;  ///< so that the answers are consumed
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

  Batch<double> batch(workload, kSpeedSize.obstacles), far(workload, kFarObstacles);
  Batch<float> batch_float(workload, kSpeedSize.obstacles), far_float(workload, kFarObstacles);
  const auto add_batch = [&](const char* name, auto& one) {
    contestants.push_back({name, [&one](int repetitions) { one.make(repetitions); }, one.units()});
  };
  add_batch("batch", batch);
  add_batch("batch_float", batch_float);
  add_batch("batch_far", far);
  add_batch("batch_float_far", far_float);

  Configurations configurations;
  if (!configurations.all_free())
    throw std::runtime_error("configurations: expected all to be free");
  contestants.push_back({"configurations",
                         [&](int repetitions) { configurations.make(repetitions); },
                         Configurations::kCount});

  volatile double sink = 0;
  contestants.push_back({"read_far",
                         [&](int repetitions) {
                           for (int i = 0; i < repetitions; ++i) {
                             sink = read_all(far.coefficients(), far.numbers());
                           }
                         },
                         far.units()});
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
