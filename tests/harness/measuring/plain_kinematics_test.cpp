// The plain kinematics, what steps are compared with, are those of the arm: by the serial chain.
#include "harness/measuring/plain_kinematics.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "harness/generator/random_stream.hpp"
#include "harness/measuring/bystanders.hpp"

namespace bqsa::harness {
namespace {

void expect_same(const ChainDescription& arm) {
  const SerialChain chain(arm);
  PlainKinematics plain(arm);
  RandomStream random{3};
  ChainPose pose;
  TaskJacobian J;
  for (int trial = 0; trial < 100; ++trial) {
    JointVector q(chain.joints());
    for (double& angle : q) angle = random.uniform(-3, 3);
    chain.forward(q, pose);
    chain.jacobian(pose, chain.points() - 1, J);
    plain.update(q);
    ASSERT_LT((plain.tip() - pose.tip()).norm(), 1e-13);
    ASSERT_LT(
        (plain.jacobian().topLeftCorner(arm.dimension, chain.joints()) - J).cwiseAbs().maxCoeff(),
        1e-13);
  }
}

TEST(PlainKinematics, AreThoseOfTheChain) {
  ChainDescription planar = lonely_problem(2).chain.description();
  ChainDescription puma = lonely_puma().chain.description();
  expect_same(planar);
  expect_same(puma);
  planar.R_WB = Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  planar.p_WB << 0.1, 0.2, 0;
  planar.p_LT << 0.05, 0.02, 0;
  planar.rows[2].offset = 0.3;
  expect_same(planar);
  puma.R_WB = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  puma.p_WB << 0.1, 0.2, 0.3;
  puma.p_LT << 0.05, 0.02, 0.1;
  expect_same(puma);
}

}  // namespace
}  // namespace bqsa::harness
