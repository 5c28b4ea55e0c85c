#include "bqsa/bqsa_projection.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <limits>
#include <map>

#include "bqsa/bqsa_methods.hpp"
#include "support/random_scenes.hpp"

namespace bqsa {
namespace {

using test_support::kDegree;
using test_support::LinkAndObstacle;
using test_support::puma560_ellipsoid;
using test_support::puma560_wall;
using test_support::Replay;
using test_support::replay;
using test_support::sampled_hits;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

using Plane = std::optional<CoordinatePlane>;
const Plane kAuto;
const LinkAndObstacle kForearm{4, 0};

struct Scene {
  const char* name;
  Problem (*make)();
  Plane plane;
  double largest_step;  // [rad]
};
void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; }

class ProjectionPuma : public ::testing::TestWithParam<Scene> {};

TEST_P(ProjectionPuma, IsFreeAtAndBetweenTicks) {
  const Problem problem = GetParam().make();
  BqsaProjection method(GetParam().plane);
  const Replay run = replay(method, problem);
  ASSERT_EQ(run.q.size(), 361U) << name_of(run.last.reason);
  EXPECT_THAT(sampled_hits(problem, run.q, 50), IsEmpty());
  EXPECT_THAT(run.clamped, ElementsAre(kForearm));
  EXPECT_LT(run.tip_error, 1e-8);
  EXPECT_LT(run.largest_step, GetParam().largest_step);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, ProjectionPuma,
    ::testing::Values(Scene{"EllipsoidAuto", puma560_ellipsoid, kAuto, 2 * kDegree},
                      Scene{"EllipsoidZxAsThePaper", puma560_ellipsoid, CoordinatePlane::kZx,
                            2 * kDegree},
                      Scene{"WallAuto", puma560_wall, kAuto, 5 * kDegree},
                      Scene{"WallXy", puma560_wall, CoordinatePlane::kXy, 5 * kDegree}),
    [](const auto& scene) { return std::string(scene.param.name); });

class ForcedPlaneWithoutExit : public ::testing::TestWithParam<Scene> {};

TEST_P(ForcedPlaneWithoutExit, EndsInfeasibleAndHitsNothingUntilThen) {
  const Problem problem = GetParam().make();
  BqsaProjection method(GetParam().plane);
  const Replay run = replay(method, problem);
  EXPECT_EQ(run.last.state, TickState::kInfeasible);
  EXPECT_EQ(run.last.reason, Infeasible::kNoFreeConfiguration);
  EXPECT_EQ(run.last.link, 4);
  EXPECT_EQ(run.last.obstacle, 0);
  EXPECT_EQ(run.last.q, run.q.back());
  EXPECT_GT(run.q.size(), 50U);
  EXPECT_THAT(sampled_hits(problem, run.q, 20), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, ForcedPlaneWithoutExit,
    ::testing::Values(Scene{"EllipsoidXy", puma560_ellipsoid, CoordinatePlane::kXy, 0},
                      Scene{"EllipsoidYz", puma560_ellipsoid, CoordinatePlane::kYz, 0},
                      Scene{"WallYz", puma560_wall, CoordinatePlane::kYz, 0},
                      Scene{"WallZx", puma560_wall, CoordinatePlane::kZx, 0}),
    [](const auto& scene) { return std::string(scene.param.name); });

/// At every clamped tick of a run with `auto`, each plane alone is asked the same question.
TEST(BqsaProjection, AutoTakesThePlaneWithTheSmallestExit) {
  std::map<CoordinatePlane, int> taken;
  int ticks = 0;
  for (const Problem& problem : {puma560_ellipsoid(), puma560_wall()}) {
    BqsaProjection method;
    method.prepare(problem);
    StepInput input;
    StepOutput output;
    input.q = problem.start;
    for (input.tick = 1; input.tick <= problem.ticks; ++input.tick, input.q = output.q) {
      input.t = problem.time(input.tick);
      input.p_WT_desired = problem.desired_tip(input.t);
      method.step(input, output);
      if (output.state != TickState::kClamped) continue;
      ++ticks;
      constexpr int kNoExit = std::numeric_limits<int>::max();
      std::map<CoordinatePlane, int> rounds;  // of the two-sided search
      std::map<CoordinatePlane, JointVector> q;
      for (const CoordinatePlane plane : kCoordinatePlanes) {
        BqsaProjection forced(plane);
        forced.prepare(problem);
        StepOutput alone;
        forced.step(input, alone);
        const bool exit = alone.state == TickState::kClamped;
        rounds[plane] = exit ? (alone.clamps[0].increments + 1) / 2 : kNoExit;
        q[plane] = alone.q;
      }
      int least = kNoExit, matches = 0;
      for (const auto& [plane, count] : rounds) least = std::min(least, count);
      for (const auto& [plane, count] : rounds) {
        if (count != least || q[plane] != output.q) continue;
        ++matches;
        ++taken[plane];
      }
      EXPECT_GT(matches, 0) << problem.name << " tick " << input.tick;
    }
  }
  EXPECT_GT(ticks, 50);
  EXPECT_GT(taken[CoordinatePlane::kXy], 0);
  EXPECT_GT(taken[CoordinatePlane::kZx], 0);
}

/// Single ticks that lead the forearm onto a bead, in both senses of turn. Past the bead lies an exit
/// that is just as near, but no free motion leads there.
TEST(BqsaProjection, TurnsALinkBackToTheSideItCameFrom) {
  Problem problem = puma560_ellipsoid();
  Problem without = problem;
  without.obstacles.clear();
  BqsaSettings settings;
  settings.retries = 0;
  BqsaProjection method(CoordinatePlane::kZx, settings);
  const std::vector<JointVector> nominal = replay(method, without).q;
  std::map<bool, int> ticks;  // by the sense in which the forearm turned
  for (int tick = 20; tick <= 340; tick += 10) {
    const auto link_at = [&](int k) {
      ChainPose pose;
      problem.chain.forward(nominal[static_cast<std::size_t>(k)], pose);
      return pose;
    };
    const ChainPose before = link_at(tick - 1), after = link_at(tick);
    const Eigen::Vector3d was = before.p_WO.col(4) - before.p_WO.col(3);
    const Eigen::Vector3d is = after.p_WO.col(4) - after.p_WO.col(3);
    const double turn = was.cross(is).y() / was.squaredNorm();
    if (std::abs(turn) < 1e-3) continue;
    problem.obstacles = {{"bead", Ellipsoid(after.p_WO.col(4) - 0.1 * is, {1e-4, 1e-4, 1e-4})}};
    method.prepare(problem);
    StepOutput output;
    method.step({.tick = tick,
                 .t = problem.time(tick),
                 .p_WT_desired = problem.desired_tip(problem.time(tick)),
                 .q = nominal[static_cast<std::size_t>(tick - 1)]},
                output);
    EXPECT_EQ(output.state, TickState::kClamped)
        << "tick " << tick << ": " << name_of(output.reason);
    ++ticks[turn > 0];
  }
  EXPECT_GT(ticks[false], 5);
  EXPECT_GT(ticks[true], 5);
}

TEST(BqsaProjection, MovesLinksThatAreFreeInSpace) {
  const Problem problem = puma560_ellipsoid();
  BqsaSpatial exact;
  BqsaProjection projection;
  EXPECT_GT(replay(projection, problem).clamped_ticks, replay(exact, problem).clamped_ticks);
}

TEST(BqsaProjection, KeepsLinkRadiusAndMargin) {
  Problem problem = puma560_ellipsoid();
  problem.link_radius = 0.001;
  problem.margin = 0.001;
  BqsaProjection method;
  const Replay run = replay(method, problem);
  EXPECT_EQ(run.q.size(), 361U) << name_of(run.last.reason);
  EXPECT_THAT(sampled_hits(problem, run.q, 4, 0.002), IsEmpty());
  EXPECT_GT(run.clamped_ticks, 20);
}

/// The upper arm (link 3) of an arm at rest points all but straight up, where a ball comes a little
/// too close to it.
Problem upright_arm() {
  Problem problem{.name = "upright",
                  .chain = SerialChain(test_support::seven_joint_arm()),
                  .ticks = 1,
                  .dt = 1};
  problem.start = JointVector::Zero(7);
  problem.start(1) = 1e-8;
  problem.start(3) = 90 * kDegree;
  problem.start(5) = 30 * kDegree;
  ChainPose pose;
  problem.chain.forward(problem.start, pose);
  problem.desired_tip = [tip = pose.tip()](double) { return tip; };
  const auto ball = [](double x) {
    return Ellipsoid({x, 0, 0.6}, Eigen::Vector3d::Constant(0.03));
  };
  problem.obstacles = {{"ball", ball(0.0301), {ball(0.0301), ball(0.0297)}}};
  return problem;
}

TEST(BqsaProjection, ALinkSeenEndOnHasNoAngleToTurn) {
  const Problem problem = upright_arm();
  BqsaProjection end_on(CoordinatePlane::kXy);
  const Replay refused = replay(end_on, problem);
  EXPECT_EQ(refused.last.reason, Infeasible::kNoFreeConfiguration);
  EXPECT_EQ(refused.last.link, 3);
  EXPECT_EQ(end_on.counters().iterations, 2U) << "both sides must end at once";

  for (const Plane& plane : {Plane(CoordinatePlane::kZx), kAuto}) {
    BqsaProjection turning(plane);
    const Replay turned = replay(turning, problem);
    EXPECT_EQ(turned.last.state, TickState::kClamped) << name_of(turned.last.reason);
    EXPECT_THAT(sampled_hits(problem, turned.q, 20), IsEmpty());
  }
}

TEST(BqsaProjection, ALinkThatCannotMoveEndsTheSearchAtOnce) {
  Problem problem = puma560_ellipsoid();
  problem.obstacles = {{"on the base", Ellipsoid({0.01, 0, 0.3}, {0.05, 0.05, 0.05})}};
  BqsaProjection method;
  const Replay run = replay(method, problem);
  EXPECT_EQ(run.last.reason, Infeasible::kNoFreeConfiguration);
  EXPECT_EQ(run.last.link, 1);
  EXPECT_EQ(method.counters().iterations, 6U) << "three planes, two sides each";
}

TEST(BqsaProjection, EndsATickWhenItsIncrementsAreSpent) {
  BqsaSettings settings;
  settings.max_increments = 2;
  BqsaProjection method(CoordinatePlane::kZx, settings);
  const Replay run = replay(method, puma560_ellipsoid());
  EXPECT_EQ(run.last.reason, Infeasible::kNoFreeConfiguration);
  EXPECT_LT(run.q.size(), 361U);
}

TEST(BqsaProjection, KeepsJointLimitsOrRefuses) {
  Problem problem = puma560_ellipsoid();
  Problem without = problem;
  without.obstacles.clear();
  BqsaProjection method;
  problem.limits.lower = problem.limits.upper = problem.start;
  for (const JointVector& q : replay(method, without).q) {
    problem.limits.lower = problem.limits.lower.cwiseMin(JointVector(q.array() - 0.1));
    problem.limits.upper = problem.limits.upper.cwiseMax(JointVector(q.array() + 0.1));
  }
  bool unlimited_breaks_them = false;
  for (const JointVector& q : replay(method, puma560_ellipsoid()).q) {
    unlimited_breaks_them = unlimited_breaks_them || !problem.within_limits(q);
  }
  EXPECT_TRUE(unlimited_breaks_them);
  const Replay run = replay(method, problem);
  EXPECT_GT(run.clamped_ticks, 0);
  for (const JointVector& q : run.q) EXPECT_TRUE(problem.within_limits(q));
}

/// An ellipsoid that drifts into the forearm of a standing arm and beyond its axis by `depth` [m].
Problem pushed_forearm(double depth) {
  Problem problem = puma560_ellipsoid();
  problem.ticks = 200;
  ChainPose pose;
  problem.chain.forward(problem.start, pose);
  const Eigen::Vector3d middle = 0.5 * (pose.p_WO.col(3) + pose.p_WO.col(4));
  problem.desired_tip = [tip = pose.tip()](double) { return tip; };
  Obstacle& obstacle = problem.obstacles[0];
  const double from = 0.2;
  for (int tick = 0; tick <= problem.ticks; ++tick) {
    const double y = from - (from + depth) * tick / problem.ticks;
    obstacle.motion.emplace_back(middle + Eigen::Vector3d(0, y, 0.02),
                                 Eigen::Vector3d(0.03, 0.05, 0.04));
  }
  obstacle.shape = obstacle.motion.front();
  return problem;
}

TEST(BqsaProjection, EvadesAMovingObstacle) {
  const Problem problem = pushed_forearm(-0.03);
  EXPECT_THAT(sampled_hits(problem, std::vector<JointVector>(201, problem.start), 0),
              ElementsAre(kForearm));
  BqsaProjection method;
  const Replay run = replay(method, problem);
  EXPECT_GT(run.clamped_ticks, 5);
  EXPECT_EQ(run.q.size(), 201U) << name_of(run.last.reason);
  EXPECT_THAT(sampled_hits(problem, run.q, 20), IsEmpty());
  EXPECT_LT(run.tip_error, 1e-8);
}

TEST(BqsaProjection, OnMovingRandomScenesEveryClaimOfFreedomIsTrue) {
  test_support::Generator generator(10);
  int scenes = 0, solved = 0, clamped = 0;
  while (scenes < 40) {
    Problem problem = test_support::random_arm_scene(generator);
    Obstacle& obstacle = problem.obstacles[0];
    const Eigen::Vector3d velocity = test_support::random_vector<3>(generator, 0.005);
    const Eigen::Vector3d axis = test_support::random_direction<3>(generator);
    for (int tick = 0; tick <= problem.ticks; ++tick) {
      const Eigen::AngleAxisd turn(0.02 * tick, axis);
      obstacle.motion.emplace_back(obstacle.shape.center() + (tick - 80) * velocity,
                                   obstacle.shape.semi_axes(), turn * obstacle.shape.rotation());
    }
    obstacle.shape = obstacle.motion.front();
    if (!sampled_hits(problem, {problem.start}, 0).empty()) continue;
    ++scenes;
    BqsaProjection method;
    const Replay run = replay(method, problem);
    // Nothing is claimed for the time after the last row.
    std::vector<Ellipsoid>& motion = problem.obstacles[0].motion;
    motion.erase(motion.begin() + static_cast<std::ptrdiff_t>(run.q.size()), motion.end());
    EXPECT_THAT(sampled_hits(problem, run.q, 20), IsEmpty()) << "scene " << scenes;
    EXPECT_LT(run.tip_error, 1e-8) << "scene " << scenes;
    solved += run.last.state != TickState::kInfeasible;
    clamped += run.clamped_ticks > 0;
  }
  std::printf("solved of 40 with moving obstacles: bqsa_projection auto %d\n", solved);
  EXPECT_GE(solved, 20);
  EXPECT_GT(clamped, 30);
}

struct Tally {
  int solved = 0;
  int infeasible = 0;
};

Tally run_on_random_scenes(const std::function<std::unique_ptr<ReactiveMethod>()>& make) {
  test_support::Generator generator(9);
  Tally tally;
  for (int scene = 0; scene < 60; ++scene) {
    const Problem problem = test_support::random_arm_scene(generator);
    const auto method = make();
    const Replay run = replay(*method, problem);
    EXPECT_THAT(sampled_hits(problem, run.q, 20), IsEmpty()) << "scene " << scene;
    EXPECT_LT(run.tip_error, 1e-8) << "scene " << scene;
    EXPECT_LE(run.largest_step, kDefaultMaxStep) << "scene " << scene;
    if (run.last.state != TickState::kInfeasible) {
      ++tally.solved;
      EXPECT_GT(run.clamped_ticks, 0) << "scene " << scene;
    } else {
      ++tally.infeasible;
      EXPECT_NE(run.last.reason, Infeasible::kNot);
      EXPECT_EQ(run.last.q, run.q.back()) << "an infeasible tick must hold the last configuration";
    }
  }
  return tally;
}

/// Prints how many of the scenes each variant solves.
TEST(BqsaProjection, OnRandomScenesEveryClaimOfFreedomIsTrue) {
  const auto projection = [](Plane plane) {
    return [plane] { return std::make_unique<BqsaProjection>(plane); };
  };
  const Tally exact = run_on_random_scenes([] { return std::make_unique<BqsaSpatial>(); });
  const Tally automatic = run_on_random_scenes(projection(kAuto));
  const Tally xy = run_on_random_scenes(projection(CoordinatePlane::kXy));
  const Tally yz = run_on_random_scenes(projection(CoordinatePlane::kYz));
  const Tally zx = run_on_random_scenes(projection(CoordinatePlane::kZx));
  std::printf("solved of 60: bqsa %d, bqsa_projection auto %d, xy %d, yz %d, zx %d\n", exact.solved,
              automatic.solved, xy.solved, yz.solved, zx.solved);
  EXPECT_GE(exact.solved, 45);
  EXPECT_GE(automatic.solved, 45);
  for (const Tally& one_plane : {xy, yz, zx}) {
    EXPECT_GE(one_plane.solved, 20);
    EXPECT_LT(one_plane.solved, automatic.solved);
  }
}

/// Freeing one link must not leave another too close, however many obstacles there are.
TEST(BqsaProjection, LeavesEveryLinkAtTheSafetyOffset) {
  test_support::Generator generator(11);
  int rows = 0, clamped = 0;
  for (int scene = 0; scene < 40; ++scene) {
    const Problem problem = test_support::crowded_arm_scene(generator);
    WorkCounters counters;
    ShadowField shadows;
    shadows.assign(problem.obstacles, counters);
    shadows.keep(BqsaSettings{}.safety_offset);
    BqsaProjection method;
    const Replay run = replay(method, problem);
    ChainPose pose;
    for (std::size_t tick = 1; tick < run.q.size(); ++tick, ++rows) {
      problem.chain.forward(run.q[tick], pose);
      for (const Link& link : problem.chain.links()) {
        EXPECT_EQ(shadows.first_hit(pose, link), -1) << "scene " << scene << " tick " << tick;
      }
    }
    EXPECT_THAT(sampled_hits(problem, run.q, 4), IsEmpty()) << "scene " << scene;
    clamped += run.clamped_ticks;
  }
  EXPECT_GT(rows, 1000);
  EXPECT_GT(clamped, 300);
}

TEST(BqsaProjection, ThePlaneIsAParameterOfTheMethod) {
  const MethodEntry entry = bqsa_projection_method();
  const Problem problem = puma560_ellipsoid();
  EXPECT_EQ(why_not_applicable(entry.capabilities, problem), "");
  EXPECT_NE(why_not_applicable(entry.capabilities, test_support::planar_7r()), "");
  std::vector<std::vector<JointVector>> all;
  for (const auto& [name, plane] : {std::pair{"auto", kAuto},
                                    {"xy", CoordinatePlane::kXy},
                                    {"yz", CoordinatePlane::kYz},
                                    {"zx", CoordinatePlane::kZx}}) {
    ParameterValues values(entry.parameters);
    if (plane) values.set("plane", name);
    const std::unique_ptr<Method> made = entry.make(values);
    BqsaProjection direct(plane);
    const Replay run = replay(dynamic_cast<ReactiveMethod&>(*made), problem);
    EXPECT_EQ(run.q, replay(direct, problem).q) << name;
    EXPECT_EQ(std::count(all.begin(), all.end(), run.q), 0) << name << " changes nothing";
    all.push_back(run.q);
  }
}

TEST(BqsaProjection, RefusesPlanarProblems) {
  BqsaProjection method;
  EXPECT_THROW(method.prepare(test_support::planar_7r()), std::invalid_argument);
}

}  // namespace
}  // namespace bqsa
