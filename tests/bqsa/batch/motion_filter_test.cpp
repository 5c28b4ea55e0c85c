// What the motion filter calls certainly free, against dense sampling by the exact distance.

#include "bqsa/batch/motion_filter.hpp"

#include <gtest/gtest.h>

#include "bqsa/geometry/nearest_plane.hpp"
#include "bqsa/geometry/segment_test.hpp"
#include "support/allocation_guard.hpp"
#include "support/instruction_sets.hpp"
#include "support/sampling.hpp"

namespace bqsa {
namespace {

using test_support::Generator;
using test_support::uniform;
using test_support::with_all_instruction_sets;

SerialChain spatial_arm() {
  ChainDescription chain;
  for (int j = 0; j < 7; ++j) {
    chain.rows.push_back(
        {.a = j % 2 == 0 ? 0.25 : 0.0, .alpha = j % 2 == 0 ? 1.3 : -1.1, .d = 0.1});
  }
  return SerialChain(chain);
}

JointVector random_angles(int joints, double largest, Generator& generator) {
  JointVector q(joints);
  for (double& angle : q) angle = uniform(generator, -largest, largest);
  return q;
}

/// Up to 0.4 m beside the end of some link of that posture.
Ellipsoid near_the_way(const SerialChain& chain, const JointVector& q, Generator& generator) {
  ChainPose pose;
  chain.forward(q, pose);
  const int point = 1 + static_cast<int>(uniform(generator, 0, chain.points() - 1));
  const Eigen::Vector3d center =
      pose.p_WO.col(point) +
      uniform(generator, 0, 0.4) * test_support::random_direction<3>(generator);
  if (chain.dimension() == 3) {
    const Ellipsoid any = test_support::random_ellipsoid<3>(generator, 0.02, 0.2);
    return {center, any.semi_axes(), any.rotation()};
  }
  const Ellipse any = test_support::random_ellipsoid<2>(generator, 0.02, 0.2);
  return embedded(Ellipse(center.head<2>(), any.semi_axes(), any.rotation()));
}

/// Least distance of the links to the shape in any of many postures along the motion [m].
double least_distance(const SerialChain& chain, const Ellipsoid& shape, const JointVector& q0,
                      const JointVector& q1) {
  constexpr int kPostures = 100;
  double least = std::numeric_limits<double>::infinity();
  ChainPose pose;
  for (int k = 0; k <= kPostures; ++k) {
    chain.forward(q0 + k * (q1 - q0) / kPostures, pose);
    for (const Link& link : chain.links()) {
      const Eigen::Vector3d p1 = pose.p_WO.col(link.start), p2 = pose.p_WO.col(link.end);
      if (hits(polar_form<3>(shape, p1, p2))) return -1;
      least = std::min(least, nearest_plane<3>(shape, p1, p2).distance);
    }
  }
  return least;
}

void expect_only_free_motions(const SerialChain& chain) {
  constexpr double kClearance = 0.01;
  Generator generator(1);
  int found = 0, not_free = 0;
  for (int number = 0; number < 400; ++number) {
    const JointVector q0 = random_angles(chain.joints(), 3, generator);
    const double step = test_support::log_uniform(generator, 1e-4, 1);
    const JointVector q1 = q0 + random_angles(chain.joints(), step, generator);
    const Ellipsoid shape = near_the_way(chain, q0 + 0.37 * (q1 - q0), generator);
    MotionFilter filter(chain, std::span(&shape, 1), kClearance);
    const double least = least_distance(chain, shape, q0, q1);
    with_all_instruction_sets([&] {
      const bool free = filter.certainly_free(q0, q1);
      not_free += least < kClearance;
      found += free;
      if (least < kClearance) {
        EXPECT_FALSE(free) << "motion " << number;
      } else if (step < 0.01 && least > 0.1) {
        EXPECT_TRUE(free) << "motion " << number;
      }
    });
  }
  const int sets = static_cast<int>(instruction_sets().size());
  EXPECT_GT(found, 100 * sets);
  EXPECT_GT(not_free, 50 * sets);
}

TEST(MotionFilter, OnlyFreeMotionsAreCertainlyFree) {
  expect_only_free_motions(spatial_arm());
  expect_only_free_motions(SerialChain(planar_chain({0.3, 0.3, 0.3, 0.2})));
}

/// A thin obstacle across the way, not met at the ends nor in the middle.
TEST(MotionFilter, DoesNotTunnel) {
  const SerialChain chain(planar_chain({1.0}));
  Generator generator(2);
  for (int number = 0; number < 300; ++number) {
    const double start = uniform(generator, -3, 3);
    const double step = test_support::log_uniform(generator, 1e-3, 1);
    const double across = start + uniform(generator, 0, 1) * step;
    const Eigen::Vector2d center(0.8 * std::cos(across), 0.8 * std::sin(across));
    const Ellipsoid needle = embedded(rotated_ellipse(center, {0.1, 1e-6}, across));
    MotionFilter filter(chain, std::span(&needle, 1), 0);
    with_all_instruction_sets([&] {
      EXPECT_FALSE(filter.certainly_free(JointVector::Constant(1, start),
                                         JointVector::Constant(1, start + step)));
    });
  }
}

TEST(MotionFilter, SaysNothingOfVeryLongMotionsAndDoesNotAllocate) {
  const SerialChain chain(planar_chain({1.0}));
  MotionFilter filter(chain, {}, 0);
  const JointVector zero = JointVector::Zero(1);
  const test_support::AllocationGuard guard;
  EXPECT_TRUE(filter.certainly_free(zero, JointVector::Constant(1, 1)));
  EXPECT_FALSE(filter.certainly_free(zero, JointVector::Constant(1, 10)));
  EXPECT_FALSE(filter.certainly_free(zero, JointVector::Constant(1, std::nan(""))));
  EXPECT_EQ(guard.allocations(), 0U);
}

TEST(MotionFilter, ANegativeClearanceIsRefused) {
  const SerialChain chain(planar_chain({1.0}));
  EXPECT_THROW(MotionFilter(chain, {}, -1), std::invalid_argument);
}

}  // namespace
}  // namespace bqsa
