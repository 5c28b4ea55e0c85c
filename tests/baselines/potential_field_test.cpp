#include "baselines/potential_field.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "baselines/closest/exact_distance_search.hpp"
#include "support/near_obstacles.hpp"

namespace bqsa::baselines {
namespace {

using test_support::central_differences;
using test_support::Generator;
using test_support::near_obstacles;
using test_support::oracle_distance;
using test_support::tip_jacobian;

PotentialField potential_field(const PotentialFieldSettings& settings) {
  return {settings, std::make_unique<ExactDistanceSearch>()};
}

JointVector step_of(const PotentialFieldSettings& settings, const Problem& problem) {
  PotentialField method = potential_field(settings);
  return test_support::first_step(method, problem);
}

TEST(RepulsiveForce, IsTheFormulaWrittenOut) {
  const PotentialFieldSettings settings{.influence = 0.1, .floor = 0.02};
  EXPECT_NEAR(repulsive_force(0.05, settings), (20 - 10) / 0.0025, 1e-9);
  EXPECT_EQ(repulsive_force(0.1, settings), 0);
  EXPECT_EQ(repulsive_force(0.2, settings), 0);
  const double at_the_floor = (50 - 10) / 0.0004;
  for (const double clearance : {0.02, 0.01, 0.0, -0.3}) {
    EXPECT_NEAR(repulsive_force(clearance, settings), at_the_floor, 1e-9) << clearance;
  }
}

/// Sum of (1/d - 1/d0)² / 2 over all links and obstacles, distances by the oracle.
double potential(const Problem& problem, const JointVector& q, double influence) {
  double sum = 0;
  for (const Link& link : problem.chain.links()) {
    for (const Obstacle& obstacle : problem.obstacles) {
      const double d = oracle_distance(problem, q, link, obstacle);
      if (d < influence) sum += std::pow(1 / d - 1 / influence, 2) / 2;
    }
  }
  return sum;
}

/// With the tip at rest the step is -eta dt grad U, projected or not; grad U by central differences,
/// the projector I - Jᵀ (J Jᵀ)⁻¹ J written out.
TEST(PotentialField, DescendsThePotentialOfAllPairs) {
  Generator generator(1);
  double largest = 0;
  for (int trial = 0; trial < 24; ++trial) {
    const Problem problem = near_obstacles(generator, trial, 0.2);
    PotentialFieldSettings settings{
        .influence = 0.3, .gain = 1e-5, .floor = 0.001, .exempt_length = 0};
    const auto U = [&](const JointVector& q) { return potential(problem, q, settings.influence); };
    const JointVector expected =
        -settings.gain * problem.dt * central_differences(U, problem.start, 1e-6);
    const Eigen::MatrixXd J = tip_jacobian(problem, problem.start);
    const JointVector projected =
        expected - J.transpose() * (J * J.transpose()).inverse() * (J * expected);

    EXPECT_LT((step_of(settings, problem) - projected).norm(), 1e-5 * expected.norm()) << trial;
    settings.where = RepulsionSpace::kTask;
    EXPECT_LT((step_of(settings, problem) - expected).norm(), 1e-5 * expected.norm()) << trial;
    largest = std::max(largest, expected.norm());
  }
  EXPECT_GT(largest, 1e-3);
  EXPECT_LT(largest, 0.2);  // no step was limited
}

TEST(PotentialField, LeavesTheTipToFirstOrderOnlyOnTheSelfMotions) {
  Generator generator(2);
  int drifting = 0;
  for (int trial = 0; trial < 24; ++trial) {
    const Problem problem = near_obstacles(generator, trial, 0.2);
    const TaskJacobian J = tip_jacobian(problem, problem.start);
    PotentialFieldSettings settings{.influence = 0.3, .gain = 1e-5, .exempt_length = 0};
    const JointVector still = step_of(settings, problem);
    EXPECT_LT((J * still).norm(), 1e-12) << trial;
    settings.where = RepulsionSpace::kTask;
    drifting += (J * step_of(settings, problem)).norm() > 1e-6;
  }
  EXPECT_GT(drifting, 12);
}

TEST(PotentialField, OfEachObstacleTheClosestLinkOnlyIfAskedTo) {
  Generator generator(3);
  int different = 0;
  for (int trial = 0; trial < 24; ++trial) {
    Problem problem = near_obstacles(generator, trial, 0.2);
    const PotentialFieldSettings all{.influence = 0.3, .exempt_length = 0};
    PotentialFieldSettings closest = all;
    closest.all_pairs = false;
    different += (step_of(closest, problem) - step_of(all, problem)).norm() > 1e-9;
  }
  EXPECT_GT(different, 12);
}

/// A ball whose surface is `clearance` away from the middle of link 3 of the planar arm, whose tip
/// rests.
Problem ball_beside_the_third_link(double clearance) {
  Problem problem = test_support::planar_7r(400);
  ChainPose pose;
  problem.chain.forward(problem.start, pose);
  const Eigen::Vector3d tip = pose.tip();
  problem.desired_tip = [tip](double) { return tip; };
  const Eigen::Vector3d along = (pose.p_WO.col(3) - pose.p_WO.col(2)).normalized();
  const Eigen::Vector3d center =
      0.5 * (pose.p_WO.col(2) + pose.p_WO.col(3)) + 0.1 * Eigen::Vector3d(-along.y(), along.x(), 0);
  const double radius = 0.1 - clearance;
  problem.obstacles = {{"ball", Ellipsoid(center, {radius, radius, radius})}};
  return problem;
}

TEST(PotentialField, PushesNoHarderBelowTheFloorAndInContact) {
  const PotentialFieldSettings settings{
      .influence = 0.05, .gain = 1e-7, .floor = 0.02, .all_pairs = false};
  const JointVector at_the_floor = step_of(settings, ball_beside_the_third_link(0.02));
  EXPECT_GT(at_the_floor.norm(), 1e-5);
  for (const double clearance : {0.01, 1e-9, -0.01, -0.08}) {
    const JointVector step = step_of(settings, ball_beside_the_third_link(clearance));
    EXPECT_LT((step - at_the_floor).norm(), 1e-9) << clearance;
  }
  EXPECT_LT(step_of(settings, ball_beside_the_third_link(0.03)).norm(), at_the_floor.norm());
  EXPECT_LT(step_of(settings, ball_beside_the_third_link(0.06)).norm(), 1e-15);
}

TEST(PotentialField, RadiusAndMarginCountAsNearer) {
  const Problem thin = ball_beside_the_third_link(0.02);
  Problem thick = ball_beside_the_third_link(0.03);
  Problem careful = thick;
  thick.link_radius = 0.01;
  careful.margin = 0.01;
  const PotentialFieldSettings settings{
      .influence = 0.05, .gain = 1e-7, .floor = 0.001, .all_pairs = false};
  const JointVector expected = step_of(settings, thin);
  EXPECT_LT((step_of(settings, thick) - expected).norm(), 1e-12);
  EXPECT_LT((step_of(settings, careful) - expected).norm(), 1e-12);
}

TEST(PotentialField, RefusesAFloorBeyondTheInfluence) {
  ParameterValues values(potential_field_method().parameters);
  values.set("influence", "0.001");
  values.set("floor", "0.02");
  EXPECT_THROW(potential_field_method().make(values), ParameterError);
}

}  // namespace
}  // namespace bqsa::baselines
