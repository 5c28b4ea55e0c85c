#include "baselines/self_motions.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>

#include "support/sampling.hpp"

namespace bqsa::baselines {
namespace {

using test_support::Generator;
using test_support::uniform;

JointVector random_joints(Generator& generator, int joints) {
  return JointVector::NullaryExpr(joints, [&](Eigen::Index) { return uniform(generator, -1, 1); });
}

TEST(SelfMotions, ProjectLikeThePseudoInverseSingularArmsIncluded) {
  Generator generator(1);
  for (int trial = 0; trial < 2000; ++trial) {
    const int rows = 1 + trial % 6;
    const int joints = rows + trial % 9;
    TaskJacobian J = TaskJacobian::NullaryExpr(
        rows, joints, [&](Eigen::Index, Eigen::Index) { return uniform(generator, -1, 1); });
    if (trial % 3 == 0 && rows > 1) J.row(rows - 1) = -2 * J.row(0);
    if (trial % 7 == 0) J.row(0) *= 1e-5;
    SelfMotions self_motions;
    self_motions.assign(J);
    Eigen::JacobiSVD<Eigen::MatrixXd> svd(J, Eigen::ComputeFullV | Eigen::ComputeThinU);
    svd.setThreshold(1e-9);
    const Eigen::MatrixXd V = svd.matrixV().leftCols(svd.rank());
    const JointVector v = random_joints(generator, joints);
    const JointVector expected = v - V * (V.transpose() * v);
    EXPECT_LT((self_motions.project(v) - expected).norm(), 1e-10) << trial;
  }
}

TEST(SelfMotions, DoNotMoveTheTipThoughRowsBeNearlyDependent) {
  Generator generator(7);
  for (int trial = 0; trial < 500; ++trial) {
    TaskJacobian J = TaskJacobian::NullaryExpr(
        3, 7, [&](Eigen::Index, Eigen::Index) { return uniform(generator, -1, 1); });
    J.row(1) = J.row(0) + 1e-7 * J.row(1);
    SelfMotions self_motions;
    self_motions.assign(J);
    const JointVector projected = self_motions.project(random_joints(generator, 7));
    EXPECT_LT((self_motions.project(projected) - projected).norm(), 1e-14) << trial;
    EXPECT_LT((J * projected).norm(), 1e-14) << trial;
  }
}

}  // namespace
}  // namespace bqsa::baselines
