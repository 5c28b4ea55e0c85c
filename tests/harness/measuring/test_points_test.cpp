// The paper's opponent: where its points are, and what more of them see.

#include "harness/measuring/test_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "harness/judge/exact_distance.hpp"
#include "harness/measuring/detector.hpp"

namespace bqsa::harness {
namespace {

Workload workload_of(int dimension, baselines::TestPointCounts counts, std::uint64_t seed = 41) {
  return make_workload({.dimension = dimension, .links = 6, .obstacles = 5, .test_points = counts},
                       seed);
}

TEST(TestPoints, LieOnLinksAndSurfaces) {
  for (const int dimension : {2, 3}) {
    const Workload workload = workload_of(dimension, {.link = 4, .obstacle = 7});
    const Eigen::Matrix3Xd on_links = link_test_points(workload);
    ASSERT_EQ(on_links.cols(), static_cast<Eigen::Index>(workload.poses.size()) * 6 * 4);
    const Eigen::Index first = (3 * 6 + 2) * 4;  // of the third link in the fourth pose
    EXPECT_EQ(on_links.col(first), workload.poses[3].col(2));
    EXPECT_EQ(on_links.col(first + 3), workload.poses[3].col(3));
    const Eigen::Vector3d third = (2 * workload.poses[3].col(2) + workload.poses[3].col(3)) / 3;
    EXPECT_LT((on_links.col(first + 1) - third).norm(), 1e-15);

    const Eigen::Matrix3Xd on_obstacles = obstacle_test_points(workload);
    ASSERT_EQ(on_obstacles.cols(), 5 * 7);
    for (Eigen::Index k = 0; k < on_obstacles.cols(); ++k) {
      const Ellipsoid& shape = workload.obstacles[static_cast<std::size_t>(k / 7)];
      EXPECT_LT(std::abs(shape.level(on_obstacles.col(k))), 1e-13);
      if (dimension == 2) {
        EXPECT_EQ(on_obstacles(2, k), 0);
      }
    }
  }
}

TEST(TestPoints, ASingleOneIsInTheMiddleOfALink) {
  const Workload workload = workload_of(2, {.link = 1, .obstacle = 1});
  const Eigen::Vector3d middle = 0.5 * (workload.poses[0].col(0) + workload.poses[0].col(1));
  EXPECT_LT((link_test_points(workload).col(0) - middle).norm(), 1e-15);
}

using Answers = std::vector<std::vector<std::uint8_t>>;  // of all pairs, a pose each

Answers answers(std::string_view name, const Workload& workload) {
  const std::unique_ptr<Detection> detection = detector_named(name).prepare(workload);
  Answers all(workload.poses.size(),
              std::vector<std::uint8_t>(static_cast<std::size_t>(workload.size.pairs())));
  for (std::size_t p = 0; p < all.size(); ++p) detection->detect(static_cast<int>(p), all[p]);
  return all;
}

/// Against the definition: the least distance in long double, point by point.
TEST(TestPoints, DecideByTheLeastDistance) {
  for (const int dimension : {2, 3}) {
    const Workload workload = workload_of(dimension, {.link = 9, .obstacle = 35});
    const Eigen::Matrix3Xd on_links = link_test_points(workload);
    const Eigen::Matrix3Xd on_obstacles = obstacle_test_points(workload);
    const Answers found = answers("test_points", workload);
    int hits = 0;
    for (Eigen::Index p = 0; p < 40; ++p) {
      for (Eigen::Index j = 0; j < 5; ++j) {
        for (Eigen::Index i = 0; i < 6; ++i) {
          long double least = std::numeric_limits<long double>::infinity();
          for (Eigen::Index a = 0; a < 9; ++a) {
            for (Eigen::Index b = 0; b < 35; ++b) {
              const Eigen::Matrix<long double, 3, 1> apart =
                  on_links.col((p * 6 + i) * 9 + a).cast<long double>() -
                  on_obstacles.col(j * 35 + b).cast<long double>();
              least = std::min(least, apart.norm());
            }
          }
          const bool hit = found[static_cast<std::size_t>(p)][static_cast<std::size_t>(j * 6 + i)];
          EXPECT_EQ(hit, least < 0.02L) << least;
          hits += hit;
        }
      }
    }
    EXPECT_GT(hits, 20);
  }
}

TEST(TestPoints, VectorizedGiveTheSameAnswers) {
  for (const int dimension : {2, 3}) {
    for (const baselines::TestPointCounts counts : {baselines::TestPointCounts{1, 1},
                                                    {2, 1},
                                                    {1, 3},
                                                    {5, 7},
                                                    {15, 40},
                                                    {40, 15},
                                                    {31, 129}}) {
      const Workload workload = workload_of(dimension, counts);
      EXPECT_EQ(answers("test_points", workload), answers("test_points_vectorized", workload))
          << counts.link << " x " << counts.obstacle;
    }
  }
}

/// Against the definition in long double: semi-axes and rotation.
TEST(TestPoints, InsideTestAddsLinksWhoseMiddleIsInside) {
  for (const int dimension : {2, 3}) {
    const Workload workload = workload_of(dimension, {.link = 5, .obstacle = 30});
    const Answers points = answers("test_points", workload);
    const Answers found = answers("test_points_inside", workload);
    int added = 0;
    for (std::size_t p = 0; p < found.size(); ++p) {
      for (std::size_t pair = 0; pair < found[p].size(); ++pair) {
        const auto i = static_cast<Eigen::Index>(pair % 6);
        const Ellipsoid& shape = workload.obstacles[pair / 6];
        const Eigen::Vector3d middle =
            0.5 * (workload.poses[p].col(i) + workload.poses[p].col(i + 1));
        const Eigen::Matrix<long double, 3, 1> turned =
            (shape.rotation().transpose() * (middle - shape.center())).cast<long double>();
        long double squares = 0;
        for (int k = 0; k < dimension; ++k) {
          const long double part = turned(k) / static_cast<long double>(shape.semi_axes()(k));
          squares += part * part;
        }
        EXPECT_EQ(found[p][pair], points[p][pair] | (squares <= 1)) << static_cast<double>(squares);
        added += found[p][pair] - points[p][pair];
      }
    }
    EXPECT_GT(added, 20);
  }
}

/// Evenly spaced points of 2^k intervals contain those of 2^(k-1): what few points see, more see too.
TEST(TestPoints, MoreOfThemSeeWhatFewerSawAndMissLess) {
  int before = -1;
  Answers fewer;
  for (const baselines::TestPointCounts counts :
       {baselines::TestPointCounts{2, 4}, {3, 8}, {5, 16}, {9, 32}, {17, 64}, {33, 128}}) {
    const Answers more = answers("test_points", workload_of(2, counts));
    int hits = 0;
    for (std::size_t p = 0; p < more.size(); ++p) {
      for (std::size_t pair = 0; pair < more[p].size(); ++pair) {
        hits += more[p][pair];
        if (!fewer.empty()) {
          EXPECT_GE(more[p][pair], fewer[p][pair]);
        }
      }
    }
    EXPECT_GT(hits, before);
    before = hits;
    fewer = more;
  }
}

/// A test point pair is never closer than link and obstacle are.
TEST(TestPoints, CallNothingAHitThatIsFurtherAwayThanTheMargin) {
  for (const int dimension : {2, 3}) {
    const Workload workload = workload_of(dimension, {.link = 40, .obstacle = 400}, 42);
    const Answers found = answers("test_points_vectorized", workload);
    int alarms = 0;
    for (std::size_t p = 0; p < found.size(); ++p) {
      for (std::size_t pair = 0; pair < found[p].size(); ++pair) {
        const auto i = static_cast<Eigen::Index>(pair % 6);
        const SegmentDistance truth = exact_distance(
            workload.poses[p].col(i), workload.poses[p].col(i + 1), workload.obstacles[pair / 6]);
        if (truth.distance > kTestPointMargin) {
          EXPECT_EQ(found[p][pair], 0);
        }
        alarms += truth.distance > 0 && found[p][pair] != 0;
      }
    }
    EXPECT_GT(alarms, 20) << "within the margin there are some";
  }
}

}  // namespace
}  // namespace bqsa::harness
