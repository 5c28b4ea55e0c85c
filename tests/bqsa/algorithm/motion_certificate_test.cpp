#include "bqsa/motion_certificate.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "support/allocation_guard.hpp"
#include "support/prismatic_arms.hpp"
#include "support/replay.hpp"
#include "support/sampling.hpp"

namespace bqsa {
namespace {

using test_support::Generator;
using test_support::log_uniform;
using test_support::random_direction;
using test_support::random_ellipsoid;
using test_support::random_vector;
using test_support::uniform;

/// A random arm of either kind among three obstacles.
Problem random_problem(Generator& generator, bool planar) {
  ChainDescription arm;
  if (planar) {
    arm = planar_chain({0.5, 0.4, 0.3, 0.4});
  } else {
    arm.convention =
        uniform(generator, 0, 1) < 0.5 ? DhConvention::kStandard : DhConvention::kModified;
    for (int j = 0; j < 6; ++j) {
      arm.rows.push_back({uniform(generator, 0, 0.3), uniform(generator, -2, 2),
                          uniform(generator, 0, 0.3), uniform(generator, -1, 1)});
    }
    arm.p_LT << 0.05, 0, 0.1;
  }
  Problem problem{.name = "random", .chain = SerialChain(arm)};
  for (int j = 0; j < 3; ++j) {
    const Ellipsoid shape = planar ? embedded(random_ellipsoid<2>(generator, 1e-3, 0.5))
                                   : random_ellipsoid<3>(generator, 1e-3, 0.5);
    problem.obstacles.push_back({std::to_string(j), shape});
  }
  return problem;
}

JointVector random_joints(Generator& generator, int joints, double half_width) {
  return JointVector::NullaryExpr(
      joints, [&](Eigen::Index) { return uniform(generator, -half_width, half_width); });
}

/// The same shape `way` further on, its axes turned by `angle` about `axis`.
Ellipsoid moved(const Ellipsoid& shape, const Eigen::Vector3d& way, double angle = 0,
                const Eigen::Vector3d& axis = Eigen::Vector3d::UnitZ()) {
  return {shape.center() + way, shape.semi_axes(),
          Eigen::AngleAxisd(angle, axis).toRotationMatrix() * shape.rotation()};
}

MotionCertificate::Result certify(Problem problem, const JointVector& q0, const JointVector& q1,
                                  WorkCounters& counters, double clearance = 0, int tick = 1) {
  MotionCertificate certificate;
  problem.link_radius = clearance;
  certificate.assign(problem, counters);
  return certificate.certify(tick, q0, q1);
}

TEST(MotionCertificate, AMotionThatStartsInsideTheMarginMustNotComeCloser) {
  Problem problem{.name = "inside", .chain = SerialChain(planar_chain({1.0}))};
  problem.obstacles = {{"post", Ellipsoid({0.5, 0.1, 0}, Eigen::Vector3d::Constant(0.09))}};
  problem.margin = 0.02;
  // At angle 0 the link is 10 mm from the post, and at -0.05 it is 34 mm away.
  const auto certified = [&problem](double from, double to) {
    WorkCounters counters;
    MotionCertificate certificate;
    certificate.assign(problem, counters);
    const auto at = [](double angle) { return JointVector(JointVector::Constant(1, angle)); };
    return certificate.certify(1, at(from), at(to)).certified;
  };
  EXPECT_TRUE(certified(0, -0.01)) << "away";
  EXPECT_FALSE(certified(0, 0.001)) << "closer";
  EXPECT_FALSE(certified(-0.05, -0.01)) << "into the margin";
  EXPECT_TRUE(certified(-0.01, -0.05)) << "out of the margin";
  problem.link_radius = 0.011;
  EXPECT_FALSE(certified(0, -0.01)) << "the radius is no margin";
}

/// @param random_scene  function: the problem of a trial
template <typename Scene>
void expect_what_is_certified_to_be_free(const Scene& random_scene, int trials) {
  Generator generator(2);
  WorkCounters counters;
  int certified = 0, sampled_free = 0, refused_hits = 0;
  for (int trial = 0; trial < trials; ++trial) {
    Problem problem = random_scene(generator, trial);
    const double clearance = trial % 3 == 0 ? 0.01 : 0;
    problem.link_radius = clearance;
    MotionCertificate certificate;
    certificate.assign(problem, counters);
    const int n = problem.chain.joints();
    const JointVector q0 = random_joints(generator, n, 2);
    const JointVector q1 = q0 + random_joints(generator, n, log_uniform(generator, 1e-3, 1));
    const MotionCertificate::Result result = certificate.certify(1, q0, q1);
    const auto hits = test_support::sampled_hits(problem, {q0, q1}, 100, clearance);
    if (hits.empty()) ++sampled_free;
    if (result.certified) {
      ++certified;
      EXPECT_TRUE(hits.empty()) << "trial " << trial << ": certified, but link "
                                << hits.begin()->first << " hits";
    } else {
      if (!hits.empty()) ++refused_hits;
      EXPECT_GT(result.link, 0);
      EXPECT_GE(result.obstacle, 0);
    }
  }
  // Not by refusing everything: nearly all motions that look free are certified.
  EXPECT_GT(certified, sampled_free * 97 / 100);
  EXPECT_GT(certified, 100);
  EXPECT_GT(refused_hits, 50);
}

TEST(MotionCertificate, WhatItCertifiesKeepsItsClearanceInDenseSamples) {
  expect_what_is_certified_to_be_free(
      [](Generator& generator, int trial) { return random_problem(generator, trial % 2 == 0); },
      600);
}

TEST(MotionCertificate, WhatItCertifiesKeepsItsClearanceWhereJointsSlide) {
  const auto sliding = [](Generator& generator, int trial) {
    Problem problem = random_problem(generator, false);
    problem.chain = SerialChain(test_support::random_prismatic_arm(generator, 2 + trial % 5));
    return problem;
  };
  expect_what_is_certified_to_be_free(sliding, 2200);
}

/// Link by link what it says is what it says of arms of that link's radius, whatever the others have.
TEST(MotionCertificate, AsksOfEachLinkItsOwnRadius) {
  Generator generator(11);
  WorkCounters counters;
  int certified = 0, refused = 0, differing = 0;
  for (int trial = 0; trial < 400; ++trial) {
    Problem problem = random_problem(generator, trial % 2 == 0);
    problem.margin = trial % 3 == 0 ? 0.005 : 0;
    const std::size_t links = problem.chain.links().size();
    problem.link_radius = 0.03;
    for (std::size_t i = 0; i < links; ++i) {
      problem.link_radii.push_back(i == 1 ? 0.03 : uniform(generator, 0, 0.03));
    }
    const int n = problem.chain.joints();
    const JointVector q0 = random_joints(generator, n, 2);
    const JointVector q1 = q0 + random_joints(generator, n, 0.1);
    MotionCertificate own, all_thick;
    own.assign(problem, counters);
    const MotionCertificate::Result result = own.certify(1, q0, q1);
    const bool hits =
        !test_support::sampled_hits(problem, {q0, q1}, 30, problem.link_radii).empty();
    EXPECT_FALSE(result.certified && hits) << trial;
    certified += result.certified;
    refused += hits;
    Problem thick = problem;
    thick.link_radii.clear();
    all_thick.assign(thick, counters);
    differing += result.certified && !all_thick.certify(1, q0, q1).certified;
    thick.link_radii.assign(links, 0.03);
    own.assign(thick, counters);
    EXPECT_EQ(own.certify(1, q0, q1).certified, all_thick.certify(1, q0, q1).certified) << trial;
  }
  EXPECT_GT(certified, 100);
  EXPECT_GT(refused, 50);
  EXPECT_GT(differing, 3);
}

/// Between its ends the link dips to y = 0, by the Coriolis acceleration alone, and hits the ball.
TEST(MotionCertificate, RefusesASlideThatDipsIntoABall) {
  Problem problem{.name = "dip", .chain = SerialChain(test_support::swinging_slide())};
  problem.obstacles = {{"ball", Ellipsoid({0, -0.05, 0.15}, Eigen::Vector3d::Constant(0.06))}};
  WorkCounters counters;
  const JointVector q0 = Eigen::Vector2d(-0.1, -0.5), q1 = Eigen::Vector2d(0.1, 0.5);
  EXPECT_FALSE(certify(problem, q0, q1, counters).certified);
  problem.obstacles = {{"ball", Ellipsoid({0, -0.05, 0.15}, Eigen::Vector3d::Constant(0.04))}};
  EXPECT_TRUE(certify(problem, q0, q1, counters).certified);
}

TEST(MotionCertificate, RefusesAMotionThatTunnelsThroughAThinSheet) {
  Problem problem{.name = "sheet", .chain = SerialChain(planar_chain({1.0}))};
  problem.obstacles = {{"sheet", Ellipsoid({0.9, 0, 0}, {0.3, 1e-4, 0.3})}};
  WorkCounters counters;
  MotionCertificate certificate;
  certificate.assign(problem, counters);
  JointVector below(1), above(1), further(1);
  below << -0.02;
  above << 0.02;
  further << 0.3;
  EXPECT_TRUE(test_support::sampled_hits(problem, {below, above}, 0).empty())
      << "both ends must be free, or the test shows nothing";
  const MotionCertificate::Result result = certificate.certify(1, below, above);
  EXPECT_FALSE(result.certified);
  EXPECT_EQ(result.link, 1);
  EXPECT_EQ(result.obstacle, 0);
  EXPECT_TRUE(certificate.certify(1, above, further).certified);
}

TEST(MotionCertificate, SeesTheArcBeyondTheChord) {
  // The tip swings through the ball; the hull of both end positions stays clear of it.
  Problem problem{.name = "arc", .chain = SerialChain(planar_chain({1.0}))};
  problem.obstacles = {{"ball", Ellipsoid({0.9, 0, 0}, {0.05, 0.05, 0.05})}};
  WorkCounters counters;
  MotionCertificate certificate;
  certificate.assign(problem, counters);
  const double eighth = std::numbers::pi / 4;
  EXPECT_FALSE(
      certificate.certify(1, JointVector::Constant(1, -eighth), JointVector::Constant(1, eighth))
          .certified);
}

TEST(MotionCertificate, CertifiesAWithdrawalFromContact) {
  Problem problem{.name = "withdrawal", .chain = SerialChain(planar_chain({1.0}))};
  problem.obstacles = {{"ball", Ellipsoid({0.6, 0.05 + 1e-6, 0}, {0.05, 0.05, 0.05})}};
  WorkCounters counters;
  MotionCertificate certificate;
  certificate.assign(problem, counters);
  const JointVector near = JointVector::Zero(1), away = JointVector::Constant(1, -0.2);
  EXPECT_TRUE(certificate.certify(1, near, away).certified);
  EXPECT_TRUE(certificate.certify(1, away, near).certified);
  EXPECT_FALSE(certificate.certify(1, away, JointVector::Constant(1, 1e-4)).certified);
}

TEST(MotionCertificate, PassesTheEdgeOfASheetWithItsClearance) {
  // The link slides past the edge, 21 mm away: the planes of the quadratic see a millimetre.
  Problem problem{.name = "edge", .chain = SerialChain(planar_chain({1.0}))};
  problem.obstacles = {{"sheet", Ellipsoid({1.121, 0.002, 0}, {0.1, 1e-4, 0.1})}};
  const JointVector low = JointVector::Constant(1, -0.05), high = JointVector::Constant(1, 0.05);
  WorkCounters counters;
  EXPECT_TRUE(certify(problem, low, high, counters, 0.0209).certified);
  EXPECT_GT(counters.distance_queries, 0U);
  EXPECT_FALSE(certify(problem, low, high, counters, 0.0211).certified);
  counters = {};
  EXPECT_TRUE(certify(problem, low, high, counters, 0).certified);
  EXPECT_EQ(counters.distance_queries, 0U);
}

TEST(MovingObstacles, WhatIsCertifiedKeepsItsClearanceInDenseSamples) {
  Generator generator(3);
  WorkCounters counters;
  int certified = 0, sampled_free = 0, refused_hits = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const bool planar = trial % 2 == 0;
    Problem problem = random_problem(generator, planar);
    const double largest = log_uniform(generator, 1e-2, 1);
    for (Obstacle& obstacle : problem.obstacles) {
      Eigen::Vector3d way = random_vector<3>(generator, largest);
      Eigen::Vector3d axis = random_direction<3>(generator);
      if (planar) {
        way.z() = 0;
        axis = Eigen::Vector3d::UnitZ();
      }
      const double angle = uniform(generator, -3, 3) * largest;
      obstacle.motion = {obstacle.shape, moved(obstacle.shape, way, angle, axis)};
    }
    const double clearance = trial % 3 == 0 ? 0.01 : 0;
    const int n = problem.chain.joints();
    const JointVector q0 = random_joints(generator, n, 2);
    const JointVector q1 = q0 + random_joints(generator, n, log_uniform(generator, 1e-3, 1));
    const bool proven = certify(problem, q0, q1, counters, clearance).certified;
    const auto hits = test_support::sampled_hits(problem, {q0, q1}, 100, clearance);
    sampled_free += hits.empty();
    certified += proven;
    refused_hits += !proven && !hits.empty();
    EXPECT_FALSE(proven && !hits.empty())
        << "trial " << trial << ": certified, but link " << hits.begin()->first << " hits";
  }
  EXPECT_GT(certified, sampled_free * 95 / 100);
  EXPECT_GT(certified, 100);
  EXPECT_GT(refused_hits, 50);
}

TEST(MovingObstacles, ABulletThatCrossesALinkBetweenTwoTicksIsRefused) {
  Problem problem{.name = "bullet", .chain = SerialChain(planar_chain({1.0}))};
  const Ellipsoid before({0.5, -1, 0}, {0.01, 0.02, 0.02});
  problem.obstacles = {{"bullet", before, {before, moved(before, {0, 2, 0})}}};
  const JointVector q = JointVector::Zero(1);
  EXPECT_TRUE(test_support::sampled_hits(problem, {q, q}, 0).empty())
      << "both ends must be free, or the test shows nothing";
  WorkCounters counters;
  const MotionCertificate::Result result = certify(problem, q, q, counters);
  EXPECT_FALSE(result.certified);
  EXPECT_EQ(result.link, 1);
  EXPECT_EQ(result.obstacle, 0);
  problem.obstacles[0].motion[1] = moved(before, {0.7, 2, 0});  // crosses beyond the link's end
  problem.obstacles[0].motion[0] = problem.obstacles[0].shape = moved(before, {0.7, 0, 0});
  EXPECT_TRUE(certify(problem, q, q, counters).certified);
}

TEST(MovingObstacles, NeedlesThatSpinPastARestingLinkAreMetOnTheirTrueWay) {
  // Seen from a needle that turns while it passes, the link's way bends around its tip: without the
  // term 2 w |v| of the bound, some of these needles would be certified although they hit.
  Generator generator(77);
  WorkCounters counters;
  int certified = 0, sampled_free = 0, hit = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    Problem problem{.name = "needle",
                    .chain = SerialChain(planar_chain({log_uniform(generator, 1e-3, 0.3)}))};
    const double half_length = log_uniform(generator, 0.1, 2);
    const double thickness = log_uniform(generator, 1e-3, 3e-2);
    // Beside the arm's base at some time between the ticks.
    const double s = uniform(generator, 0.2, 0.8);
    const double direction = uniform(generator, -3, 3);
    const Eigen::Vector2d along(std::cos(direction), std::sin(direction));
    const Eigen::Vector2d across(-along.y(), along.x());
    const Eigen::Vector2d center = uniform(generator, -1, 1) * half_length * along +
                                   log_uniform(generator, 1e-3, 0.3) * across;
    const double angle = uniform(generator, -2.5, 2.5);
    const Eigen::Vector2d way = random_vector<2>(generator, log_uniform(generator, 0.01, 2));
    const auto needle = [&](double time) {
      return embedded(rotated_ellipse(center + (time - s) * way, {half_length, thickness},
                                      direction + (time - s) * angle));
    };
    problem.obstacles = {{"needle", needle(0), {needle(0), needle(1)}}};
    const JointVector q = random_joints(generator, 1, 3);
    const bool proven = certify(problem, q, q, counters).certified;
    const bool free = test_support::sampled_hits(problem, {q, q}, 300).empty();
    certified += proven;
    sampled_free += free;
    hit += !free;
    ASSERT_TRUE(free || !proven) << "trial " << trial << ": certified, but hits";
  }
  EXPECT_GT(certified, sampled_free * 90 / 100);
  EXPECT_GT(certified, 300);
  EXPECT_GT(hit, 1000);
}

TEST(MovingObstacles, OnlyTheRelativeMotionCounts) {
  // An arm that turns about z by w, and an obstacle with its centre on that axis that turns by -w:
  // the same relative motion. Both turning by w is rest.
  ChainDescription arm;
  arm.rows = {{0.3, 0.3, 0.5, 0}, {0.4, 1.2, 0.1, 0.3}, {0.3, -0.5, 0.2, 0.2}};
  Problem at_rest{.name = "relative", .chain = SerialChain(arm)};
  Problem moving = at_rest;
  Generator generator(4);
  WorkCounters counters;
  int certified = 0, refused = 0, free_at_start = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    Eigen::Vector3d semi_axes(log_uniform(generator, 1e-3, 1), log_uniform(generator, 1e-3, 1),
                              log_uniform(generator, 1e-3, 1));
    const Ellipsoid shape({0, 0, uniform(generator, 0, 2)}, semi_axes,
                          test_support::random_rotation<3>(generator));
    const double w = uniform(generator, -3, 3);
    const auto turned = [&](double angle) { return moved(shape, Eigen::Vector3d::Zero(), angle); };
    at_rest.obstacles = {{"o", shape}};
    moving.obstacles = {{"o", shape, {shape, turned(-w), shape, turned(w)}}};
    const JointVector q0 = random_joints(generator, 3, 3);
    JointVector q1 = q0;
    q1(0) += w;
    const bool arm_turns = certify(at_rest, q0, q1, counters).certified;
    EXPECT_EQ(certify(moving, q0, q0, counters, 0, 1).certified, arm_turns) << "trial " << trial;
    ++(arm_turns ? certified : refused);
    const bool both_rest = certify(at_rest, q0, q0, counters).certified;
    EXPECT_EQ(certify(moving, q0, q1, counters, 0, 3).certified, both_rest) << "trial " << trial;
    free_at_start += both_rest;
  }
  EXPECT_GT(certified, 100);
  EXPECT_GT(refused, 100);
  EXPECT_GT(free_at_start, certified);
}

TEST(MovingObstacles, ThatDoNotMoveChangeAndCostNothing) {
  Generator generator(5);
  for (int trial = 0; trial < 100; ++trial) {
    const Problem problem = random_problem(generator, trial % 2 == 0);
    Problem moving = problem;
    for (Obstacle& obstacle : moving.obstacles) obstacle.motion.assign(3, obstacle.shape);
    const JointVector q0 = random_joints(generator, problem.chain.joints(), 2);
    const JointVector q1 = q0 + random_joints(generator, problem.chain.joints(), 0.3);
    WorkCounters counters, counters_moving;
    const MotionCertificate::Result expected = certify(problem, q0, q1, counters, 0.01);
    const MotionCertificate::Result found = certify(moving, q0, q1, counters_moving, 0.01, 2);
    EXPECT_EQ(found.certified, expected.certified) << "trial " << trial;
    EXPECT_EQ(found.link, expected.link) << "trial " << trial;
    EXPECT_EQ(counters_moving.quadratics, counters.quadratics) << "trial " << trial;
    EXPECT_EQ(counters_moving.distance_queries, counters.distance_queries) << "trial " << trial;
  }
}

TEST(MovingObstacles, WarmCertificatesDoNotAllocate) {
  Generator generator(6);
  WorkCounters counters;
  int certified = 0, refused = 0;
  for (int trial = 0; trial < 40; ++trial) {
    Problem problem = random_problem(generator, trial % 2 == 0);
    for (Obstacle& obstacle : problem.obstacles) {
      obstacle.motion = {obstacle.shape, moved(obstacle.shape, Eigen::Vector3d(0.1, 0.1, 0), 0.5)};
    }
    MotionCertificate certificate;
    problem.link_radius = 0.01;
    certificate.assign(problem, counters);
    const JointVector q0 = random_joints(generator, problem.chain.joints(), 2);
    const JointVector q1 = q0 + random_joints(generator, problem.chain.joints(), 0.1);
    const test_support::AllocationGuard guard;
    const bool proven = certificate.certify(1, q0, q1).certified;
    EXPECT_EQ(guard.allocations(), 0U) << "trial " << trial;
    ++(proven ? certified : refused);
  }
  EXPECT_GT(certified, 5);
  EXPECT_GT(refused, 5);
  EXPECT_GT(counters.distance_queries, 100U);
}

TEST(MotionCertificate, CertifiesAnythingWithoutObstacles) {
  Problem problem{.name = "empty", .chain = SerialChain(planar_chain({1.0, 1.0}))};
  WorkCounters counters;
  MotionCertificate certificate;
  certificate.assign(problem, counters);
  EXPECT_TRUE(certificate.certify(1, JointVector::Zero(2), JointVector::Ones(2)).certified);
}

}  // namespace
}  // namespace bqsa
