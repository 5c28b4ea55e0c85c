// What the planners take for free, against dense sampling.
#include "baselines/planning/motion_check.hpp"

#include <gtest/gtest.h>

#include "support/prismatic_arms.hpp"
#include "support/replay.hpp"

namespace bqsa::baselines {
namespace {

using test_support::Generator;
using test_support::uniform;

/// Of arms of which some joints slide, among obstacles of which every second one moves.
TEST(MotionCheck, WhatItTakesForFreeIsFreeWhereJointsSlide) {
  Generator generator(1);
  int free = 0, sampled_free = 0, hitting = 0;
  for (int trial = 0; trial < 800; ++trial) {
    const int joints = 2 + trial % 5;
    Problem problem{.name = "random",
                    .chain = SerialChain(test_support::random_prismatic_arm(generator, joints)),
                    .ticks = 1,
                    .dt = 0.1,
                    .link_radius = trial % 2 == 0 ? 0.01 : 0};
    for (int j = 0; j < 3; ++j) {
      const Ellipsoid shape = test_support::random_ellipsoid<3>(generator, 0.02, 0.5);
      Obstacle obstacle{"obstacle", shape};
      if (j == 1) {
        const Eigen::Vector3d way = test_support::random_vector<3>(generator, 0.1);
        obstacle.motion = {shape, {shape.center() + way, shape.semi_axes(), shape.rotation()}};
      }
      problem.obstacles.push_back(obstacle);
    }
    const auto draw = [&](double half_width) -> JointVector {
      return JointVector::NullaryExpr(
          joints, [&](Eigen::Index) { return uniform(generator, -half_width, half_width); });
    };
    const JointVector q0 = draw(1), q1 = q0 + draw(0.5);
    WorkCounters counters;
    MotionCheck check;
    check.assign(problem, counters);
    const bool is_free = check.is_free(0, q0, problem.dt, q1);
    const bool hits =
        !test_support::sampled_hits(problem, {q0, q1}, 200, problem.link_radius).empty();
    EXPECT_FALSE(is_free && hits) << trial;
    free += is_free;
    sampled_free += !hits;
    hitting += hits;
  }
  EXPECT_GT(free, sampled_free * 9 / 10);
  EXPECT_GT(free, 50);
  EXPECT_GT(hitting, 50);
}

TEST(MotionCheck, AsksOfEachLinkItsOwnRadius) {
  Problem problem{.name = "post", .chain = SerialChain(planar_chain({1, 1})), .link_radius = 0.2};
  problem.obstacles = {{"post", Ellipsoid({1.5, 0.2, 0}, Eigen::Vector3d::Constant(0.1))}};
  const auto is_free = [&problem](const std::vector<double>& radii) {
    problem.link_radii = radii;
    WorkCounters counters;
    MotionCheck check;
    check.assign(problem, counters);
    return check.is_free(0, JointVector::Zero(2));
  };
  EXPECT_TRUE(is_free({0.2, 0.09}));
  EXPECT_FALSE(is_free({0.2, 0.11}));
  EXPECT_FALSE(is_free({}));
}

}  // namespace
}  // namespace bqsa::baselines
