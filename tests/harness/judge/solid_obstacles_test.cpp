// Runs among solids, judged by what the obstacles are and not by the ellipsoids around them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "bqsa/envelope/cover.hpp"
#include "harness/judge/judge.hpp"
#include "harness/judge/link_scene.hpp"
#include "solid_scenes.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kDegree = std::numbers::pi / 180;

/// One link of 1 m that turns by a degree a tick about z, from the x axis on.
class Clock {
 public:
  Clock() : problem(test_support::free_problem(planar_chain({1}), 30)) {
    problem.start << 0;
    trajectory = test_support::steady_motion(problem, JointVector::Constant(1, kDegree));
  }

  /// Adds a solid of convex parts within ellipsoids, as a scenario does.
  void add(const std::string& name, const std::vector<Solid>& parts) {
    TrueObstacle obstacle{.name = name, .parts = parts, .first = told()};
    for (const Solid& part : parts) {
      for (const Ellipsoid& shape : cover(part, {.least_semi_axis = 1e-3}).ellipsoids) {
        problem.obstacles.push_back({name + "#" + std::to_string(told() + 1), shape});
      }
    }
    obstacle.count = told() - obstacle.first;
    truth.push_back(obstacle);
  }

  void add_ball(const std::string& name, const Vector3d& center, double radius) {
    truth.push_back({.name = name, .first = told()});
    problem.obstacles.push_back({name, Ellipsoid(center, Vector3d::Constant(radius))});
  }

  int told() const { return static_cast<int>(problem.obstacles.size()); }
  Judgement judge() const { return Judge(problem, truth).judge(trajectory); }

  /// The point of the link at a distance from the base, at a time in ticks.
  static Vector3d point(double distance, double tick) {
    return distance * Vector3d(std::cos(tick * kDegree), std::sin(tick * kDegree), 0);
  }

  Problem problem;
  std::vector<TrueObstacle> truth;
  Trajectory trajectory;
};

TEST(SolidObstacles, ALinkBetweenASolidAndItsEllipsoidIsFree) {
  Clock run;
  run.add("shelf", {Box{{0, -0.15, 0}, {1, 0.1, 0.2}}});
  const Judgement judgement = run.judge();
  EXPECT_THAT(judgement.failures, IsEmpty()) << judgement.disagreement;
  EXPECT_NEAR(judgement.clearance, 0.05, 1e-12);
  const Judgement by_ellipsoid = Judge(run.problem).judge(run.trajectory);
  EXPECT_THAT(by_ellipsoid.failures, ElementsAre(Failure::kCollision));
}

TEST(SolidObstacles, AHitNamesTheSolidAndCountsItsTicksOnce) {
  Clock run;
  run.add_ball("ball", {-1, 0, 0}, 0.1);
  const Vector3d at = Clock::point(0.8, 10);
  run.add("shelf", {Ball{at, 0.005}, Box{at, {0.004, 0.004, 0.01}}, Box{{0, 0, 1}, {1, 1, 0.1}}});
  const Judgement judgement = run.judge();
  EXPECT_THAT(judgement.failures, ElementsAre(Failure::kCollision));
  EXPECT_EQ(judgement.disagreement, "");
  ASSERT_EQ(judgement.contacts.size(), 1U);
  EXPECT_EQ(judgement.contacts[0].link, 1);
  EXPECT_EQ(judgement.contacts[0].obstacle, "shelf");
  EXPECT_EQ(judgement.contacts[0].first_tick, 10);
  EXPECT_EQ(judgement.contacts[0].ticks, 1);  // 14 mm from tick to tick, and both parts in one
  EXPECT_TRUE(judgement.contacts[0].at_tick);
}

TEST(SolidObstacles, ALinkWhollyInsideHits) {
  for (const Solid& solid :
       {Solid(Box{{0.5, 0, 0}, {2, 2, 2}}), Solid(Cylinder{{0, 0, -2}, {0, 0, 2}, 3}),
        Solid(convex_hull(
            std::vector<Vector3d>{{9, 0, -5}, {-9, 9, -5}, {-9, -9, -5}, {0, 0, 9}}))}) {
    Clock run;
    run.add("room", {solid});
    const Judgement judgement = run.judge();
    EXPECT_THAT(judgement.failures, ElementsAre(Failure::kCollision)) << judgement.disagreement;
    EXPECT_LT(judgement.clearance_at_ticks, -0.4);
  }
}

/// Between tick 10 and 11 the tip passes a board of 0.2 mm that stands across its way.
TEST(SolidObstacles, AThinBoardIsHitBetweenTicks) {
  const Vector3d radial = Clock::point(1, 10.5);
  const Vector3d ahead(-radial.y(), radial.x(), 0);
  Eigen::Matrix3d frame;
  frame << radial, ahead, Vector3d::UnitZ();
  const Box board{1.05 * radial, {0.1, 1e-4, 0.3}, frame};
  std::vector<Vector3d> corners;
  for (const double x : {-0.1, 0.1}) {
    for (const double y : {-1e-5, 1e-5}) {
      for (const double z : {-0.3, 0.3}) {
        corners.emplace_back(1.05 * radial + frame * Vector3d(x, y, z));
      }
    }
  }
  for (const Solid& solid : {Solid(board), Solid(convex_hull(corners))}) {
    Clock run;
    run.add("board", {solid});
    const Judgement judgement = run.judge();
    EXPECT_THAT(judgement.failures, ElementsAre(Failure::kCollision)) << judgement.disagreement;
    ASSERT_EQ(judgement.contacts.size(), 1U);
    EXPECT_EQ(judgement.contacts[0].first_tick, 11);
    EXPECT_FALSE(judgement.contacts[0].at_tick);
    EXPECT_GT(judgement.clearance_at_ticks, 0);
  }
}

TEST(SolidObstacles, ALinkThroughASheetHits) {
  Clock run;
  run.add(
      "sheet",
      {convex_hull(std::vector<Vector3d>{{0.5, -1, -1}, {0.5, 1, -1}, {0.5, 1, 1}, {0.5, -1, 1}})});
  const Judgement judgement = run.judge();
  EXPECT_THAT(judgement.failures, ElementsAre(Failure::kCollision));
  EXPECT_EQ(judgement.contacts.at(0).ticks, 31);
}

/// A random arm of three links with a radius among random solids; the clearance of a run without
/// collision is the least of a hundred times as many samples, and a run is free where they are.
TEST(SolidObstacles, TheClearanceOfARunIsTheLeastOfDenseSamples) {
  test_support::Generator generator(7);
  int free = 0, colliding = 0;
  for (int k = 0; k < 300; ++k) {
    Problem problem = test_support::free_problem(planar_chain({0.4, 0.3, 0.3}), 3);
    problem.link_radius = k % 2 == 0 ? 0 : 0.02;
    for (double& angle : problem.start) angle = test_support::uniform(generator, -3, 3);
    const auto kind = static_cast<std::size_t>(k) % 6;
    Solid solid = test_support::judged_solid(kind, 0.05, generator);
    std::vector<TrueObstacle> truth = {{.name = "solid", .parts = {solid}}};
    const Cover covered = cover(solid, {.least_semi_axis = 1e-3});
    problem.obstacles.push_back({"solid", covered.ellipsoids.front()});
    if (k % 3 == 0) {
      const Vector3d step = 0.1 * test_support::random_direction<3>(generator);
      for (int tick = 0; tick <= problem.ticks; ++tick) {
        problem.obstacles[0].motion.emplace_back(covered.ellipsoids.front().center() + tick * step,
                                                 covered.ellipsoids.front().semi_axes(),
                                                 covered.ellipsoids.front().rotation());
      }
    }
    const JointVector step = JointVector::NullaryExpr(
        3, [&](Eigen::Index) { return test_support::uniform(generator, -0.15, 0.15); });
    const Judgement judgement =
        Judge(problem, truth).judge(test_support::steady_motion(problem, step));
    ASSERT_EQ(judgement.disagreement, "") << "case " << k;

    constexpr int kSamples = 300;
    const LinkScene scene(problem, truth);
    PointPositions positions;
    double least = std::numeric_limits<double>::infinity();
    for (int sample = 0; sample <= problem.ticks * kSamples; ++sample) {
      const double at = static_cast<double>(sample) / kSamples;
      const Eigen::VectorXd q = problem.start + at * step;
      scene.kinematics().place(q, positions);
      const Vector3d way = problem.obstacles[0].moves()
                               ? Vector3d(at * (problem.obstacles[0].at(1).center() -
                                                problem.obstacles[0].at(0).center()))
                               : Vector3d::Zero();
      for (const LinkSegment& link : scene.kinematics().links()) {
        const Vector3d a = positions.points[static_cast<std::size_t>(link.start)] - way;
        const Vector3d b = positions.points[static_cast<std::size_t>(link.end)] - way;
        least = std::min(least, ExactSolid(solid).clearance(a, b).clearance - problem.link_radius);
      }
    }
    if (least < -1e-5) {
      EXPECT_THAT(judgement.failures, ElementsAre(Failure::kCollision)) << "case " << k;
      ++colliding;
    } else if (least > 1e-3) {
      EXPECT_THAT(judgement.failures, IsEmpty()) << "case " << k;
      EXPECT_LE(judgement.clearance, least + 2e-3 * least) << "case " << k;
      EXPECT_GE(judgement.clearance, least - 2e-3) << "case " << k;  // of what samples miss
      ++free;
    }
  }
  EXPECT_GT(free, 15);
  EXPECT_GT(colliding, 15);
}

/// A link at rest, which a board of 2 mm crosses on its way between tick 20 and 21.
TEST(SolidObstacles, AMovingBoardIsHitBetweenTicks) {
  Clock run;
  run.trajectory = test_support::steady_motion(run.problem, JointVector::Zero(1));
  run.add("board", {Box{{0.5, -2.05, 0}, {0.2, 1e-3, 0.3}}});
  Obstacle& board = run.problem.obstacles[0];
  for (int tick = 0; tick <= run.problem.ticks; ++tick) {
    board.motion.emplace_back(board.shape.center() + Vector3d(0, 0.1 * tick, 0),
                              board.shape.semi_axes(), board.shape.rotation());
  }
  const Judgement judgement = run.judge();
  EXPECT_THAT(judgement.failures, ElementsAre(Failure::kCollision)) << judgement.disagreement;
  ASSERT_EQ(judgement.contacts.size(), 1U);
  EXPECT_EQ(judgement.contacts[0].first_tick, 21);
  EXPECT_FALSE(judgement.contacts[0].at_tick);
  EXPECT_NEAR(judgement.clearance_at_ticks, 0.049, 1e-12);
}

TEST(SolidObstacles, ThatTurnAreRefused) {
  Clock run;
  run.add("box", {Box{{3, 0, 0}, {0.1, 0.2, 0.3}}});
  const Ellipsoid shape = run.problem.obstacles[0].shape;
  for (int tick = 0; tick <= run.problem.ticks; ++tick) {
    run.problem.obstacles[0].motion.emplace_back(
        shape.center(), shape.semi_axes(),
        Eigen::Matrix3d(Eigen::AngleAxisd(0.01 * tick, Vector3d::UnitZ()).toRotationMatrix() *
                        shape.rotation()));
  }
  EXPECT_THROW(Judge(run.problem, run.truth), std::invalid_argument);
}

TEST(SolidObstacles, NoneGoesUnjudged) {
  Clock run;
  run.add("shelf", {Ball{{3, 0, 0}, 0.1}});
  run.add_ball("ball", {-3, 0, 0}, 0.1);
  EXPECT_NO_THROW(Judge(run.problem, run.truth));
  EXPECT_THROW(Judge(run.problem, {run.truth[0]}), std::invalid_argument);
  EXPECT_THROW(Judge(run.problem, {run.truth[1]}), std::invalid_argument);
  EXPECT_THROW(Judge(run.problem, std::vector<TrueObstacle>{}), std::invalid_argument);
}

TEST(LinkScene, NamesTheObstacleOfABody) {
  Clock run;
  run.add("shelf", {Ball{{3, 0, 0}, 0.1}, Ball{{4, 0, 0}, 0.1}});
  run.add_ball("ball", {-3, 0, 0}, 0.1);
  const LinkScene scene(run.problem, run.truth);
  ASSERT_EQ(scene.pairs().size(), 3U);
  EXPECT_EQ(scene.show(scene.pairs()[0]), "link 1, obstacle ball");
  EXPECT_EQ(scene.show(scene.pairs()[1]), "link 1, obstacle shelf");
  EXPECT_EQ(scene.obstacle(scene.pairs()[0]), 1);
  EXPECT_EQ(scene.obstacle(scene.pairs()[2]), 0);
}

}  // namespace
}  // namespace bqsa::harness
