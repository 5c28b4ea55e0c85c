#include "baselines/closest/batched_test_points.hpp"

#include <gtest/gtest.h>

#include "support/allocation_guard.hpp"
#include "support/instruction_sets.hpp"
#include "support/sampling.hpp"

namespace bqsa::baselines {
namespace {

using Lanes = PointBlocks::Lanes;
using test_support::AllocationGuard;
using test_support::Generator;
using test_support::random_vector;
using test_support::with_all_instruction_sets;

struct Counts {
  int groups, count;                // side by side
  int others_groups, others_count;  // compared with them
};

constexpr Counts kCounts[] = {{1, 1, 1, 1},  {3, 4, 9, 3},    {8, 8, 8, 8},   {9, 7, 7, 5},
                              {17, 9, 2, 4}, {5, 129, 3, 31}, {1, 1, 13, 31}, {64, 3, 7, 1}};

Eigen::MatrixX3d random_points(Generator& generator, int count, int dimension) {
  Eigen::MatrixX3d points(count, 3);
  for (Eigen::Index k = 0; k < count; ++k) points.row(k) = random_vector<3>(generator, 1);
  // In the plane z must not matter.
  if (dimension == 2) points.col(2).array() *= 1e6;
  return points;
}

/// Rounded after every operation: no compiler may fuse what is kept in memory.
double least_by_scalar_code(const Eigen::MatrixX3d& from, const Eigen::MatrixX3d& to,
                            int dimension) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index a = 0; a < from.rows(); ++a) {
    for (Eigen::Index b = 0; b < to.rows(); ++b) {
      volatile double sum = 0;
      for (int axis = 0; axis < dimension; ++axis) {
        const volatile double apart = from(a, axis) - to(b, axis);
        const volatile double square = apart * apart;
        sum = sum + square;
      }
      const double squared = sum;
      least = std::min(least, squared);
    }
  }
  return least;
}

double least_by_definition(const Eigen::MatrixX3d& from, const Eigen::MatrixX3d& to,
                           int dimension) {
  long double least = std::numeric_limits<long double>::infinity();
  for (Eigen::Index a = 0; a < from.rows(); ++a) {
    for (Eigen::Index b = 0; b < to.rows(); ++b) {
      long double squared = 0;
      for (int axis = 0; axis < dimension; ++axis) {
        const long double apart =
            static_cast<long double>(from(a, axis)) - static_cast<long double>(to(b, axis));
        squared += apart * apart;
      }
      least = std::min(least, squared);
    }
  }
  return static_cast<double>(least);
}

class BatchedTestPoints : public testing::TestWithParam<Lanes> {};
INSTANTIATE_TEST_SUITE_P(, BatchedTestPoints, testing::Values(Lanes::kPoints, Lanes::kGroups),
                         [](const testing::TestParamInfo<Lanes>& lanes) {
                           return lanes.param == Lanes::kPoints ? "Points" : "Groups";
                         });

TEST_P(BatchedTestPoints, FindTheLeastOfAllPairs) {
  Generator generator(1);
  for (const int dimension : {2, 3}) {
    for (const Counts& size : kCounts) {
      PointBlocks blocks(GetParam(), dimension, size.groups, size.count);
      std::vector<Eigen::MatrixX3d> groups;
      for (int g = 0; g < size.groups; ++g) {
        groups.push_back(random_points(generator, size.count, dimension));
        blocks.set(g, groups.back());
      }
      const Eigen::MatrixX3d points =
          random_points(generator, size.others_groups * size.others_count, dimension);
      const PointGroups others = {{points.col(0).data(), points.col(1).data(), points.col(2).data(),
                                   static_cast<int>(points.rows())},
                                  size.others_count};
      with_all_instruction_sets([&] {
        std::vector<double> least(least_needed(blocks, others), -1), as_scalar = least;
        const AllocationGuard guard;
        least_squared_distances(blocks, others, Rounding::kFused, least);
        least_squared_distances(blocks, others, Rounding::kAsScalar, as_scalar);
        if (test_support::kCountsAllocations) {
          EXPECT_EQ(guard.allocations(), 0u);
        }
        for (int g = 0; g < size.groups; ++g) {
          for (int i = 0; i < size.others_groups; ++i) {
            const Eigen::MatrixX3d& group = groups[static_cast<std::size_t>(g)];
            const Eigen::MatrixX3d other =
                points.middleRows(i * size.others_count, size.others_count);
            const double expected = least_by_definition(group, other, dimension);
            const double found = least[blocks.index(g, i, size.others_groups)];
            EXPECT_NEAR(found, expected, 6e-16 * expected)
                << dimension << "-D, group " << g << " of " << size.groups << ", " << i;
            EXPECT_EQ(as_scalar[blocks.index(g, i, size.others_groups)],
                      least_by_scalar_code(group, other, dimension));
          }
        }
      });
    }
  }
}

TEST_P(BatchedTestPoints, FollowAGroupThatMoves) {
  Generator generator(2);
  for (const int moved : {0, 7, 8, 10}) {
    PointBlocks blocks(GetParam(), 3, 11, 5);
    for (int g = 0; g < 11; ++g) blocks.set(g, Eigen::MatrixX3d::Constant(5, 3, 10 + g));
    const Eigen::MatrixX3d there = random_points(generator, 5, 3);
    blocks.set(moved, there);
    const PointGroups others = {{there.col(0).data(), there.col(1).data(), there.col(2).data(), 5},
                                5};
    std::vector<double> least(least_needed(blocks, others));
    least_squared_distances(blocks, others, Rounding::kFused, least);
    for (int g = 0; g < 11; ++g) {
      EXPECT_EQ(least[blocks.index(g, 0, 1)] == 0, g == moved) << g << ' ' << moved;
    }
  }
}

/// The choice that measurements of small and large numbers suggest.
TEST(WorkAPair, IsLeastWhereVectorsAreFull) {
  EXPECT_LT(work_a_pair(Lanes::kGroups, 64, 4, 3), work_a_pair(Lanes::kPoints, 64, 4, 3));
  EXPECT_LT(work_a_pair(Lanes::kPoints, 3, 40, 15), work_a_pair(Lanes::kGroups, 3, 40, 15));
  EXPECT_LT(work_a_pair(Lanes::kGroups, 9, 3, 4), work_a_pair(Lanes::kGroups, 3, 4, 3));
  EXPECT_LT(work_a_pair(Lanes::kGroups, 8, 8, 3), work_a_pair(Lanes::kPoints, 8, 8, 3))
      << "all vectors are full, but lanes must be compared";
  EXPECT_EQ(work_a_pair(Lanes::kPoints, 5, 9, 8), work_a_pair(Lanes::kPoints, 5, 16, 8));
  EXPECT_EQ(9 * work_a_pair(Lanes::kGroups, 9, 3, 4), 16 * work_a_pair(Lanes::kGroups, 16, 3, 4));
}

}  // namespace
}  // namespace bqsa::baselines
