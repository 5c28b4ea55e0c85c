#include "bqsa/bqsa_lookahead.hpp"

#include <gtest/gtest.h>

#include "bqsa/bqsa_planar.hpp"
#include "support/random_scenes.hpp"
#include "support/replay.hpp"
#include "support/warm_run.hpp"

namespace bqsa {
namespace {

using test_support::Generator;
using test_support::kDegree;
using test_support::planar_7r;
using test_support::Replay;
using test_support::replay;
using test_support::sampled_hits;
using test_support::uniform;

bool solved(const Replay& run, const Problem& problem) {
  return run.q.size() == static_cast<std::size_t>(problem.ticks + 1);
}

/// That every motion of the run is free, allowed and on the path, by dense sampling.
void expect_true(const Replay& run, const Problem& problem) {
  Problem so_far = problem;
  for (Obstacle& obstacle : so_far.obstacles) {
    if (obstacle.moves()) obstacle.motion.resize(run.q.size(), obstacle.shape);
  }
  EXPECT_TRUE(sampled_hits(so_far, run.q, 12, problem.link_radius + problem.margin).empty());
  EXPECT_LT(run.tip_error, 1e-8);
  for (std::size_t k = 1; k < run.q.size(); ++k) {
    ASSERT_EQ(forbidden_step(problem, run.q[k - 1], run.q[k]), Infeasible::kNot) << "tick " << k;
  }
  if (!solved(run, problem)) {
    EXPECT_EQ(run.last.state, TickState::kInfeasible);
    EXPECT_NE(run.last.reason, Infeasible::kNot);
    EXPECT_EQ(run.last.q, run.q.back());
  }
}

/// A planar arm whose joints make 45 deg/s on a straight path, with obstacles put on links where
/// plain tracking leads them; `thinnest` [m] is their smallest semi-axis, every second one moves.
Problem slow_arm_scene(Generator& generator, int obstacles, double thinnest) {
  for (;;) {
    Problem problem = planar_7r(150);
    problem.obstacles.clear();
    problem.limits.max_velocity = JointVector::Constant(7, 45 * kDegree);
    problem.start = JointVector::NullaryExpr(
        7, [&](Eigen::Index i) { return uniform(generator, i == 0 ? -1.5 : -0.8, 0.8); });
    ChainPose pose;
    problem.chain.forward(problem.start, pose);
    const Eigen::Vector3d from = pose.tip();
    const Eigen::Vector3d to = 0.6 * from + Eigen::Vector3d(uniform(generator, -0.6, 0.6),
                                                            uniform(generator, -0.6, 0.6), 0);
    problem.desired_tip = [from, to](double t) -> Eigen::Vector3d {
      return from + t / 10 * (to - from);
    };
    BqsaPlanar tracking(PlanarVariant::kExact);
    const Replay nominal = replay(tracking, problem);
    if (!solved(nominal, problem)) continue;
    for (int k = 0; k < obstacles; ++k) {
      problem.chain.forward(nominal.q[static_cast<std::size_t>(60 + 20 * k)], pose);
      const int link = static_cast<int>(uniform(generator, 3, 7.999));
      const Eigen::Vector2d on_link =
          pose.p_WO.col(link - 1).head<2>() +
          uniform(generator, 0.1, 0.9) * (pose.p_WO.col(link) - pose.p_WO.col(link - 1)).head<2>();
      const Eigen::Vector2d semi_axes(uniform(generator, 0.03, 0.12),
                                      uniform(generator, thinnest, 0.08));
      const double angle = uniform(generator, 0, 3);
      Obstacle obstacle{"obstacle", embedded(rotated_ellipse(on_link, semi_axes, angle))};
      if (k % 2 == 1) {
        const Eigen::Vector2d way = test_support::random_vector<2>(generator, 0.004);
        for (int tick = 0; tick <= problem.ticks; ++tick) {
          obstacle.motion.push_back(embedded(rotated_ellipse(on_link + (tick - 75) * way, semi_axes,
                                                             angle + 0.005 * (tick - 75))));
        }
        obstacle.shape = obstacle.motion[0];
      }
      problem.obstacles.push_back(obstacle);
    }
    bool tip_clear = true;
    for (int tick = 0; tick <= problem.ticks; ++tick) {
      for (const Obstacle& obstacle : problem.obstacles) {
        tip_clear =
            tip_clear && obstacle.at(tick).level(problem.desired_tip(problem.time(tick))) > 0.3;
      }
    }
    if (tip_clear && sampled_hits(problem, {problem.start}, 0).empty()) return problem;
  }
}

TEST(BqsaLookahead, OnRandomPlanarScenesItsClaimsAreTrueAndItSolvesMoreThanReacting) {
  Generator generator(70);
  int reacting = 0, looking = 0, spread = 0;
  for (int scene = 0; scene < 40; ++scene) {
    SCOPED_TRACE(scene);
    Problem problem = slow_arm_scene(generator, 1 + scene % 3, scene % 4 == 0 ? 1e-4 : 0.03);
    if (scene % 5 == 1) {
      problem.link_radius = 0.003;
      problem.margin = 0.002;
      if (!sampled_hits(problem, {problem.start}, 0, 0.006).empty()) problem.margin = 0;
      if (!sampled_hits(problem, {problem.start}, 0, 0.006).empty()) problem.link_radius = 0;
    }
    BqsaPlanar reactive(PlanarVariant::kExact);
    reacting += solved(replay(reactive, problem), problem);
    BqsaLookahead method;
    const Replay run = replay(method, problem);
    expect_true(run, problem);
    looking += solved(run, problem);
    for (std::size_t k = 1; k < run.q.size(); ++k) {
      spread += (run.q[k] - run.q[k - 1]).cwiseAbs().maxCoeff() > 0.999 * problem.max_step(0);
    }
  }
  RecordProperty("reacting", reacting);
  RecordProperty("looking", looking);
  RecordProperty("steps_at_the_limit", spread);
  EXPECT_GE(looking, reacting + 2);
  EXPECT_GT(spread, 50);
}

TEST(BqsaLookahead, OnRandomSpatialScenesItsClaimsAreTrue) {
  Generator generator(71);
  int looking = 0, reacting = 0;
  for (int scene = 0; scene < 20; ++scene) {
    SCOPED_TRACE(scene);
    Problem problem = scene % 2 == 0 ? test_support::random_arm_scene(generator)
                                     : test_support::crowded_arm_scene(generator);
    problem.limits.max_velocity = JointVector::Constant(7, 60 * kDegree);
    BqsaSpatial reactive;
    reacting += solved(replay(reactive, problem), problem);
    BqsaLookahead method;
    const Replay run = replay(method, problem);
    expect_true(run, problem);
    looking += solved(run, problem);
  }
  RecordProperty("reacting", reacting);
  RecordProperty("looking", looking);
  EXPECT_GE(looking, reacting);
  EXPECT_GT(looking, 8);
}

/// The paper's arm holds its tip still. A ball comes faster than its joints can turn, against the
/// middle of link 4, and stays there.
Problem ball_scene() {
  Problem problem = planar_7r(400);
  problem.ticks = 80;
  problem.limits.max_velocity = JointVector::Constant(7, 20 * kDegree);
  ChainPose pose;
  problem.chain.forward(problem.start, pose);
  problem.desired_tip = [tip = pose.tip()](double) { return tip; };
  const Eigen::Vector2d middle = 0.5 * (pose.p_WO.col(3) + pose.p_WO.col(4)).head<2>();
  const Eigen::Vector2d along = (pose.p_WO.col(4) - pose.p_WO.col(3)).head<2>().normalized();
  const Eigen::Vector2d across(-along.y(), along.x());
  Obstacle ball{"ball", embedded(rotated_ellipse(middle + 0.9 * across, {0.05, 0.05}, 0))};
  for (int tick = 0; tick <= problem.ticks; ++tick) {
    const double distance = std::clamp(0.9 - 0.03 * (tick - 25), 0.0, 0.9);
    ball.motion.push_back(embedded(rotated_ellipse(middle + distance * across, {0.05, 0.05}, 0)));
  }
  problem.obstacles = {ball};
  return problem;
}

TEST(BqsaLookahead, StartsBeforeContactWhereReactingIsTooLate) {
  const Problem problem = ball_scene();
  BqsaPlanar reactive(PlanarVariant::kExact);
  const Replay late = replay(reactive, problem);
  EXPECT_EQ(late.last.reason, Infeasible::kNoFreeConfiguration);

  BqsaLookahead method;
  const Replay run = replay(method, problem);
  expect_true(run, problem);
  ASSERT_TRUE(solved(run, problem)) << name_of(run.last.reason);
  const auto contact = static_cast<int>(late.q.size());
  int first_moved = 0, at_the_limit = 0;
  for (int tick = 1; tick <= problem.ticks; ++tick) {
    const auto k = static_cast<std::size_t>(tick);
    const double step = (run.q[k] - run.q[k - 1]).cwiseAbs().maxCoeff();
    if (first_moved == 0 && step > 1e-6) first_moved = tick;
    at_the_limit += step > 0.999 * problem.max_step(0);
  }
  EXPECT_GT(first_moved, 0);
  EXPECT_LT(first_moved, contact - 5);
  EXPECT_GT(at_the_limit, 5) << "the self-motion is not spread";
}

TEST(BqsaLookahead, LooksNoFurtherThanItsHorizon) {
  const Problem problem = ball_scene();
  LookaheadSettings near;
  near.horizon = 3;
  BqsaLookahead short_sighted(near);
  const Replay run = replay(short_sighted, problem);
  expect_true(run, problem);
  EXPECT_FALSE(solved(run, problem));
  EXPECT_GT(run.q.size(), 20U);
}

TEST(BqsaLookahead, OneTickAheadIsTheReactiveSearchBitForBit) {
  LookaheadSettings one;
  one.horizon = 1;
  one.branches = 0;
  BqsaSettings first;
  first.release = Release::kFirst;
  Generator generator(72);
  int clamped = 0;
  std::vector<Problem> problems{planar_7r()};
  for (int k = 0; k < 20; ++k) {
    problems.push_back(slow_arm_scene(generator, 1, 0.03));
    problems.back().limits = {};
  }
  for (const Problem& problem : problems) {
    BqsaPlanar reactive(PlanarVariant::kExact, first);
    BqsaLookahead method(one);
    const Replay expected = replay(reactive, problem);
    const Replay run = replay(method, problem);
    if (!solved(expected, problem)) continue;
    EXPECT_EQ(run.q, expected.q);
    EXPECT_EQ(run.clamped, expected.clamped);
    EXPECT_EQ(run.clamped_ticks, expected.clamped_ticks);
    EXPECT_EQ(method.counters().quadratics, reactive.counters().quadratics);
    EXPECT_EQ(method.counters().kinematics, reactive.counters().kinematics);
    EXPECT_EQ(method.counters().iterations, reactive.counters().iterations);
    EXPECT_EQ(method.counters().linear_solves, reactive.counters().linear_solves);
    clamped += run.clamped_ticks > 0;
  }
  EXPECT_GT(clamped, 10);
}

TEST(BqsaLookahead, GivesTheSameTrajectoryAndCountsEveryTime) {
  const Problem problem = ball_scene();
  BqsaLookahead method;
  const Replay first = replay(method, problem);
  const WorkCounters work = method.counters();
  replay(method, planar_7r(50));
  EXPECT_EQ(replay(method, problem).q, first.q);
  EXPECT_EQ(method.counters().quadratics, work.quadratics);
  EXPECT_EQ(method.counters().kinematics, work.kinematics);
}

TEST(BqsaLookahead, LooksToTheEndOfTheProblemAndNoFurther) {
  for (const int ticks : {1, 2, 7}) {
    Problem problem = planar_7r(400);
    problem.ticks = ticks;
    const auto path = problem.desired_tip;
    problem.desired_tip = [path, end = problem.duration()](double t) {
      EXPECT_LE(t, end);
      return path(t);
    };
    BqsaLookahead method;
    EXPECT_TRUE(solved(replay(method, problem), problem));
  }
}

/// Runs with an arm that does not quite go where it is told: at every tick, and by `jolt` [rad] at
/// tick 20. Every motion from where it is to where it is told to go must be true.
struct Disturbed {
  int ticks = 0;
  std::uint64_t least_work = 0;  ///< quadratics of a tick, from tick 2
  std::uint64_t jolt_work = 0;   ///< quadratics of tick 21
};
Disturbed disturbed_run(const Problem& problem, double noise, double jolt) {
  Generator generator(73);
  BqsaLookahead method;
  method.prepare(problem);
  Disturbed run;
  StepInput input;
  StepOutput output;
  input.q = problem.start;
  std::uint64_t work = 0;
  for (input.tick = 1; input.tick <= problem.ticks; ++input.tick) {
    input.t = problem.time(input.tick);
    input.p_WT_desired = problem.desired_tip(input.t);
    method.step(input, output);
    const std::uint64_t quadratics = method.counters().quadratics - work;
    work += quadratics;
    if (input.tick == 2) run.least_work = quadratics;
    run.least_work = std::min(run.least_work, quadratics);
    if (input.tick == 21) run.jolt_work = quadratics;
    if (output.state == TickState::kInfeasible) break;
    ++run.ticks;
    EXPECT_EQ(forbidden_step(problem, input.q, output.q), Infeasible::kNot) << input.tick;
    Problem moment = problem;
    for (Obstacle& obstacle : moment.obstacles) {
      if (obstacle.moves()) {
        obstacle.motion = {obstacle.at(input.tick - 1), obstacle.at(input.tick)};
      }
    }
    EXPECT_TRUE(sampled_hits(moment, {input.q, output.q}, 40).empty()) << input.tick;
    ChainPose pose;
    problem.chain.forward(output.q, pose);
    EXPECT_LT((pose.tip() - input.p_WT_desired).norm(), 1e-8) << input.tick;
    const double amplitude = input.tick == 20 ? jolt : noise;
    input.q = output.q + JointVector::NullaryExpr(output.q.size(), [&](Eigen::Index) {
                return uniform(generator, -amplitude, amplitude);
              });
  }
  return run;
}

TEST(BqsaLookahead, StaysTrueWhereTheArmIsNotWhereItWasPlannedToBe) {
  std::vector<Problem> problems{planar_7r(), ball_scene()};
  Generator generator(74);
  for (int k = 0; k < 10; ++k) problems.push_back(slow_arm_scene(generator, 2, 0.01));
  int all = 0;
  for (std::size_t k = 0; k < problems.size(); ++k) {
    for (const double jolt : {0.003, 0.03, 0.2}) {
      SCOPED_TRACE(k);
      all += disturbed_run(problems[k], 1e-6, jolt).ticks == problems[k].ticks;
    }
  }
  EXPECT_GT(all, 12);
}

TEST(BqsaLookahead, PlansAnewOnlyWhereItHasTo) {
  const Problem problem = planar_7r();
  const Disturbed undisturbed = disturbed_run(problem, 0, 0);
  const Disturbed noisy = disturbed_run(problem, 1e-6, 1e-6);
  EXPECT_EQ(undisturbed.ticks, problem.ticks);
  EXPECT_EQ(noisy.ticks, problem.ticks);
  EXPECT_LT(noisy.jolt_work, 3 * undisturbed.jolt_work + 100) << "the plan could be kept";
  EXPECT_GT(disturbed_run(problem, 0, 0.5).jolt_work, 20 * undisturbed.jolt_work);
}

TEST(BqsaLookahead, DoesNotAllocateExceptAtDeadEnds) {
  for (const Problem& problem : {planar_7r(), ball_scene(), test_support::puma560_ellipsoid()}) {
    BqsaLookahead method;
    const test_support::WarmRun warm = test_support::warm_run(method, problem);
    EXPECT_EQ(warm.allocations, 0U);
    EXPECT_EQ(warm.infeasible, 0);
    EXPECT_GT(warm.clamped, 5);
  }
}

TEST(BqsaLookahead, NeedsAPath) {
  Problem problem = planar_7r();
  problem.desired_tip = nullptr;
  BqsaLookahead method;
  EXPECT_THROW(method.prepare(problem), std::invalid_argument);
  problem = planar_7r();
  problem.ticks = 0;
  EXPECT_THROW(method.prepare(problem), std::invalid_argument);
}

}  // namespace
}  // namespace bqsa
