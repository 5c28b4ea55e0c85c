#include "bqsa/bqsa_spatial.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "bqsa/geometry/separation.hpp"
#include "support/paper_problems.hpp"
#include "support/replay.hpp"

namespace bqsa {
namespace {

using test_support::kDegree;
using test_support::LinkAndObstacle;
using test_support::Replay;
using test_support::replay;
using test_support::sampled_hits;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

const LinkAndObstacle kForearm{4, 0};

struct Scene {
  const char* name;
  Problem (*make)();
  double largest_step;  // [rad]
};
void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; }

class PumaScene : public ::testing::TestWithParam<Scene> {};

TEST_P(PumaScene, IsFreeAtAndBetweenTicks) {
  const Problem problem = GetParam().make();
  BqsaSpatial method;
  const Replay run = replay(method, problem);
  ASSERT_EQ(run.q.size(), 361U) << name_of(run.last.reason);
  EXPECT_THAT(sampled_hits(problem, run.q, 50), IsEmpty());
  EXPECT_THAT(run.clamped, ElementsAre(kForearm));
  EXPECT_LT(run.tip_error, 1e-8);
  EXPECT_LT(run.largest_step, GetParam().largest_step);
  EXPECT_LE(run.most_increments, 6) << "ways out are estimated, not searched for in increments";
}

/// The link keeps what the halvings of an increment would leave it, and no more.
TEST_P(PumaScene, LeavesTheLinkAtTheExit) {
  const Problem problem = GetParam().make();
  BqsaSettings settings;
  settings.retries = 0;
  settings.release = Release::kNever;
  const Link& forearm = *std::ranges::find(problem.chain.links(), kForearm.first, &Link::number);
  double beyond = 0;  // the way of the link's end where each joint turns by the resolution
  for (int j = 0; j < problem.chain.joints(); ++j) {
    beyond +=
        std::ldexp(settings.increment, -settings.settling) * problem.chain.reach(j, forearm.end);
  }
  BqsaSpatial method(settings);
  method.prepare(problem);
  StepInput input;
  StepOutput output;
  ChainPose pose;
  input.q = problem.start;
  int cleared = 0;
  for (input.tick = 1; input.tick <= problem.ticks; ++input.tick) {
    input.t = problem.time(input.tick);
    input.p_WT_desired = problem.desired_tip(input.t);
    method.step(input, output);
    if (output.state == TickState::kInfeasible) break;
    input.q = output.q;
    if (output.clamp_count == 0) continue;
    ++cleared;
    problem.chain.forward(output.q, pose);
    const double kept = separation<3>(problem.obstacles[0].shape, pose.p_WO.col(forearm.start),
                                      pose.p_WO.col(forearm.end));
    EXPECT_GT(kept, settings.safety_offset) << input.tick;
    EXPECT_LT(kept, settings.safety_offset + beyond) << input.tick;
  }
  EXPECT_GT(cleared, 30);
}

INSTANTIATE_TEST_SUITE_P(Scenes, PumaScene,
                         ::testing::Values(Scene{"ellipsoid", test_support::puma560_ellipsoid,
                                                 2 * kDegree},
                                           Scene{"wall", test_support::puma560_wall, 5 * kDegree}),
                         [](const auto& scene) { return std::string(scene.param.name); });

TEST(BqsaSpatial, PlainTrackingWouldHitTheForearm) {
  for (const Problem& problem : {test_support::puma560_ellipsoid(), test_support::puma560_wall()}) {
    Problem without = problem;
    without.obstacles.clear();
    BqsaSpatial method;
    const Replay run = replay(method, without);
    EXPECT_THAT(sampled_hits(problem, run.q, 0), ElementsAre(kForearm));
  }
}

TEST(BqsaSpatial, RefusesTheWallThatNoPosturePasses) {
  Problem problem = test_support::puma560_wall();
  problem.obstacles = {{"wall", Ellipsoid({0.547, 0, 0.634}, {1e-4, 0.1, 10})}};
  BqsaSpatial method;
  const Replay run = replay(method, problem);
  EXPECT_EQ(run.last.state, TickState::kInfeasible);
  EXPECT_EQ(run.last.q, run.q.back());
}

TEST(BqsaSpatial, KeepsLinkRadiusAndMargin) {
  Problem problem = test_support::puma560_ellipsoid();
  problem.link_radius = 0.001;
  problem.margin = 0.001;
  BqsaSpatial method;
  const Replay run = replay(method, problem);
  EXPECT_EQ(run.q.size(), 361U) << name_of(run.last.reason);
  EXPECT_THAT(sampled_hits(problem, run.q, 4, 0.002), IsEmpty());
}

TEST(BqsaSpatial, HoldsTheArmWhereThePathLeavesItsReach) {
  Problem problem = test_support::puma560_ellipsoid();
  problem.desired_tip = [](double t) -> Eigen::Vector3d { return {0.6442 + 0.2 * t, 0, 0.53297}; };
  BqsaSpatial method;
  const Replay run = replay(method, problem);
  EXPECT_EQ(run.last.state, TickState::kInfeasible);
  EXPECT_LT(run.tip_error, problem.tolerance);
}

}  // namespace
}  // namespace bqsa
