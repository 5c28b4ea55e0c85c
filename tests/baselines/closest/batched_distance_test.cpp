#include "baselines/closest/batched_distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "baselines/closest/segment_ellipsoid_distance.hpp"
#include "support/allocation_guard.hpp"
#include "support/distance_oracle.hpp"
#include "support/instruction_set_test.hpp"
#include "support/sampling.hpp"
#include "support/segment_cases.hpp"

namespace bqsa::baselines {
namespace {

using Eigen::Vector3d;
using test_support::AllocationGuard;
using test_support::DistanceOracle;
using test_support::Generator;
using test_support::log_uniform;
using test_support::random_direction;
using test_support::random_ellipsoid;
using test_support::random_rotation;
using test_support::random_segment_case;
using test_support::random_vector;
using test_support::SegmentCase;
using test_support::uniform;

constexpr double kPromised = 1e-9;  // [m]

class BatchedDistance : public test_support::InstructionSetTest {};
INSTANTIATE_TEST_SUITE_P(All, BatchedDistance, test_support::all_instruction_sets(),
                         test_support::instruction_set_name);

/// Segments by columns, and their distances to all shapes.
struct Batch {
  Batch(const Eigen::MatrixX3d& a, const Eigen::MatrixX3d& b, std::span<const Ellipsoid> shapes)
      : starts(a), ends(b), ellipsoids(shapes), table(static_cast<int>(a.rows()), ellipsoids) {
    ask();
  }

  void ask() { segment_distances(arrays(starts), arrays(ends), ellipsoids, table); }

  static PointArrays arrays(const Eigen::MatrixX3d& points) {
    return {points.col(0).data(), points.col(1).data(), points.col(2).data(),
            static_cast<int>(points.rows())};
  }

  double distance(int i, int j) const { return table.distance[table.index(i, j)]; }
  double t(int i, int j) const { return table.t[table.index(i, j)]; }

  Eigen::MatrixX3d starts, ends;
  EllipsoidBlocks ellipsoids;
  DistanceTable table;
};

Batch batch_of(const std::vector<SegmentCase>& cases) {
  const auto n = static_cast<Eigen::Index>(cases.size());
  Eigen::MatrixX3d a(n, 3), b(n, 3);
  std::vector<Ellipsoid> shapes;
  for (Eigen::Index k = 0; k < n; ++k) {
    const SegmentCase& c = cases[static_cast<std::size_t>(k)];
    a.row(k) = c.a;
    b.row(k) = c.b;
    shapes.push_back(c.shape);
  }
  return {a, b, shapes};
}

/// Of the segment and the point at t.
void expect_distance_and_t(const Vector3d& a, const Vector3d& b, const Ellipsoid& shape,
                           double distance, double t, int trial) {
  const DistanceOracle oracle(a, b, shape);
  const auto expected = static_cast<double>(oracle.distance());
  ASSERT_NEAR(distance, expected, kPromised) << trial;
  ASSERT_EQ(distance == 0, oracle.least_norm() <= 1) << trial;
  ASSERT_GE(t, 0) << trial;
  ASSERT_LE(t, 1) << trial;
  const DistanceOracle at_t(a + t * (b - a), a + t * (b - a), shape);
  ASSERT_LT(static_cast<double>(at_t.distance()), expected + kPromised) << trial;
}

/// Every segment against the shape that it was made for, with which it is degenerate in some way, and
/// against one that has nothing to do with it.
TEST_P(BatchedDistance, IsThatOfTheOracle) {
  Generator generator(1);
  int meeting = 0, free = 0;
  for (int trial = 0; trial < 160; ++trial) {
    std::vector<SegmentCase> cases;
    const int count = 1 + trial % 45;
    for (int k = 0; k < count; ++k) {
      cases.push_back(random_segment_case(generator, 64 * trial + k));
    }
    const Batch batch = batch_of(cases);
    for (int i = 0; i < count; ++i) {
      const SegmentCase& c = cases[static_cast<std::size_t>(i)];
      for (const int j : {i, (i + 1) % count}) {
        const Ellipsoid& shape = cases[static_cast<std::size_t>(j)].shape;
        const double level =
            std::abs(static_cast<double>(DistanceOracle(c.a, c.b, shape).least_norm()) - 1);
        if (level * shape.semi_axes().minCoeff() < 1e-14) continue;  // touches to rounding
        expect_distance_and_t(c.a, c.b, shape, batch.distance(i, j), batch.t(i, j), 64 * trial + i);
        ++(batch.distance(i, j) == 0 ? meeting : free);
      }
    }
  }
  EXPECT_GT(meeting, 300);
  EXPECT_GT(free, 4000);
}

/// Eggs as arms meet them: what the common loop alone has to reach.
TEST_P(BatchedDistance, NamesTheParameterToo) {
  Generator generator(2);
  int between = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<SegmentCase> cases;
    for (int k = 0; k < 16; ++k) {
      const Vector3d a = random_vector<3>(generator, 1);
      cases.push_back(
          {a, a + 0.4 * random_direction<3>(generator), random_ellipsoid<3>(generator, 0.1, 0.5)});
    }
    const Batch batch = batch_of(cases);
    for (int i = 0; i < 16; ++i) {
      for (int j = 0; j < 16; ++j) {
        const SegmentDistance expected = segment_distance(cases[static_cast<std::size_t>(i)].a,
                                                          cases[static_cast<std::size_t>(i)].b,
                                                          cases[static_cast<std::size_t>(j)].shape);
        ASSERT_NEAR(batch.distance(i, j), expected.distance, 2e-10) << trial;
        ASSERT_NEAR(batch.t(i, j), expected.s, 1e-9) << trial;
        between += expected.s > 0 && expected.s < 1;
      }
    }
  }
  EXPECT_GT(between, 20000);
}

/// What one loop cannot settle: products of squared semi-axes that are no numbers any more, lengths
/// whose squares are none, and what is far away.
TEST_P(BatchedDistance, IsRightWhereTheCommonLoopIsLost) {
  const Eigen::Matrix3d R = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).matrix();
  std::vector<SegmentCase> cases;
  for (const double thin : {1e-30, 1e-60, 1e-100}) {
    for (const Vector3d& axes :
         {Vector3d(thin, thin, 1), Vector3d(1, thin, 0.5), Vector3d(thin, thin, thin)}) {
      cases.push_back(
          {Vector3d(0.3, 1, 0.2), Vector3d(-0.7, 0.6, 0.1), {Vector3d::Zero(), axes, R}});
      cases.push_back({Vector3d(-1, 0, 0), Vector3d(1, 0, 0), {Vector3d::Zero(), axes, R}});
    }
  }
  const Ellipsoid egg(Vector3d(0.1, 0.2, 0.3), Vector3d(0.3, 0.2, 0.1), R);
  cases.push_back({Vector3d(1, 1, 1), Vector3d(1 + 1e-15, 1, 1), egg});
  cases.push_back({Vector3d(1, 0, 0), Vector3d(1, 1e-170, 0), egg});
  cases.push_back({Vector3d(1, 0, 0), Vector3d(1, 1e-300, 0), egg});
  cases.push_back({Vector3d(1e6, 0, 0), Vector3d(1e6, 1, 0), egg});
  cases.push_back({Vector3d(-1e6, 3, 0), Vector3d(1e6, 1, 0), egg});
  const Batch batch = batch_of(cases);
  for (int i = 0; i < static_cast<int>(cases.size()); ++i) {
    const SegmentCase& c = cases[static_cast<std::size_t>(i)];
    const SegmentDistance expected = segment_distance(c.a, c.b, c.shape);
    ASSERT_NEAR(batch.distance(i, i), expected.distance, kPromised * std::max(1.0, 0.1 * c.size()))
        << i;
    ASSERT_EQ(batch.distance(i, i) == 0, expected.distance == 0) << i;
    const Vector3d at_t = c.a + batch.t(i, i) * (c.b - c.a);
    ASSERT_NEAR(segment_distance(at_t, at_t, c.shape).distance, expected.distance,
                kPromised * std::max(1.0, 0.1 * c.size()))
        << i;
  }
}

/// In numbers that have no rounding errors, in any order of operations.
TEST_P(BatchedDistance, TouchingIsMeeting) {
  std::vector<Ellipsoid> shapes;
  for (int k = 0; k < 11; ++k) {
    shapes.emplace_back(Vector3d(0.5 * k, 0, 0), Vector3d(0.25, 0.5, 0.125));
  }
  Eigen::MatrixX3d a(11, 3), b(11, 3), beside_a(11, 3), beside_b(11, 3);
  for (int k = 0; k < 11; ++k) {
    const double x = 0.5 * k;
    a.row(k) << x - 0.25, 0.5, 0;  // tangent
    b.row(k) << x + 0.75, 0.5, 0;
    if (k % 3 == 1) b.row(k) << x, 0.5, 0;  // ends there
    if (k % 3 == 2) {
      a.row(k) << x, 0, 0.125;  // a point
      b.row(k) = a.row(k);
    }
    const double gap = k % 3 == 2 ? 0 : std::numeric_limits<double>::epsilon();
    const double gap_z = k % 3 == 2 ? std::numeric_limits<double>::epsilon() : 0;
    beside_a.row(k) = a.row(k) + Eigen::RowVector3d(0, gap, gap_z);
    beside_b.row(k) = b.row(k) + Eigen::RowVector3d(0, gap, gap_z);
  }
  const Batch touching(a, b, shapes);
  const Batch beside(beside_a, beside_b, shapes);
  for (int k = 0; k < 11; ++k) {
    EXPECT_EQ(touching.distance(k, k), 0) << k;
    EXPECT_GT(beside.distance(k, k), 0) << k;
    EXPECT_LT(beside.distance(k, k), 1e-15) << k;
  }
}

TEST_P(BatchedDistance, FollowsAnEllipsoidThatMovesWithoutAllocating) {
  Generator generator(3);
  std::vector<SegmentCase> cases;
  for (int k = 0; k < 19; ++k) cases.push_back(random_segment_case(generator, 8 * k));
  Batch batch = batch_of(cases);
  const Ellipsoid moved = random_ellipsoid<3>(generator, 0.1, 0.5);
  const AllocationGuard guard;
  for (const int j : {0, 7, 8, 18}) batch.ellipsoids.set(j, moved);
  batch.ask();
  if (test_support::kCountsAllocations) {
    EXPECT_EQ(guard.allocations(), 0u);
  }
  for (int i = 0; i < 19; ++i) {
    for (int j = 0; j < 19; ++j) {
      const bool moves = j == 0 || j == 7 || j == 8 || j == 18;
      const SegmentCase& c = cases[static_cast<std::size_t>(i)];
      const Ellipsoid& shape = moves ? moved : cases[static_cast<std::size_t>(j)].shape;
      EXPECT_NEAR(batch.distance(i, j), segment_distance(c.a, c.b, shape).distance, kPromised);
    }
  }
}

TEST(BatchedDistanceOfNothing, IsNothing) {
  const Batch no_segments(Eigen::MatrixX3d(0, 3), Eigen::MatrixX3d(0, 3),
                          std::vector<Ellipsoid>{{Vector3d::Zero(), Vector3d::Ones()}});
  EXPECT_TRUE(no_segments.table.distance.empty());
  const Batch no_shapes(Eigen::MatrixX3d::Zero(2, 3), Eigen::MatrixX3d::Ones(2, 3), {});
  EXPECT_TRUE(no_shapes.table.distance.empty());
}

}  // namespace
}  // namespace bqsa::baselines
