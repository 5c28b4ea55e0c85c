// Times of kernels and control steps of src/bqsa alone [s], as JSON, for the comparison of builds.
//   speed_of_build SEED

#include <fmt/format.h>

#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "bqsa/batch/batched_test.hpp"
#include "bqsa/bqsa_methods.hpp"
#include "bqsa/geometry/nearest_plane.hpp"
#include "bqsa/geometry/segment_test.hpp"
#include "harness/generator/random_stream.hpp"
#include "harness/measuring/contest.hpp"

namespace bqsa {
namespace {

using harness::RandomStream;

constexpr std::uint64_t kSceneSeed = 1;
constexpr int kPeriod = 100;  // ticks

/// Seven links among 64 obstacles, at random.
struct Pairs {
  static constexpr int kLinks = 7, kObstacles = 64;

  Pairs() {
    RandomStream random{kSceneSeed};
    for (int j = 0; j < kObstacles; ++j) {
      const Eigen::Vector3d center = random.uniform(0, 1) * random.direction(3);
      Eigen::Vector3d semi_axes;
      for (double& axis : semi_axes) axis = random.uniform(0.05, 0.25);
      const Eigen::Vector4d q = random.quaternion();
      shapes.emplace_back(center, semi_axes,
                          Eigen::Quaterniond(q(0), q(1), q(2), q(3)).toRotationMatrix());
    }
    for (int k = 0; k <= kLinks; ++k) {
      points.emplace_back(random.uniform(0, 1) * random.direction(3));
      for (const double x : points.back()) {
        doubles.push_back(x);
        floats.push_back(static_cast<float>(x));
      }
    }
  }

  std::vector<Ellipsoid> shapes;
  std::vector<Eigen::Vector3d> points;
  std::vector<double> doubles;  ///< the points, one coordinate after another
  std::vector<float> floats;
};

/// An arm whose tip goes to and fro, among obstacles that it never comes near.
class Loop {
 public:
  Loop(const ChainDescription& arm, const JointVector& start, const Eigen::Vector3d& there,
       int obstacles)
      : problem_{.name = "loop", .chain = SerialChain(arm)} {
    constexpr double kTick = 0.02;  // [s]
    ChainPose pose;
    problem_.chain.forward(start, pose);
    for (int tick = 0; tick < kPeriod; ++tick) {
      const double turn = 2 * std::numbers::pi * tick / kPeriod;
      desired_.emplace_back(pose.tip() + (1 - std::cos(turn)) / 2 * there);
    }
    problem_.desired_tip = [this](double t) {
      return desired_[static_cast<std::size_t>(std::lround(t / kTick)) % kPeriod];
    };
    problem_.ticks = 1'000'000'000;
    problem_.dt = kTick;
    problem_.start = start;
    add_obstacles(pose, obstacles);
    const MethodEntry entry = bqsa_method();
    method_ = entry.make(ParameterValues(entry.parameters));
    step_ = dynamic_cast<ReactiveMethod*>(method_.get());
    step_->prepare(problem_);
    input_.q = start;
  }

  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      ++input_.tick;
      input_.t = input_.tick * problem_.dt;
      input_.p_WT_desired = desired_[static_cast<std::size_t>(input_.tick % kPeriod)];
      step_->step(input_, output_);
      input_.q = output_.q;
    }
  }

 private:
  /// Balls, far enough from the start that the small motion does not reach them.
  void add_obstacles(const ChainPose& pose, int count) {
    constexpr double kRadius = 0.1, kAway = 0.5, kFarthest = 1.5;  // [m]
    RandomStream random{kSceneSeed};
    while (static_cast<int>(problem_.obstacles.size()) < count) {
      const Link& link = problem_.chain.links()[static_cast<std::size_t>(
          random.whole(0, static_cast<int>(problem_.chain.links().size()) - 1))];
      const Eigen::Vector3d center =
          pose.p_WO.col(link.end) +
          random.uniform(kAway, kFarthest) * random.direction(problem_.dimension());
      const Ellipsoid ball(center, Eigen::Vector3d::Constant(kRadius));
      bool clear = true;
      for (const Link& each : problem_.chain.links()) {
        const Eigen::Vector3d a = pose.p_WO.col(each.start), b = pose.p_WO.col(each.end);
        clear = clear && nearest_plane<3>(ball, a, b).distance > kAway - kRadius;
      }
      if (clear) problem_.obstacles.push_back({"ball", ball});
    }
  }

  Problem problem_;
  std::vector<Eigen::Vector3d> desired_;  ///< of a period, from tick 0 on [m]
  std::unique_ptr<Method> method_;
  ReactiveMethod* step_;
  StepInput input_;
  StepOutput output_;
};

JointVector angles(std::initializer_list<double> list) {
  JointVector q(static_cast<Eigen::Index>(list.size()));
  std::copy(list.begin(), list.end(), q.begin());
  return q;
}

std::unique_ptr<Loop> planar_loop(int obstacles) {
  return std::make_unique<Loop>(planar_chain(std::vector<double>(7, 0.4)),
                                angles({1.2, -0.4, -0.4, -0.4, -0.4, -0.4, -0.4}),
                                Eigen::Vector3d(-0.15, 0.15, 0), obstacles);
}

/// The PUMA 560 of the paper's section 4.2.
std::unique_ptr<Loop> spatial_loop(int obstacles) {
  constexpr double kRight = std::numbers::pi / 2;
  ChainDescription arm;
  arm.rows = {{0, kRight, 0.67183, 0}, {0.4318, 0, 0, 0},  {0.02032, -kRight, 0, -kRight},
              {0, kRight, 0.43307, 0}, {0, -kRight, 0, 0}, {0, 0, 0.05625, 0}};
  return std::make_unique<Loop>(arm, angles({0.2, -1.0, 1.6, 0.1, 0.9, 0}),
                                Eigen::Vector3d(-0.05, 0.15, -0.05), obstacles);
}

void print_times(std::uint64_t seed) {
  using harness::Contestant;
  const Pairs pairs;
  const Workspace workspace{.reach = 2, .link_length = 2};
  const ObstacleBatch<3, double> doubles(pairs.shapes, workspace);
  const ObstacleBatch<3, float> floats(pairs.shapes, workspace);
  std::vector<HitMask> masks(masks_needed(doubles, Pairs::kLinks));
  std::uint64_t sum = 0;  // so that the answers are consumed
  std::vector<Contestant> contestants = {
      {"kernel_batch",
       [&](int passes) {
         for (int i = 0; i < passes; ++i) {
           hit_masks<3, double>(doubles, pairs.doubles, masks);
           sum += masks.back();
         }
       }},
      {"kernel_batch_float",
       [&](int passes) {
         for (int i = 0; i < passes; ++i) {
           hit_masks<3, float>(floats, pairs.floats, masks);
           sum += masks.back();
         }
       }},
      {"kernel_single", [&](int passes) {
         for (int i = 0; i < passes; ++i) {
           for (const Ellipsoid& shape : pairs.shapes) {
             for (std::size_t k = 1; k < pairs.points.size(); ++k) {
               sum += hits(polar_form<3>(shape, pairs.points[k - 1], pairs.points[k]));
             }
           }
         }
       }}};
  std::vector<std::unique_ptr<Loop>> loops;
  const auto add = [&](const char* name, std::unique_ptr<Loop> loop) {
    Loop& kept = *loops.emplace_back(std::move(loop));
    contestants.push_back({name, [&kept](int ticks) { kept.run(ticks); }});
  };
  constexpr int kFew = 8, kMany = 64;
  add("step_planar_8", planar_loop(kFew));
  add("step_planar_64", planar_loop(kMany));
  add("step_spatial_8", spatial_loop(kFew));
  add("step_spatial_64", spatial_loop(kMany));

  const std::vector<double> seconds = harness::typical_seconds(harness::run_contest(
      contestants, {.rounds = 60, .block_s = 2e-4, .budget_s = 0.05, .seed = seed}));
  std::string text;
  for (std::size_t i = 0; i < contestants.size(); ++i) {
    text += fmt::format("{}\"{}\": {}", text.empty() ? "" : ", ", contestants[i].name, seconds[i]);
  }
  volatile std::uint64_t consumed = sum;
  static_cast<void>(consumed);
  fmt::print("{{{}}}\n", text);
}

}  // namespace
}  // namespace bqsa

int main(int argc, char** argv) {
  bqsa::print_times(argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1);
  return EXIT_SUCCESS;
}
