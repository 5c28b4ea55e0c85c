#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <stdexcept>
#include <utility>

#include "harness/judge/judge.hpp"
#include "harness/judge/obstacle_track.hpp"
#include "judge_scenes.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;
using test_support::Generator;
using test_support::uniform;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kDegree = std::numbers::pi / 180;

Ellipsoid ball(double x, double y, double radius) {
  return {Vector3d(x, y, 0), Vector3d::Constant(radius)};
}

Ellipsoid needle(double x, double y, double angle) {
  return embedded(rotated_ellipse({x, y}, {0.2, 0.001}, angle));
}

/// A link of 1 m along x that turns by `step` a tick, and an obstacle with the given states.
Judgement judge_link(const std::vector<Ellipsoid>& states, double step = 0,
                     double link_radius = 0) {
  Problem problem =
      test_support::free_problem(planar_chain({1}), static_cast<int>(states.size()) - 1);
  problem.link_radius = link_radius;
  problem.obstacles.push_back({"it", states.front(), states});
  return Judge(problem).judge(test_support::steady_motion(problem, JointVector::Constant(1, step)));
}

TEST(MovingObstacles, ABulletThatPassesARestingLinkBetweenTwoTicksIsCaught) {
  for (const double link_radius : {0.0, 0.005}) {
    const Judgement judgement =
        judge_link({ball(0.5, 2, 0.01), ball(0.5, 1, 0.01), ball(0.5, -1, 0.01)}, 0, link_radius);
    EXPECT_THAT(judgement.failures, ElementsAre(Failure::kCollision));
    ASSERT_EQ(judgement.contacts.size(), 1U);
    EXPECT_FALSE(judgement.contacts[0].at_tick);
    EXPECT_EQ(judgement.contacts[0].first_tick, 2);
    EXPECT_NEAR(judgement.clearance_at_ticks, 0.99 - link_radius, 1e-9);
    EXPECT_LT(judgement.clearance, 0);
  }
}

TEST(MovingObstacles, ABulletThatPassesBesideTheTipIsFreeAndItsClearanceFound) {
  constexpr double kGap = 0.02;
  const Judgement judgement = judge_link(
      {ball(1.01 + kGap, 2, 0.01), ball(1.01 + kGap, 1, 0.01), ball(1.01 + kGap, -1.3, 0.01)});
  EXPECT_TRUE(judgement.success());
  EXPECT_GT(judgement.clearance_at_ticks, 0.9);
  EXPECT_GE(judgement.clearance, kGap - 1e-12);
  EXPECT_LE(judgement.clearance, kGap * 1.0011);
}

TEST(MovingObstacles, TheTouchingBandCountsBetweenTicksToo) {
  for (const double gap : {2e-6, 0.5e-6, -0.5e-6, -2e-6}) {
    const Judgement judgement =
        judge_link({ball(1.01 + gap, 1, 0.01), ball(1.01 + gap, -1.3, 0.01)});
    EXPECT_EQ(judgement.success(), gap > -1e-6) << gap;
    EXPECT_EQ(judgement.touching, std::abs(gap) < 1e-6) << gap;
  }
}

TEST(MovingObstacles, ANeedleThatSweepsThroughALinkBetweenTicksIsCaught) {
  const Judgement through =
      judge_link({needle(1.1, 0, 120 * kDegree), needle(1.1, 0, 240 * kDegree)});
  EXPECT_THAT(through.failures, ElementsAre(Failure::kCollision));
  ASSERT_EQ(through.contacts.size(), 1U);
  EXPECT_FALSE(through.contacts[0].at_tick);
  EXPECT_GT(through.clearance_at_ticks, 0.05);
  const Judgement aside = judge_link({needle(1.1, 0, 120 * kDegree), needle(1.1, 0, 60 * kDegree)});
  EXPECT_THAT(aside.failures, IsEmpty());
}

TEST(MovingObstacles, WhereAnObstacleIsNoMoreNothingIsHit) {
  // The link turns through where the ball was, and the ball comes where the link was.
  const double turn = 10 * kDegree;
  const auto at = [](double angle) {
    return ball(0.8 * std::cos(angle), 0.8 * std::sin(angle), 0.02);
  };
  const Judgement after = judge_link({at(turn), at(2 * turn), at(3 * turn), at(4 * turn)}, turn);
  EXPECT_THAT(after.failures, IsEmpty());
  EXPECT_NEAR(after.clearance_at_ticks, 0.8 * std::sin(turn) - 0.02, 1e-12);
  const Judgement rest = judge_link({at(turn), at(turn), at(turn), at(turn)}, turn);
  EXPECT_THAT(rest.failures, ElementsAre(Failure::kCollision));
  const Judgement late = judge_link({at(-turn), at(0), at(turn), at(2 * turn)}, turn);
  EXPECT_THAT(late.failures, IsEmpty());
}

TEST(MovingObstacles, AnObstacleThatGoesRoundInStepWithTheLinkStaysFree) {
  // On a chord instead of its arc the obstacle leaves the link's frame sideways by 0.12 mm.
  constexpr double kGap = 1e-3;
  std::vector<Ellipsoid> states;
  const double step = 14 * kDegree;
  for (int tick = 0; tick <= 20; ++tick) {
    const Eigen::Rotation2Dd turn(tick * step);
    states.push_back(embedded(
        rotated_ellipse(turn * Eigen::Vector2d(0.5, 0.01 + kGap), {0.1, 0.01}, tick * step)));
  }
  const Judgement judgement = judge_link(states, step);
  EXPECT_THAT(judgement.failures, IsEmpty());
  EXPECT_NEAR(judgement.clearance_at_ticks, kGap, 1e-9);
  EXPECT_LT(judgement.clearance, kGap - 0.1e-3);
  EXPECT_GT(judgement.clearance, kGap - 0.2e-3);
}

/// A planar arm of three links among three obstacles that move and turn for eight ticks.
struct ShortRun {
  Problem problem;
  JointVector step;
};

ShortRun random_run(Generator& generator) {
  ShortRun run{test_support::free_problem(planar_chain({0.5, 0.4, 0.3}), 8), JointVector(3)};
  for (const char* name : {"one", "two", "three"}) {
    const double angle = uniform(generator, -3, 3), distance = uniform(generator, 0.3, 1.6);
    Obstacle obstacle{name, Ellipsoid({distance * std::cos(angle), distance * std::sin(angle), 0},
                                      {0.05, 0.02, test_support::log_uniform(generator, 1e-3, 1)})};
    const bool planar = generator() % 2 == 0;
    for (int tick = 1; tick <= run.problem.ticks; ++tick) {
      test_support::move_obstacle(generator, planar, 0.05, 1, obstacle);
    }
    run.problem.obstacles.push_back(obstacle);
  }
  for (int j = 0; j < 3; ++j) run.step(j) = uniform(generator, -0.2, 0.2);
  return run;
}

std::set<std::pair<int, std::string>> pairs_of(const Judgement& judgement) {
  std::set<std::pair<int, std::string>> pairs;
  for (const Contact& contact : judgement.contacts) pairs.insert({contact.link, contact.obstacle});
  return pairs;
}

TEST(MovingObstacles, TheClearanceOfARunIsTheLeastOfDenseSamples) {
  Generator generator(8);
  int free = 0, nearer_than_ticks = 0;
  for (int k = 0; k < 200; ++k) {
    const ShortRun run = random_run(generator);
    const Judgement judgement =
        Judge(run.problem).judge(test_support::steady_motion(run.problem, run.step));
    ASSERT_EQ(judgement.disagreement, "") << "case " << k;
    if (!judgement.success()) continue;
    ++free;
    constexpr int kSamples = 100;
    Problem dense = run.problem;
    dense.ticks = run.problem.ticks * kSamples;
    for (Obstacle& obstacle : dense.obstacles) {
      const Obstacle coarse = obstacle;
      obstacle.motion = {coarse.motion.front()};
      for (int tick = 1; tick <= run.problem.ticks; ++tick) {
        for (int i = 1; i <= kSamples; ++i) {
          obstacle.motion.push_back(
              test_support::obstacle_between(coarse, tick, static_cast<double>(i) / kSamples));
        }
      }
    }
    const double sampled = Judge(dense)
                               .judge(test_support::steady_motion(dense, run.step / kSamples))
                               .clearance_at_ticks;
    ASSERT_LE(judgement.clearance, sampled + std::max(1e-6, 1.01e-3 * sampled)) << "case " << k;
    ASSERT_GE(judgement.clearance, sampled - 1e-2) << "case " << k;  // half a sample's way
    if (sampled < 0.99 * judgement.clearance_at_ticks) ++nearer_than_ticks;
  }
  EXPECT_GT(free, 30);
  EXPECT_GE(nearer_than_ticks, 10);
}

TEST(MovingObstacles, ARunBackwardsInTimeHasTheSameContactsAndClearance) {
  Generator generator(9);
  int colliding = 0, only_between = 0, free = 0;
  for (int k = 0; k < 300; ++k) {
    ShortRun run = random_run(generator);
    const Trajectory forth = test_support::steady_motion(run.problem, run.step);
    const Judgement judgement = Judge(run.problem).judge(forth);
    Trajectory back = forth;
    std::reverse(back.q.begin(), back.q.end());
    run.problem.start = back.q.front();
    for (Obstacle& obstacle : run.problem.obstacles) {
      std::reverse(obstacle.motion.begin(), obstacle.motion.end());
      obstacle.shape = obstacle.motion.front();
    }
    const Judgement reversed = Judge(run.problem).judge(back);
    ASSERT_EQ(judgement.failures, reversed.failures) << "case " << k;
    ASSERT_EQ(pairs_of(judgement), pairs_of(reversed)) << "case " << k;
    ASSERT_NEAR(judgement.clearance_at_ticks, reversed.clearance_at_ticks, 1e-9) << "case " << k;
    if (judgement.success()) {
      ++free;
      ASSERT_NEAR(judgement.clearance, reversed.clearance,
                  std::max(1e-6, 1.01e-3 * judgement.clearance))
          << "case " << k;
    } else {
      ++colliding;
      if (std::any_of(judgement.contacts.begin(), judgement.contacts.end(),
                      [](const Contact& contact) { return !contact.at_tick; })) {
        ++only_between;
      }
    }
  }
  EXPECT_GT(free, 40);
  EXPECT_GT(colliding, 60);
  EXPECT_GT(only_between, 30);
}

TEST(ObstacleTrack, IsTheSlerpOfItsStates) {
  Generator generator(10);
  int cases = 0;
  for (int k = 0; k < 500; ++k) {
    Obstacle obstacle{"it", test_support::random_ellipsoid<3>(generator, 0.01, 1)};
    for (int tick = 1; tick <= 3; ++tick) {
      test_support::move_obstacle(generator, k % 2 == 0, 1, k % 3 == 0 ? 1e-6 : 3.1, obstacle);
    }
    const ObstacleTrack track(obstacle, 3);
    for (int tick = 1; tick <= 3; ++tick) {
      const double s = uniform(generator, 0, 1);
      const ObstacleState state = track.at({tick, s});
      const Ellipsoid expected = test_support::obstacle_between(obstacle, tick, s);
      ASSERT_LT((state.center - expected.center()).norm(), 1e-14) << "case " << k;
      ASSERT_LT((state.rotation - expected.rotation()).norm(), 1e-13) << "case " << k;
      // The rates are those of the place, by central differences.
      constexpr double kStep = 1e-4;
      const double inside = std::clamp(s, kStep, 1 - kStep);
      const ObstacleState before = track.at({tick, inside - kStep});
      const ObstacleState after = track.at({tick, inside + kStep});
      const Vector3d arm(0.3, -0.2, 0.5);
      const Vector3d here = track.at({tick, inside}).rotation * arm;
      const Vector3d difference = (after.rotation * arm - before.rotation * arm) / (2 * kStep);
      ASSERT_LT((difference - state.spin.cross(here)).norm(), 1e-7) << "case " << k;
      ASSERT_LT(((after.center - before.center) / (2 * kStep) - state.velocity).norm(), 1e-9);
      ++cases;
    }
    ASSERT_EQ(track.at({2, 1}).center, obstacle.at(2).center());
    ASSERT_EQ(track.at({2, 1}).rotation, obstacle.at(2).rotation());
  }
  EXPECT_EQ(cases, 1500);
}

TEST(ObstacleTrack, RefusesStatesThatAreNotAMotion) {
  const Obstacle good{"it", ball(0, 0, 1), {ball(0, 0, 1), ball(1, 0, 1)}};
  EXPECT_NO_THROW(ObstacleTrack(good, 1));
  EXPECT_THROW(ObstacleTrack(good, 2), std::invalid_argument);
  const Obstacle growing{"it", ball(0, 0, 1), {ball(0, 0, 1), ball(1, 0, 2)}};
  EXPECT_THROW(ObstacleTrack(growing, 1), std::invalid_argument);
}

TEST(ObstacleTrack, AnObstacleAtRestIsWhereItIs) {
  const ObstacleTrack track(Obstacle{"it", ball(1, 2, 3)}, 5);
  EXPECT_FALSE(track.moves());
  EXPECT_EQ(track.at({4, 0.3}).center, Vector3d(1, 2, 0));
  EXPECT_EQ(track.at({4, 0.3}).velocity, Vector3d::Zero());
  EXPECT_EQ(track.travel(4), 0);
}

}  // namespace
}  // namespace bqsa::harness
