#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "baselines/closest/exact_distance_search.hpp"
#include "baselines/closest/fcl_distance_search.hpp"
#include "baselines/closest/vectorized_test_point_search.hpp"
#include "support/allocation_guard.hpp"
#include "support/closest_point_scenes.hpp"
#include "support/distance_oracle.hpp"
#include "support/prismatic_arms.hpp"

namespace bqsa::baselines {
namespace {

using test_support::DistanceOracle;
using test_support::Generator;
using test_support::random_closest_point_scene;
using test_support::uniform;

constexpr double kEverywhere = std::numeric_limits<double>::infinity();

struct Answer {
  std::vector<ClosestPoint> points;
  WorkCounters work;
};

Answer ask(ClosestPointSearch&& search, const Problem& problem, double reach,
           double exempt_length = 0, int tick = 0) {
  Answer answer;
  search.assign(problem, exempt_length, answer.work);
  search.go_to(tick);
  ChainPose pose;
  problem.chain.forward(problem.start, pose);
  search.search(pose, reach, answer.points);
  return answer;
}

/// Infinite for a link of which nothing is left.
double oracle_distance(const Problem& problem, int link, int obstacle, double exempt_length,
                       int tick) {
  ChainPose pose;
  problem.chain.forward(problem.start, pose);
  const LinkAxis axis =
      link_axis(problem.chain, pose, static_cast<std::size_t>(link), exempt_length);
  if (axis.s_end < 0) return kEverywhere;
  const Ellipsoid& shape = problem.obstacles[static_cast<std::size_t>(obstacle)].at(tick);
  return static_cast<double>(DistanceOracle(axis.a, axis.b, shape).distance());
}

Eigen::Vector3d on_link(const Problem& problem, const ClosestPoint& point) {
  ChainPose pose;
  problem.chain.forward(problem.start, pose);
  const Link& link = problem.chain.links()[static_cast<std::size_t>(point.link)];
  return (1 - point.s) * pose.p_WO.col(link.start) + point.s * pose.p_WO.col(link.end);
}

TEST(ExactDistanceSearch, FindsExactlyThePairsWithinReachWithTheirDistances) {
  Generator generator(1);
  int near = 0, far = 0, meeting = 0;
  for (int trial = 0; trial < 150; ++trial) {
    const Problem problem = random_closest_point_scene(generator, trial);
    const double exempt_length = trial % 4 == 0 ? 0 : uniform(generator, 0, 0.2);
    const double reach = uniform(generator, 0.01, 0.5);
    const int tick = trial % 5;
    const Answer answer = ask(ExactDistanceSearch(), problem, reach, exempt_length, tick);
    std::size_t next = 0;
    for (int j = 0; j < static_cast<int>(problem.obstacles.size()); ++j) {
      for (int i = 0; i < static_cast<int>(problem.chain.links().size()); ++i) {
        const double expected = oracle_distance(problem, i, j, exempt_length, tick);
        if (expected >= reach) {
          ++far;
          continue;
        }
        ++near;
        meeting += expected == 0;
        ASSERT_LT(next, answer.points.size()) << trial;
        const ClosestPoint& found = answer.points[next++];
        EXPECT_EQ(found.link, i) << trial;
        EXPECT_EQ(found.obstacle, j) << trial;
        EXPECT_NEAR(found.distance, expected, 1e-14) << trial;
        EXPECT_LT((on_link(problem, found) - found.p_obstacle - expected * found.direction).norm(),
                  1e-13)
            << trial;
      }
    }
    EXPECT_EQ(next, answer.points.size()) << trial;
    EXPECT_LE(answer.work.distance_queries,
              problem.obstacles.size() * problem.chain.links().size());
    EXPECT_GE(answer.work.distance_queries, answer.points.size());
    EXPECT_EQ(answer.work.point_pairs, 0U);
  }
  EXPECT_GT(near, 150);
  EXPECT_GT(far, 500);
  EXPECT_GT(meeting, 30);
}

/// The capsules of links that change their length are as long as the pose has them.
TEST(FclDistanceSearch, FollowsLinksThatChangeTheirLength) {
  Generator generator(5);
  int compared = 0;
  for (int trial = 0; trial < 60; ++trial) {
    Problem problem = random_closest_point_scene(generator, 2 * trial + 1);
    problem.chain = SerialChain(test_support::random_prismatic_arm(generator, 7));
    problem.link_radii.clear();
    WorkCounters work;
    FclDistanceSearch fcl(FclSolver::kIndepMillimetres, trial % 2 == 0);
    fcl.assign(problem, 0, work);
    for (int pose_number = 0; pose_number < 3; ++pose_number) {
      problem.start = test_support::random_vector<7>(generator, 1);
      const Answer exact = ask(ExactDistanceSearch(), problem, 1);
      ChainPose pose;
      problem.chain.forward(problem.start, pose);
      std::vector<ClosestPoint> found;
      fcl.search(pose, 1, found);
      ASSERT_EQ(found.size(), exact.points.size()) << trial;
      for (std::size_t k = 0; k < found.size(); ++k) {
        if (exact.points[k].distance < problem.link_radius + 1e-5) continue;
        EXPECT_NEAR(found[k].distance, exact.points[k].distance, 1.4e-7) << trial;
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 1000);
}

/// FCL's documented tolerance for its best setting: 5e-7 mm, 1.4e-4 mm close to contact.
TEST(FclDistanceSearch, AtItsBestAgreesWithTheExactDistance) {
  Generator generator(2);
  int apart = 0, touching = 0;
  double worst = 0;
  for (int trial = 0; trial < 1600; ++trial) {
    const Problem problem = random_closest_point_scene(generator, trial);
    const double exempt_length = trial % 4 == 0 ? 0 : uniform(generator, 0, 0.2);
    const int tick = trial % 5;
    const Answer exact = ask(ExactDistanceSearch(), problem, kEverywhere, exempt_length, tick);
    const Answer fcl = ask(FclDistanceSearch(FclSolver::kIndepMillimetres, false), problem,
                           kEverywhere, exempt_length, tick);
    ASSERT_EQ(fcl.points.size(), exact.points.size()) << trial;
    EXPECT_EQ(fcl.work.distance_queries, fcl.points.size()) << trial;
    for (std::size_t k = 0; k < fcl.points.size(); ++k) {
      const ClosestPoint& found = fcl.points[k];
      const ClosestPoint& expected = exact.points[k];
      EXPECT_EQ(found.link, expected.link) << trial;
      EXPECT_EQ(found.obstacle, expected.obstacle) << trial;
      const double radius = problem.radius_of(static_cast<std::size_t>(found.link));
      const double gap = expected.distance - radius;
      if (gap > 1e-5) {
        worst = std::max(worst, std::abs(found.distance - expected.distance));
        EXPECT_LT((found.direction - expected.direction).norm(), gap > 1e-3 ? 5e-3 : 0.5) << trial;
        EXPECT_LT((on_link(problem, found) - found.p_obstacle).norm(), found.distance + 1e-4);
        ++apart;
      } else if (gap < -1e-5 || (expected.distance == 0 && radius == 0)) {
        EXPECT_EQ(found.distance, radius) << trial;
        if (expected.distance == 0) {
          EXPECT_LT((found.direction - expected.direction).norm(), 1e-9) << trial;
          EXPECT_NEAR(found.s, expected.s, 1e-9) << trial;
        }
        ++touching;
      }
    }
  }
  EXPECT_LT(worst, 2e-8);
  EXPECT_GT(apart, 20000);
  EXPECT_GT(touching, 500);
}

/// What a user of the defaults gets. An error found here is FCL's, known, and reported in
/// docs/fairness.md: the default tolerance is absolute, 1e-6 of whatever the unit is.
TEST(FclDistanceSearch, AsShippedErrsByMillimetresInMetresAndLessInMillimetres) {
  Generator generator(3);
  double worst_metres = 0, worst_millimetres = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const Problem problem = random_closest_point_scene(generator, trial);
    const Answer exact = ask(ExactDistanceSearch(), problem, kEverywhere);
    const Answer metres =
        ask(FclDistanceSearch(FclSolver::kLibccdMetres, false), problem, kEverywhere);
    const Answer millimetres =
        ask(FclDistanceSearch(FclSolver::kLibccdMillimetres, false), problem, kEverywhere);
    for (std::size_t k = 0; k < exact.points.size(); ++k) {
      if (exact.points[k].distance < problem.link_radius + 1e-3) continue;
      const double distance = exact.points[k].distance;
      worst_metres = std::max(worst_metres, std::abs(metres.points[k].distance - distance));
      worst_millimetres =
          std::max(worst_millimetres, std::abs(millimetres.points[k].distance - distance));
    }
  }
  RecordProperty("worst_metres", std::to_string(worst_metres));
  std::printf("as shipped: %.3g m off in metres, %.3g m in millimetres\n", worst_metres,
              worst_millimetres);
  EXPECT_GT(worst_metres, 1e-3);
  EXPECT_LT(worst_metres, 0.1);
  EXPECT_LT(worst_millimetres, 5e-4);
}

TEST(FclDistanceSearch, FindsTheSamePairsWithAndWithoutBroadphase) {
  Generator generator(4);
  int found = 0;
  std::uint64_t with = 0, without = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const Problem problem = random_closest_point_scene(generator, trial);
    const double reach = problem.link_radius + uniform(generator, 0.01, 1.5);
    const int tick = trial % 5;
    const Answer brute =
        ask(FclDistanceSearch(FclSolver::kIndepMillimetres, false), problem, reach, 0.05, tick);
    const Answer tree =
        ask(FclDistanceSearch(FclSolver::kIndepMillimetres, true), problem, reach, 0.05, tick);
    ASSERT_EQ(tree.points.size(), brute.points.size()) << trial;
    for (std::size_t k = 0; k < brute.points.size(); ++k) {
      EXPECT_EQ(tree.points[k].link, brute.points[k].link) << trial;
      EXPECT_EQ(tree.points[k].obstacle, brute.points[k].obstacle) << trial;
      EXPECT_NEAR(tree.points[k].distance, brute.points[k].distance, 1e-9) << trial;
      ++found;
    }
    with += tree.work.distance_queries;
    without += brute.work.distance_queries;
  }
  EXPECT_GT(found, 3000);
  EXPECT_LT(with, without);
}

TEST(ClosestPointSearches, TestPointsComeNearTheExactDistanceFromAbove) {
  Generator generator(5);
  double excess[3] = {0, 0, 0};
  int compared = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Problem problem = random_closest_point_scene(generator, trial);
    const Answer exact = ask(ExactDistanceSearch(), problem, kEverywhere);
    for (int level = 0; level < 3; ++level) {
      const int points = level == 0 ? 12 : level == 1 ? 100 : 900;
      const Answer found = ask(VectorizedTestPointSearch({.link = points, .obstacle = points}),
                               problem, kEverywhere);
      ASSERT_EQ(found.points.size(), exact.points.size()) << trial;
      for (std::size_t k = 0; k < exact.points.size(); ++k) {
        if (exact.points[k].distance == 0) continue;  // inside: the distance to the surface
        const double above = found.points[k].distance - exact.points[k].distance;
        EXPECT_GT(above, -1e-14) << trial;
        excess[level] += above;
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 1000);
  EXPECT_LT(excess[1], excess[0] / 5);
  EXPECT_LT(excess[2], excess[1] / 5);
}

}  // namespace
}  // namespace bqsa::baselines
