#include "harness/judge/judge_kinematics.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "bqsa/kinematics/serial_chain.hpp"
#include "support/prismatic_arms.hpp"
#include "support/sampling.hpp"

namespace bqsa::harness {
namespace {

using test_support::Generator;
using test_support::uniform;

/// Some lengths are zero, so that some links are.
ChainDescription random_chain(Generator& generator, int number) {
  const int joints = 1 + static_cast<int>(generator() % kMaxJoints);
  const auto length = [&] { return generator() % 3 == 0 ? 0.0 : uniform(generator, -1, 1); };
  ChainDescription chain;
  if (number % 3 == 0) {
    std::vector<double> lengths;
    for (int j = 0; j < joints; ++j) lengths.push_back(uniform(generator, 0.1, 1));
    chain = planar_chain(lengths, test_support::random_vector<2>(generator, 1));
  } else {
    if (number % 3 == 1) chain.convention = DhConvention::kModified;
    for (int j = 0; j < joints; ++j) {
      chain.rows.push_back({.a = length(),
                            .alpha = uniform(generator, -std::numbers::pi, std::numbers::pi),
                            .d = length(),
                            .offset = uniform(generator, -1, 1)});
    }
    chain.R_WB = test_support::random_rotation<3>(generator);
    chain.p_WB = test_support::random_vector<3>(generator, 1);
    chain.R_LT = test_support::random_rotation<3>(generator);
  }
  if (number % 2 == 0) chain.p_LT = {uniform(generator, 0.1, 0.3), 0, number % 3 == 0 ? 0 : 0.1};
  return chain;
}

JointVector random_angles(Generator& generator, int joints) {
  JointVector q(joints);
  for (int j = 0; j < joints; ++j) q(j) = uniform(generator, -4, 4);
  return q;
}

TEST(JudgeKinematics, AgreesWithTheSerialChain) {
  Generator generator(1);
  int skipped = 0;
  for (int k = 0; k < 3000; ++k) {
    const ChainDescription description = random_chain(generator, k);
    const SerialChain chain(description);
    const JudgeKinematics judge(description);
    const JointVector q = random_angles(generator, chain.joints());
    ChainPose pose;
    chain.forward(q, pose);
    PointPositions positions;
    judge.place(q, positions);
    ASSERT_EQ(static_cast<int>(positions.points.size()), chain.points()) << "case " << k;
    for (int point = 0; point < chain.points(); ++point) {
      const Eigen::Vector3d p = pose.p_WO.col(point);
      ASSERT_LE((positions.points[static_cast<std::size_t>(point)] - p).norm(), 1e-12)
          << "case " << k << ", point " << point;
    }
    ASSERT_LE((judge.tip_rotation(q) - chain.tip_rotation(pose)).norm(), 1e-12) << "case " << k;
    ASSERT_EQ(judge.links().size(), chain.links().size()) << "case " << k;
    for (std::size_t i = 0; i < judge.links().size(); ++i) {
      ASSERT_EQ(judge.links()[i].number, chain.links()[i].number) << "case " << k;
      ASSERT_EQ(judge.links()[i].start, chain.links()[i].start) << "case " << k;
      ASSERT_EQ(judge.links()[i].end, chain.links()[i].end) << "case " << k;
    }
    if (static_cast<int>(judge.links().size()) < chain.points() - 1) ++skipped;
  }
  EXPECT_GT(skipped, 300);
}

TEST(JudgeKinematics, VelocityIsTheDerivativeOfThePosition) {
  Generator generator(2);
  for (int k = 0; k < 500; ++k) {
    const ChainDescription description = random_chain(generator, k);
    const JudgeKinematics judge(description);
    const Eigen::VectorXd q = random_angles(generator, judge.joints());
    const Eigen::VectorXd rates = random_angles(generator, judge.joints());
    constexpr double kStep = 1e-6;
    PointPositions now, before, after;
    judge.place(q, now);
    judge.place(q - kStep * rates, before);
    judge.place(q + kStep * rates, after);
    for (int point = 0; point < judge.points(); ++point) {
      const auto at = static_cast<std::size_t>(point);
      const Eigen::Vector3d difference = (after.points[at] - before.points[at]) / (2 * kStep);
      ASSERT_LE((judge.velocity(now, rates, point) - difference).norm(), 1e-5)
          << "case " << k << ", point " << point;
    }
  }
}

/// Where the slide is all of the way from the axis, the bound is the speed.
TEST(JudgeKinematics, SpeedBoundGrowsWithWhatSlides) {
  const ChainDescription arm = test_support::swinging_slide();
  const JudgeKinematics judge(arm);
  const SerialChain chain(arm);
  const JointVector travel = Eigen::Vector2d(5, 0.7);
  for (const int point : {2, 3}) {
    const double tool = point == 2 ? 0 : 0.3;
    EXPECT_EQ(judge.speed_bound(0, point, travel), 0.7 + tool);
    EXPECT_EQ(chain.speed_bound(0, point, travel), 0.7 + tool);
    EXPECT_EQ(judge.speed_bound(1, point, travel), 1);
    EXPECT_EQ(chain.speed_bound(1, point, travel), 1);
  }
  EXPECT_EQ(judge.speed_bound(1, 1, travel), 0);
  EXPECT_EQ(chain.speed_bound(1, 1, travel), 0);
}

TEST(JudgeKinematics, ReachBoundsTheDistanceToTheAxis) {
  Generator generator(3);
  int tight = 0;
  for (int k = 0; k < 3000; ++k) {
    const ChainDescription description = random_chain(generator, k);
    const JudgeKinematics judge(description);
    PointPositions positions;
    judge.place(random_angles(generator, judge.joints()), positions);
    for (int j = 0; j < judge.joints(); ++j) {
      for (int point = j + 1; point < judge.points(); ++point) {
        const auto at = static_cast<std::size_t>(point), joint = static_cast<std::size_t>(j);
        const double distance =
            positions.axes[joint].cross(positions.points[at] - positions.pivots[joint]).norm();
        ASSERT_LE(distance, judge.reach(j, point) + 1e-12) << "case " << k << ", joint " << j;
        if (distance > 0.99 * judge.reach(j, point) && distance > 0) ++tight;
      }
    }
  }
  EXPECT_GT(tight, 3000);
}

}  // namespace
}  // namespace bqsa::harness
