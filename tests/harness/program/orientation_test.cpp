// Tasks with an orientation: every method that takes them follows position and orientation, judged by the
// judge's own kinematics; those that avoid obstacles do so and keep the pose.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "harness/judge/judge.hpp"
#include "harness/method_spec.hpp"
#include "harness/methods.hpp"
#include "harness/scenario/scenario.hpp"
#include "support/allocation_guard.hpp"
#include "support/replay.hpp"

namespace bqsa {

void PrintTo(const MethodEntry& entry, std::ostream* out) { *out << entry.name; }

}  // namespace bqsa

namespace bqsa::harness {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;

Problem iiwa(const std::string& name) {
  return load_scenario(BQSA_SOURCE_DIR "/tests/harness/program/" + name + ".yaml").problem;
}

std::vector<MethodEntry> methods_with_orientation() {
  std::vector<MethodEntry> list;
  for (const MethodEntry& entry : methods()) {
    if (entry.capabilities.orientation) list.push_back(entry);
  }
  return list;
}

std::unique_ptr<ReactiveMethod> made(const MethodEntry& entry) {
  return std::unique_ptr<ReactiveMethod>(
      static_cast<ReactiveMethod*>(entry.make(ParameterValues(entry.parameters)).release()));
}

struct JudgedRun {
  Judgement judgement;
  test_support::Replay replay;
};

JudgedRun run(const MethodEntry& entry, const Problem& problem) {
  JudgedRun run;
  run.replay = test_support::replay(*made(entry), problem);
  Trajectory trajectory;
  for (std::size_t k = 0; k < run.replay.q.size(); ++k) {
    trajectory.t.push_back(problem.time(static_cast<int>(k)));
    trajectory.q.push_back(run.replay.q[k]);
  }
  run.judgement = Judge(problem).judge(trajectory);
  return run;
}

/// Whether a method closes the tip error within the tick; the others lag behind by a second-order error.
bool corrects(const MethodEntry& entry) { return entry.name.starts_with("bqsa"); }

class OrientationOf : public ::testing::TestWithParam<MethodEntry> {};

/// A straight line with a constant orientation, or one that turns on the way, nothing in the way.
TEST_P(OrientationOf, IsFollowed) {
  for (const char* name : {"iiwa_pose", "iiwa_axis"}) {
    Problem problem = iiwa(name);
    problem.obstacles.clear();
    const Judgement judgement = run(GetParam(), problem).judgement;
    EXPECT_TRUE(judgement.success()) << name;
    EXPECT_LT(judgement.at_ticks.max, corrects(GetParam()) ? 1.1e-9 : 5e-4) << name;
    EXPECT_LT(judgement.orientation_at_ticks.max, corrects(GetParam()) ? 1e-8 : 2e-3) << name;
  }
}

/// An arm without redundancy: the pose determines all joints.
TEST_P(OrientationOf, IsFollowedBySixJoints) {
  Problem problem = iiwa("iiwa_pose");
  problem.obstacles.clear();
  ChainDescription arm;
  arm.convention = DhConvention::kModified;
  arm.rows = {{.d = 0.36},
              {.alpha = -90 * kDegree, .offset = -90 * kDegree},
              {.a = 0.42, .offset = -90 * kDegree},
              {.alpha = -90 * kDegree, .d = 0.4},
              {.alpha = 90 * kDegree},
              {.alpha = -90 * kDegree}};
  arm.p_LT << 0, 0, 0.126;
  problem.chain = SerialChain(arm);
  problem.limits = {};
  problem.start.resize(6);
  problem.start << 0, 35 * kDegree, 80 * kDegree, 0, 65 * kDegree, 0;
  ChainPose pose;
  problem.chain.forward(problem.start, pose);
  const Vector3d from = pose.tip();
  const Matrix3d R = problem.chain.tip_rotation(pose);
  problem.desired_tip = [from, T = problem.duration()](double t) {
    return Vector3d(from + t / T * Vector3d(-0.05, 0.2, 0.05));
  };
  problem.desired_rotation = [R, T = problem.duration()](double t) {
    return Matrix3d(Eigen::AngleAxisd(0.2 * t / T, Vector3d(0.6, 0, 0.8)) * R);
  };
  const Judgement judgement = run(GetParam(), problem).judgement;
  EXPECT_TRUE(judgement.success());
  EXPECT_EQ(judgement.rows, problem.ticks + 1);
}

/// Loops that go on for many ticks do not take memory.
TEST_P(OrientationOf, DoesNotAllocate) {
  if (!test_support::kCountsAllocations || GetParam().name.starts_with("fcl")) return;
  if (GetParam().name == "bqsa_lookahead") return;  // plans
  for (const char* name : {"iiwa_pose", "iiwa_axis"}) {
    const Problem problem = iiwa(name);
    const auto method = made(GetParam());
    method->prepare(problem);
    StepInput input{.q = problem.start};
    StepOutput output;
    std::uint64_t allocations = 0;
    for (input.tick = 1; input.tick <= problem.ticks; ++input.tick) {
      input.t = problem.time(input.tick);
      input.p_WT_desired = problem.desired_tip(input.t);
      input.R_WT_desired = problem.rotation_at(input.t);
      const test_support::AllocationGuard guard;
      method->step(input, output);
      if (input.tick > 1) allocations += guard.allocations();
      if (output.state == TickState::kInfeasible) break;
      input.q = output.q;
    }
    EXPECT_EQ(allocations, 0U) << name;
  }
}

/// What a method is told of the position alone does not keep the orientation, and the judge sees it.
TEST_P(OrientationOf, IsLostWithoutTheTask) {
  Problem problem = iiwa("iiwa_pose");
  problem.obstacles.clear();
  Problem position = problem;
  position.task_kind = TaskKind::kPosition;
  const test_support::Replay replay = test_support::replay(*made(GetParam()), position);
  Trajectory trajectory;
  for (std::size_t k = 0; k < replay.q.size(); ++k) {
    trajectory.t.push_back(problem.time(static_cast<int>(k)));
    trajectory.q.push_back(replay.q[k]);
  }
  const Judgement judgement = Judge(problem).judge(trajectory);
  EXPECT_THAT(judgement.failures, ::testing::ElementsAre(Failure::kOrientation));
  EXPECT_GT(judgement.orientation_at_ticks.max, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Methods, OrientationOf, ::testing::ValuesIn(methods_with_orientation()),
                         [](const auto& tested) { return tested.param.name; });

TEST(Orientation, IsTakenByTheMethodsThatAskForTheRowsOfTheTask) {
  std::vector<std::string> names;
  for (const MethodEntry& entry : methods_with_orientation()) names.push_back(entry.name);
  EXPECT_THAT(names, ::testing::IsSupersetOf(
                         {"none", "bqsa", "bqsa_projection", "maciejewski_klein", "fcl_gp", "qp"}));
}

/// One degree of redundancy is left, the elbow's: it swings aside while the tool stays as it is.
TEST(Orientation, TheElbowAvoidsWhileThePoseIsKept) {
  for (const char* name : {"iiwa_pose", "iiwa_axis"}) {
    const Problem problem = iiwa(name);
    const auto entry = [](const char* method) {
      return parse_method_spec(method, methods()).entry;
    };
    const Judgement plain = run(entry("none"), problem).judgement;
    EXPECT_THAT(plain.failures, ::testing::ElementsAre(Failure::kCollision)) << name;
    const JudgedRun bqsa = run(entry("bqsa"), problem);
    EXPECT_TRUE(bqsa.judgement.success()) << name;
    EXPECT_GT(bqsa.replay.clamped_ticks, 10) << name;
    EXPECT_LT(bqsa.judgement.at_ticks.max, 1.1e-9) << name;
    EXPECT_LT(bqsa.judgement.orientation_at_ticks.max, 1e-8) << name;
  }
}

}  // namespace

}  // namespace bqsa::harness
