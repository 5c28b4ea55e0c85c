#include "baselines/null_space_avoidance.hpp"

#include <gtest/gtest.h>

#include "baselines/closest/exact_distance_search.hpp"
#include "baselines/closest/segment_ellipsoid_distance.hpp"
#include "support/closest_point_scenes.hpp"

namespace bqsa::baselines {
namespace {

using test_support::Generator;
using test_support::random_closest_point_scene;
using test_support::random_vector;

TEST(AvoidanceLaws, AreTheFormulasWrittenOut) {
  const AvoidanceSettings settings{.influence = 0.06,
                                   .full_distance = 0.02,
                                   .escape_velocity = 0.2,
                                   .regularization = 1e-3,
                                   .gradient_gain = 40};
  EXPECT_EQ(influence_gain(0.06, settings), 0);
  EXPECT_EQ(influence_gain(0.07, settings), 0);
  EXPECT_NEAR(influence_gain(0.03, settings), 0.75, 1e-15);
  EXPECT_EQ(influence_gain(0.01, settings), 1);

  const JointVector j0 = Eigen::Vector3d(0.3, -0.2, 0.1), projected = Eigen::Vector3d(0.1, 0, 0.2);
  const JointVector tracking = Eigen::Vector3d(1, 2, 3);
  // alpha = 0.75; alpha v - j0 tracking = 0.15 - 0.2; j0 P j0 + delta = 0.05 + 0.001.
  const JointVector escape = self_motion_away(0.03, 0.2, j0, projected, tracking, settings);
  EXPECT_LT((escape - 0.75 * (0.15 - 0.2) / 0.051 * projected).norm(), 1e-15);
  AvoidanceSettings gradient = settings;
  gradient.law = AvoidanceLaw::kGradientProjection;
  const JointVector climb = self_motion_away(0.03, 0.2, j0, projected, tracking, gradient);
  EXPECT_LT((climb - 40 * 0.03 * projected).norm(), 1e-15);
}

/// A scene of one resting obstacle that is near one link, not at its end, and a tip that is to rest.
Problem one_near_link(Generator& generator, int trial) {
  for (;;) {
    Problem problem = random_closest_point_scene(generator, trial);
    problem.obstacles = {problem.obstacles[0]};
    problem.obstacles[0].motion.clear();
    problem.link_radius = 0;
    problem.link_radii.clear();
    ExactDistanceSearch search;
    WorkCounters work;
    search.assign(problem, 0, work);
    ChainPose pose;
    problem.chain.forward(problem.start, pose);
    std::vector<ClosestPoint> found;
    search.search(pose, 0.2, found);
    if (found.size() == 1 && found[0].distance > 0.01 && found[0].link > 1 && found[0].s < 0.9) {
      const Eigen::Vector3d tip = pose.tip();
      problem.desired_tip = [tip](double) { return tip; };
      return problem;
    }
  }
}

JointVector step_of(const AvoidanceSettings& settings, const Problem& problem) {
  NullSpaceAvoidance method(settings, std::make_unique<ExactDistanceSearch>());
  method.prepare(problem);
  StepOutput output;
  method.step({.tick = 1,
               .t = problem.dt,
               .p_WT_desired = problem.desired_tip(problem.dt),
               .q = problem.start},
              output);
  EXPECT_EQ(output.state, TickState::kUnclaimed);
  EXPECT_EQ(output.clamp_count, 1);
  return output.q - problem.start;
}

double least_distance(const Problem& problem, const JointVector& q) {
  ChainPose pose;
  problem.chain.forward(q, pose);
  double least = 1e9;
  for (const Link& link : problem.chain.links()) {
    least = std::min(least, segment_distance(pose.p_WO.col(link.start), pose.p_WO.col(link.end),
                                             problem.obstacles[0].shape)
                                .distance);
  }
  return least;
}

/// With the tip at rest the step is mu dt P grad H; grad H by central differences.
TEST(NullSpaceAvoidance, GradientProjectionClimbsTheProjectedGradientOfH) {
  Generator generator(2);
  int climbing = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Problem problem = one_near_link(generator, trial);
    const AvoidanceSettings settings{.law = AvoidanceLaw::kGradientProjection,
                                     .influence = 0.2,
                                     .gradient_gain = 1,
                                     .exempt_length = 0};
    const auto H = [&](const JointVector& q) {
      return -0.5 * std::pow(settings.influence - least_distance(problem, q), 2);
    };
    JointVector gradient(7);
    for (int j = 0; j < 7; ++j) {
      JointVector ahead = problem.start, behind = problem.start;
      ahead(j) += 1e-6;
      behind(j) -= 1e-6;
      gradient(j) = (H(ahead) - H(behind)) / 2e-6;
    }
    ChainPose pose;
    TaskJacobian J;
    problem.chain.forward(problem.start, pose);
    problem.chain.jacobian(pose, problem.chain.points() - 1, J);
    SelfMotions self_motions;
    self_motions.assign(J);
    const JointVector expected = problem.dt * self_motions.project(gradient);
    const JointVector found = step_of(settings, problem);
    EXPECT_LT((found - expected).norm(), 1e-8 * problem.dt + 1e-4 * expected.norm()) << trial;
    climbing += expected.norm() > 1e-6;
  }
  EXPECT_GT(climbing, 40);
}

/// The rate at which the distance grows is alpha² v_0 j0 P j0 / (j0 P j0 + delta), whatever the arm.
TEST(NullSpaceAvoidance, MaciejewskiKleinEscapesAtTheWantedSpeed) {
  Generator generator(3);
  int fast = 0;
  for (int trial = 0; trial < 60; ++trial) {
    Problem problem = one_near_link(generator, trial);
    problem.dt = 1e-6;
    const AvoidanceSettings settings{.influence = 0.2,
                                     .full_distance = 0.05,
                                     .escape_velocity = 0.1,
                                     .regularization = 1e-9,
                                     .exempt_length = 0};
    const double before = least_distance(problem, problem.start);
    const JointVector step = step_of(settings, problem);
    const double speed = (least_distance(problem, problem.start + step) - before) / problem.dt;
    const double alpha = influence_gain(before, settings);
    EXPECT_LT(speed, 1.001 * alpha * alpha * 0.1) << trial;
    fast += speed > 0.99 * alpha * alpha * 0.1;
  }
  EXPECT_GT(fast, 30);  // where the arm can move the link without its tip
}

TEST(NullSpaceAvoidance, RadiusAndMarginCountAsNearer) {
  Generator generator(4);
  for (const AvoidanceLaw law :
       {AvoidanceLaw::kMaciejewskiKlein, AvoidanceLaw::kGradientProjection}) {
    const Problem thin = one_near_link(generator, 1);
    Problem thick = thin;
    thick.link_radius = 0.03;
    Problem careful = thin;
    careful.margin = 0.03;
    const AvoidanceSettings settings{.law = law,
                                     .influence = 0.22,
                                     .full_distance = 0.05,
                                     .gradient_gain = 1,
                                     .exempt_length = 0};
    AvoidanceSettings wide = settings;
    wide.influence += 0.03;
    wide.full_distance += 0.03;
    const JointVector expected = step_of(wide, thin);
    EXPECT_LT((step_of(settings, thick) - expected).norm(), 1e-12);
    EXPECT_LT((step_of(settings, careful) - expected).norm(), 1e-12);
    EXPECT_GT((step_of(settings, thin) - expected).norm(), 1e-9);
  }
}

TEST(NullSpaceAvoidance, VelocityOfATurningObstacleIsThatOfItsPoints) {
  Generator generator(5);
  for (int trial = 0; trial < 60; ++trial) {
    const Problem problem = random_closest_point_scene(generator, 3 * trial);
    for (const Obstacle& obstacle : problem.obstacles) {
      ASSERT_TRUE(obstacle.moves());
      const Eigen::Vector3d unit = test_support::random_direction<3>(generator);
      for (int tick = 1; tick <= problem.ticks; ++tick) {
        const Eigen::Vector3d before = test_support::surface_point<3>(obstacle.at(tick - 1), unit);
        const Eigen::Vector3d after = test_support::surface_point<3>(obstacle.at(tick), unit);
        const Eigen::Vector3d found = velocity_at(obstacle, tick, problem.dt, before);
        EXPECT_LT((found - (after - before) / problem.dt).norm(), 1e-12);
      }
    }
  }
  EXPECT_EQ(velocity_at({"rests", Ellipsoid({0, 0, 0}, {1, 1, 1})}, 1, 0.1, {1, 2, 3}),
            Eigen::Vector3d::Zero());
}

TEST(NullSpaceAvoidance, TheStepIsScaledUntilItFitsAndNoFurther) {
  Generator generator(6);
  int scaled = 0, impossible = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    Problem problem = test_support::planar_7r();
    if (trial % 2 == 0) {
      problem.limits.lower = JointVector::Constant(7, -1.05);
      problem.limits.upper = JointVector::Constant(7, 1.05);
    }
    const JointVector q = random_vector<7>(generator, 1);
    const JointVector tracking = (trial % 5 == 0 ? 0.3 : 0.02) * random_vector<7>(generator, 1);
    const JointVector avoidance = random_vector<7>(generator, 1);
    const double part = fitting_part(problem, q, tracking, avoidance);
    const auto fits = [&](double k) {
      return forbidden_step(problem, q, q + tracking + k * avoidance) == Infeasible::kNot;
    };
    if (part < 0) {
      for (const double k : {0.0, 0.1, 0.25, 0.5, 0.8, 1.0}) EXPECT_FALSE(fits(k)) << trial;
      ++impossible;
      continue;
    }
    EXPECT_LE(part, 1) << trial;
    EXPECT_TRUE(fits(part * (1 - 1e-12))) << trial;
    if (part < 1) {
      EXPECT_FALSE(fits(part + 1e-9)) << trial;
      ++scaled;
    }
  }
  EXPECT_GT(scaled, 1000);
  EXPECT_GT(impossible, 50);
}

}  // namespace
}  // namespace bqsa::baselines
