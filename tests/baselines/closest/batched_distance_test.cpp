#include "baselines/closest/batched_distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "baselines/closest/segment_ellipsoid_distance.hpp"
#include "support/allocation_guard.hpp"
#include "support/distance_oracle.hpp"
#include "support/instruction_sets.hpp"
#include "support/sampling.hpp"
#include "support/segment_cases.hpp"

namespace bqsa::baselines {
namespace {

using Eigen::Vector3d;
using test_support::AllocationGuard;
using test_support::DistanceOracle;
using test_support::Generator;
using test_support::random_direction;
using test_support::random_ellipsoid;
using test_support::random_segment_case;
using test_support::random_vector;
using test_support::SegmentCase;
using test_support::with_all_instruction_sets;

constexpr double kPromised = 1e-9;  // [m]

/// As many segments, by rows, as ellipsoids.
struct Batch {
  explicit Batch(const std::vector<SegmentCase>& cases)
      : starts(cases.size(), 3),
        ends(cases.size(), 3),
        ellipsoids(shapes_of(cases)),
        table(static_cast<int>(cases.size()), ellipsoids) {
    for (std::size_t k = 0; k < cases.size(); ++k) {
      starts.row(static_cast<Eigen::Index>(k)) = cases[k].a;
      ends.row(static_cast<Eigen::Index>(k)) = cases[k].b;
    }
  }

  static std::vector<Ellipsoid> shapes_of(const std::vector<SegmentCase>& cases) {
    std::vector<Ellipsoid> shapes;
    for (const SegmentCase& c : cases) shapes.push_back(c.shape);
    return shapes;
  }

  static PointArrays arrays(const Eigen::MatrixX3d& points) {
    return {points.col(0).data(), points.col(1).data(), points.col(2).data(),
            static_cast<int>(points.rows())};
  }

  void ask() { segment_distances(arrays(starts), arrays(ends), ellipsoids, table); }

  double distance(int i, int j) const { return table.distance[table.index(i, j)]; }
  double t(int i, int j) const { return table.t[table.index(i, j)]; }

  Eigen::MatrixX3d starts, ends;
  EllipsoidBlocks ellipsoids;
  DistanceTable table;
};

/// A distance, and t of a point that is as near.
void expect_answer(const SegmentCase& c, double distance, double t, double expected,
                   double tolerance) {
  EXPECT_NEAR(distance, expected, tolerance);
  EXPECT_EQ(distance == 0, expected == 0);
  EXPECT_GE(t, 0);
  EXPECT_LE(t, 1);
  const Vector3d at_t = c.a + t * (c.b - c.a);
  EXPECT_LT(segment_distance(at_t, at_t, c.shape).distance, expected + tolerance);
}

/// Every segment against the shape that it was made for, with which it is degenerate in some way, and
/// against one that has nothing to do with it.
TEST(BatchedDistance, IsThatOfTheOracle) {
  Generator generator(1);
  int meeting = 0, free = 0;
  for (int trial = 0; trial < 160; ++trial) {
    SCOPED_TRACE(trial);
    std::vector<SegmentCase> cases;
    const int count = 1 + trial % 45;
    for (int k = 0; k < count; ++k) {
      cases.push_back(random_segment_case(generator, 64 * trial + k));
    }
    std::vector<double> expected;  // or not a number: touches to within rounding
    for (int i = 0; i < count; ++i) {
      for (const int j : {i, (i + 1) % count}) {
        const SegmentCase& c = cases[static_cast<std::size_t>(i)];
        const Ellipsoid& shape = cases[static_cast<std::size_t>(j)].shape;
        const DistanceOracle oracle(c.a, c.b, shape);
        const auto level = static_cast<double>(oracle.least_norm() - 1);
        const bool touching = std::abs(level) * shape.semi_axes().minCoeff() < 1e-14;
        expected.push_back(touching ? std::nan("") : static_cast<double>(oracle.distance()));
        ++(level < 0 ? meeting : free);
      }
    }
    Batch batch(cases);
    with_all_instruction_sets([&] {
      batch.ask();
      auto next = expected.begin();
      for (int i = 0; i < count; ++i) {
        for (const int j : {i, (i + 1) % count}) {
          const double truth = *next++;
          if (std::isnan(truth)) continue;
          const SegmentCase& c = cases[static_cast<std::size_t>(i)];
          expect_answer({c.a, c.b, cases[static_cast<std::size_t>(j)].shape}, batch.distance(i, j),
                        batch.t(i, j), truth, kPromised);
        }
      }
    });
  }
  EXPECT_GT(meeting, 200);
  EXPECT_GT(free, 4000);
}

/// Eggs, as arms meet them.
TEST(BatchedDistance, NamesTheParameterToo) {
  Generator generator(2);
  int between = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<SegmentCase> cases;
    for (int k = 0; k < 16; ++k) {
      const Vector3d a = random_vector<3>(generator, 1);
      cases.push_back(
          {a, a + 0.4 * random_direction<3>(generator), random_ellipsoid<3>(generator, 0.1, 0.5)});
    }
    Batch batch(cases);
    with_all_instruction_sets([&] {
      batch.ask();
      for (int i = 0; i < 16; ++i) {
        for (int j = 0; j < 16; ++j) {
          const SegmentCase& c = cases[static_cast<std::size_t>(i)];
          const SegmentDistance expected =
              segment_distance(c.a, c.b, cases[static_cast<std::size_t>(j)].shape);
          ASSERT_NEAR(batch.distance(i, j), expected.distance, kPromised) << trial;
          ASSERT_NEAR(batch.t(i, j), expected.s, kPromised) << trial;
          between += expected.s > 0 && expected.s < 1;
        }
      }
    });
  }
  EXPECT_GT(between, 30000);
}

/// Products of squared semi-axes or lengths that are no numbers any more, and what is far away.
TEST(BatchedDistance, IsRightWhereTheCommonLoopIsLost) {
  const Eigen::Matrix3d R = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).matrix();
  std::vector<SegmentCase> cases;
  for (const double thin : {1e-20, 1e-30, 1e-60}) {
    for (const Vector3d& axes :
         {Vector3d(thin, thin, 1), Vector3d(1, thin, 0.5), Vector3d(thin, thin, thin)}) {
      const Ellipsoid shape(Vector3d::Zero(), axes, R);
      cases.push_back({Vector3d(0.3, 1, 0.2), Vector3d(-0.7, 0.6, 0.1), shape});
      cases.push_back({Vector3d(-1, 0, 0), Vector3d(1, 0, 0), shape});
    }
  }
  const Ellipsoid egg(Vector3d(0.1, 0.2, 0.3), Vector3d(0.3, 0.2, 0.1), R);
  cases.push_back({Vector3d(1, 1, 1), Vector3d(1 + 1e-15, 1, 1), egg});
  cases.push_back({Vector3d(1, 0, 0), Vector3d(1, 1e-170, 0), egg});
  cases.push_back({Vector3d(1, 0, 0), Vector3d(1, 1e-300, 0), egg});
  cases.push_back({Vector3d(1e6, 0, 0), Vector3d(1e6, 1, 0), egg});
  cases.push_back({Vector3d(-1e6, 3, 0), Vector3d(1e6, 1, 0), egg});
  Batch batch(cases);
  with_all_instruction_sets([&] {
    batch.ask();
    for (int i = 0; i < static_cast<int>(cases.size()); ++i) {
      SCOPED_TRACE(i);
      const SegmentCase& c = cases[static_cast<std::size_t>(i)];
      expect_answer(c, batch.distance(i, i), batch.t(i, i),
                    segment_distance(c.a, c.b, c.shape).distance,
                    std::max(kPromised, 1e-10 * c.size()));
    }
  });
}

/// In numbers that have no rounding errors, whatever the order of operations.
TEST(BatchedDistance, TouchingIsMeeting) {
  constexpr double kGap = std::numeric_limits<double>::epsilon();
  std::vector<SegmentCase> touching, beside;
  for (int k = 0; k < 4; ++k) {
    const double x = 0.5 * k;
    const Ellipsoid shape(Vector3d(x, 0, 0), Vector3d(0.25, 0.5, 0.125));
    const Vector3d top(x, 0.5, 0), front(x, 0, 0.125), y(0, kGap, 0), z(0, 0, kGap);
    const Vector3d before(0.25, 0, 0), behind(0.75, 0, 0);
    touching.push_back({top - before, top + behind, shape});
    beside.push_back({top - before + y, top + behind + y, shape});
    touching.push_back({top - before, top, shape});
    beside.push_back({top - before + y, top + y, shape});
    touching.push_back({front, front, shape});
    beside.push_back({front + z, front + z, shape});
  }
  Batch meeting(touching), free(beside);
  with_all_instruction_sets([&] {
    meeting.ask();
    free.ask();
    for (int k = 0; k < static_cast<int>(touching.size()); ++k) {
      EXPECT_EQ(meeting.distance(k, k), 0) << k;
      EXPECT_GT(free.distance(k, k), 0) << k;
      EXPECT_LT(free.distance(k, k), 1e-15) << k;
    }
  });
}

TEST(BatchedDistance, FollowsAnEllipsoidThatMovesWithoutAllocating) {
  Generator generator(3);
  std::vector<SegmentCase> cases;
  for (int k = 0; k < 19; ++k) cases.push_back(random_segment_case(generator, 8 * k));
  Batch batch(cases);
  batch.ask();
  const Ellipsoid moved = random_ellipsoid<3>(generator, 0.1, 0.5);
  const AllocationGuard guard;
  for (const int j : {0, 7, 8, 18}) {
    batch.ellipsoids.set(j, moved);
    cases[static_cast<std::size_t>(j)].shape = moved;
  }
  batch.ask();
  if (test_support::kCountsAllocations) {
    EXPECT_EQ(guard.allocations(), 0u);
  }
  for (int i = 0; i < 19; ++i) {
    for (int j = 0; j < 19; ++j) {
      const SegmentCase& c = cases[static_cast<std::size_t>(i)];
      const Ellipsoid& shape = cases[static_cast<std::size_t>(j)].shape;
      EXPECT_NEAR(batch.distance(i, j), segment_distance(c.a, c.b, shape).distance, kPromised);
    }
  }
}

TEST(BatchedDistance, OfNothingIsNothing) {
  Batch batch({});
  batch.ask();
  EXPECT_TRUE(batch.table.distance.empty());
  EXPECT_EQ(batch.ellipsoids.blocks(), 0);
}

}  // namespace
}  // namespace bqsa::baselines
