#include "baselines/closest/test_point_search.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <numbers>

#include "support/distance_oracle.hpp"
#include "support/paper_problems.hpp"
#include "support/sampling.hpp"

namespace bqsa::baselines {
namespace {

using test_support::DistanceOracle;
using test_support::Generator;
using test_support::uniform;

JointVector random_joints(Generator& generator, int joints) {
  return JointVector::NullaryExpr(joints,
                                  [&](Eigen::Index) { return uniform(generator, -1.5, 1.5); });
}

/// The closest of all links to one obstacle; link -1 if there is none.
ClosestPoint closest_to(ClosestPointSearch& search, const ChainPose& pose, int obstacle) {
  std::vector<ClosestPoint> found;
  search.search(pose, std::numeric_limits<double>::infinity(), found);
  ClosestPoint closest{.link = -1, .distance = std::numeric_limits<double>::infinity()};
  for (const ClosestPoint& point : found) {
    if (point.obstacle == obstacle && point.distance < closest.distance) closest = point;
  }
  return closest;
}

/// Least exact distance over all links [m].
double exact_distance(const Problem& problem, const ChainPose& pose, int obstacle) {
  double least = 1e9;
  for (const Link& link : problem.chain.links()) {
    const DistanceOracle oracle(pose.p_WO.col(link.start), pose.p_WO.col(link.end),
                                problem.obstacles[static_cast<std::size_t>(obstacle)].shape);
    least = std::min(least, static_cast<double>(oracle.distance()));
  }
  return least;
}

TEST(TestPointSearch, NeverFindsLessThanTheDistanceAndComesNearItWithManyPoints) {
  Generator generator(3);
  int compared = 0;
  std::map<int, double> total_excess;  // by number of points
  for (int trial = 0; trial < 60; ++trial) {
    const Problem problem =
        trial % 2 == 0 ? test_support::planar_7r() : test_support::puma560_ellipsoid();
    ChainPose pose;
    problem.chain.forward(random_joints(generator, problem.chain.joints()), pose);
    WorkCounters counters;
    const double exact = exact_distance(problem, pose, 0);
    if (exact == 0) continue;  // the distance to a surface that is crossed has no such meaning
    ++compared;
    for (const int points : {10, 100, 1000}) {
      TestPointSearch search({points, points});
      search.assign(problem, 0, counters);
      const ClosestPoint pair = closest_to(search, pose, 0);
      const double excess = pair.distance - exact;
      EXPECT_GT(excess, -1e-9) << "trial " << trial << ", " << points << " points";
      total_excess[points] += excess;
      if (points == 1000) {
        EXPECT_LT(excess, 0.02) << "trial " << trial;
      }
    }
  }
  EXPECT_GT(compared, 30);
  EXPECT_LT(total_excess[100], total_excess[10] / 5);
  EXPECT_LT(total_excess[1000], total_excess[100] / 5);
}

TEST(TestPointSearch, FindsThePairThatANaiveLoopFinds) {
  Generator generator(4);
  const Problem problem = test_support::planar_7r();
  constexpr int kN = 7, kM = 13;
  WorkCounters counters;
  TestPointSearch search({kN, kM});
  search.assign(problem, 0, counters);
  for (int trial = 0; trial < 200; ++trial) {
    ChainPose pose;
    problem.chain.forward(random_joints(generator, 7), pose);
    double least = 1e9;
    for (int i = 0; i < 7; ++i) {
      for (int a = 0; a < kN; ++a) {
        const double s = a / (kN - 1.0);
        const Eigen::Vector3d p = (1 - s) * pose.p_WO.col(i) + s * pose.p_WO.col(i + 1);
        for (int b = 0; b < kM; ++b) {
          const double angle = 2 * std::numbers::pi * b / kM;
          const Eigen::Vector3d on_surface(1.75 + 0.21 * std::cos(angle),
                                           0.58 + 0.10 * std::sin(angle), 0);
          least = std::min(least, (p - on_surface).norm());
        }
      }
    }
    std::vector<ClosestPoint> found;
    search.search(pose, std::numeric_limits<double>::infinity(), found);
    ASSERT_EQ(found.size(), 14U);
    double found_least = 1e9;
    for (const ClosestPoint& pair : found) {
      if (pair.obstacle == 1) found_least = std::min(found_least, std::abs(pair.distance));
      EXPECT_NEAR(pair.direction.norm(), 1, 1e-12) << trial;
    }
    EXPECT_NEAR(found_least, least, 1e-12) << trial;
  }
  EXPECT_EQ(counters.point_pairs, 2 * 200U * 7 * kN * kM);  // of two obstacles
}

TEST(TestPointSearch, LeavesOutTheExemptEndOfTheLastLinkOnly) {
  Problem problem = test_support::planar_7r();
  ChainPose pose;
  problem.chain.forward(problem.start, pose);
  // A small obstacle just beyond the tip.
  const Eigen::Vector3d direction = (pose.p_WO.col(7) - pose.p_WO.col(6)).normalized();
  const Eigen::Vector3d center = pose.tip() + 0.03 * direction;
  problem.obstacles = {{"ball", Ellipsoid(center, {0.02, 0.02, 0.02})}};
  WorkCounters counters;
  TestPointSearch all({41, 100}), exempt({41, 100});
  all.assign(problem, 0, counters);
  const std::uint64_t before = counters.point_pairs;
  exempt.assign(problem, 0.095, counters);
  EXPECT_NEAR(closest_to(all, pose, 0).distance, 0.01, 1e-3);
  const std::uint64_t pairs_of_all = counters.point_pairs - before;
  const ClosestPoint pair = closest_to(exempt, pose, 0);
  const std::uint64_t pairs_of_exempt = counters.point_pairs - before - pairs_of_all;
  EXPECT_EQ(problem.chain.links()[static_cast<std::size_t>(pair.link)].number, 7);
  EXPECT_NEAR(pair.distance, 0.11, 2e-3);
  EXPECT_EQ(pairs_of_all - pairs_of_exempt, 10U * 100U);
}

TEST(TestPointSearch, PointsOutwardsFromInsideToo) {
  const Problem problem{
      .name = "inside",
      .chain = SerialChain(planar_chain({0.1, 0.1})),
      .obstacles = {{"o", embedded(rotated_ellipse({0.1, -0.5}, {0.6, 0.6}, 0))}}};
  ChainPose pose;
  problem.chain.forward(JointVector::Zero(2), pose);
  WorkCounters counters;
  TestPointSearch search({11, 720});
  search.assign(problem, 0, counters);
  const ClosestPoint pair = closest_to(search, pose, 0);
  EXPECT_LT(pair.distance, 0);
  EXPECT_GT(pair.direction.y(), 0.7);
}

TEST(TestPointSearch, OfAMovingObstacleAreThoseOfTheShapePutThere) {
  Generator generator(6);
  for (const bool planar : {true, false}) {
    Problem problem = planar ? test_support::planar_7r() : test_support::puma560_ellipsoid();
    Problem resting = problem;
    ChainPose pose;
    problem.chain.forward(problem.start, pose);
    Obstacle& mover =
        problem.obstacles[0];  // turns, and comes over the middle of link 2 at tick 10
    const Link& link = problem.chain.links()[1];
    const Eigen::Vector3d middle = 0.5 * (pose.p_WO.col(link.start) + pose.p_WO.col(link.end));
    for (int tick = 0; tick <= 20; ++tick) {
      const Eigen::Vector3d center =
          mover.shape.center() + 0.1 * tick * (middle - mover.shape.center());
      const Eigen::AngleAxisd turn(0.2 * tick, Eigen::Vector3d::UnitZ());
      mover.motion.emplace_back(center, mover.shape.semi_axes(), turn.toRotationMatrix());
    }
    WorkCounters counters;
    TestPointSearch moving({11, 60});
    moving.assign(problem, 0, counters);
    int inside = 0, outside = 0;
    for (const int tick : {0, 20, 7, 10, 3, 9, 11, 5}) {
      resting.obstacles[0].shape = mover.at(tick);
      TestPointSearch there({11, 60});
      there.assign(resting, 0, counters);
      moving.go_to(tick);
      for (int j = 0; j < static_cast<int>(problem.obstacles.size()); ++j) {
        const ClosestPoint found = closest_to(moving, pose, j);
        const ClosestPoint expected = closest_to(there, pose, j);
        EXPECT_EQ(found.link, expected.link) << "tick " << tick;
        EXPECT_EQ(found.s, expected.s) << "tick " << tick;
        EXPECT_EQ(found.distance, expected.distance) << "tick " << tick;
        EXPECT_EQ(found.direction, expected.direction) << "tick " << tick;
        if (j == 0) ++(found.distance < 0 ? inside : outside);
      }
    }
    EXPECT_GT(inside, 0);
    EXPECT_GT(outside, 0);
  }
}

}  // namespace
}  // namespace bqsa::baselines
