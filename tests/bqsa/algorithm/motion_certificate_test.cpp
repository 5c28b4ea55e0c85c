#include "bqsa/motion_certificate.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "support/replay.hpp"
#include "support/sampling.hpp"

namespace bqsa {
namespace {

using test_support::Generator;
using test_support::log_uniform;
using test_support::random_ellipsoid;
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

TEST(MotionCertificate, WhatItCertifiesKeepsItsClearanceInDenseSamples) {
  Generator generator(2);
  WorkCounters counters;
  int certified = 0, sampled_free = 0, refused_hits = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const Problem problem = random_problem(generator, trial % 2 == 0);
    const double clearance = trial % 3 == 0 ? 0.01 : 0;
    MotionCertificate certificate;
    certificate.assign(problem, clearance, counters);
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

TEST(MotionCertificate, RefusesAMotionThatTunnelsThroughAThinSheet) {
  Problem problem{.name = "sheet", .chain = SerialChain(planar_chain({1.0}))};
  problem.obstacles = {{"sheet", Ellipsoid({0.9, 0, 0}, {0.3, 1e-4, 0.3})}};
  WorkCounters counters;
  MotionCertificate certificate;
  certificate.assign(problem, 0, counters);
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
  certificate.assign(problem, 0, counters);
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
  certificate.assign(problem, 0, counters);
  const JointVector near = JointVector::Zero(1), away = JointVector::Constant(1, -0.2);
  EXPECT_TRUE(certificate.certify(1, near, away).certified);
  EXPECT_TRUE(certificate.certify(1, away, near).certified);
  EXPECT_FALSE(certificate.certify(1, away, JointVector::Constant(1, 1e-4)).certified);
}

TEST(MotionCertificate, CertifiesAnythingWithoutObstacles) {
  Problem problem{.name = "empty", .chain = SerialChain(planar_chain({1.0, 1.0}))};
  WorkCounters counters;
  MotionCertificate certificate;
  certificate.assign(problem, 0, counters);
  EXPECT_TRUE(certificate.certify(1, JointVector::Zero(2), JointVector::Ones(2)).certified);
}

}  // namespace
}  // namespace bqsa
