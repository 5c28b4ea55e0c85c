#include "bqsa/planar_self_motion.hpp"

#include <gtest/gtest.h>

#include "support/sampling.hpp"

namespace bqsa {
namespace {

using test_support::Generator;
using test_support::uniform;

JointVector bent_arm(Generator& generator, int joints) {
  return JointVector::NullaryExpr(joints,
                                  [&](Eigen::Index) { return uniform(generator, -0.9, 0.9); });
}

TEST(PlanarSelfMotion, TurnsTheLinkAndLeavesEverythingBeyondTheAnchorInPlace) {
  Generator generator(1);
  WorkCounters counters;
  int turned = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const int n = 4 + trial % 6;
    std::vector<double> lengths;
    for (int i = 0; i < n; ++i) lengths.push_back(uniform(generator, 0.2, 0.6));
    const SerialChain chain(planar_chain(lengths, {0.3, -0.2}));
    const int anchor = 3 + trial % (n - 2);
    const int link = 1 + trial % anchor;
    const JointVector before = bent_arm(generator, n);
    const double turn = uniform(generator, -0.01, 0.01);
    ChainPose pose_before;
    chain.forward(before, pose_before);
    ChainPose pose_after = pose_before;

    PlanarSelfMotion self_motion;
    self_motion.assign(chain, counters);
    JointVector after = before;
    if (!self_motion.turn_link(link, anchor, turn, after, pose_after)) continue;
    ++turned;

    ChainPose recomputed;
    chain.forward(after, recomputed);
    EXPECT_LT((recomputed.p_WO - pose_after.p_WO).cwiseAbs().maxCoeff(), 1e-14) << trial;
    for (int k = anchor; k <= n; ++k) {
      EXPECT_LT((pose_after.p_WO.col(k) - pose_before.p_WO.col(k)).norm(), 1e-11)
          << "trial " << trial << ", point " << k;
    }
    EXPECT_NEAR(after.head(link).sum() - before.head(link).sum(), turn, 1e-11) << trial;
    EXPECT_EQ(after.tail(std::max(0, n - anchor - 1)), before.tail(std::max(0, n - anchor - 1)));
  }
  EXPECT_GT(turned, 1900);
}

TEST(PlanarSelfMotion, SaysSoWhenAStretchedArmCannotTurn) {
  const SerialChain chain(planar_chain({0.4, 0.4, 0.4, 0.4}));
  WorkCounters counters;
  PlanarSelfMotion self_motion;
  self_motion.assign(chain, counters);
  JointVector q = JointVector::Zero(4);
  ChainPose pose;
  chain.forward(q, pose);
  EXPECT_FALSE(self_motion.turn_link(2, 4, 0.1, q, pose));
}

}  // namespace
}  // namespace bqsa
