// Kinematics and plain tracking against Orocos KDL, with which nothing is shared.

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include "baselines/plain_tracking.hpp"
#include "bqsa/hybrid_ik.hpp"
#include "harness/generator/arm.hpp"
#include "harness/measuring/kdl_chain.hpp"
#include "harness/scenario/scenario.hpp"
#include "support/near_obstacles.hpp"
#include "support/prismatic_arms.hpp"
#include "support/replay.hpp"

namespace bqsa::baselines {
namespace {

using harness::kdl_chain;
using harness::kdl_vector;

const char* const kScenarios[] = {"planar_7r", "puma560_ellipsoid", "puma560_wall"};

Problem scenario(const std::string& name) {
  return harness::load_scenario(BQSA_SOURCE_DIR "/scenarios/" + name + ".yaml").problem;
}

KDL::JntArray kdl_joints(const JointVector& q) {
  KDL::JntArray joints(static_cast<unsigned>(q.size()));
  joints.data = q;
  return joints;
}

Eigen::Vector3d tip_of(const KDL::Chain& chain, const JointVector& q) {
  KDL::ChainFkSolverPos_recursive solver(chain);
  KDL::Frame frame;
  EXPECT_EQ(solver.JntToCart(kdl_joints(q), frame), 0);
  return Eigen::Vector3d(frame.p.data);
}

TEST(KdlReference, HasTheSameTipAndJacobianForEveryArm) {
  std::vector<SerialChain> arms = {scenario("planar_7r").chain, scenario("puma560_wall").chain};
  for (const harness::Arm& arm : harness::spatial_arms(BQSA_SOURCE_DIR "/robots")) {
    arms.emplace_back(arm.chain);
  }
  ChainDescription elsewhere = arms[2].description();  // a base that is turned and moved
  elsewhere.R_WB = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  elsewhere.p_WB << 0.3, -0.2, 0.5;
  arms.emplace_back(elsewhere);

  test_support::Generator generator(1);
  arms.emplace_back(test_support::random_prismatic_arm(generator, 7));
  ASSERT_EQ(arms.size(), 6U);
  for (const SerialChain& arm : arms) {
    const KDL::Chain chain = kdl_chain(arm.description());
    ASSERT_EQ(static_cast<int>(chain.getNrOfJoints()), arm.joints());
    KDL::ChainJntToJacSolver solver(chain);
    KDL::Jacobian expected(chain.getNrOfJoints());
    ChainPose pose;
    TaskJacobian J;
    for (int trial = 0; trial < 1000; ++trial) {
      const JointVector q = JointVector::NullaryExpr(
          arm.joints(), [&](Eigen::Index) { return test_support::uniform(generator, -3, 3); });
      arm.forward(q, pose);
      arm.jacobian(pose, arm.points() - 1, J);
      ASSERT_LT((pose.tip() - tip_of(chain, q)).norm(), 1e-12) << trial;
      ASSERT_EQ(solver.JntToJac(kdl_joints(q), expected), 0);
      ASSERT_LT((J - expected.data.topRows(arm.dimension())).cwiseAbs().maxCoeff(), 1e-12) << trial;
    }
  }
}

/// Plain tracking made of KDL's parts: its forward kinematics and its weighted damped least squares.
std::vector<JointVector> tracked_by_kdl(const Problem& problem) {
  const KDL::Chain chain = kdl_chain(problem.chain.description());
  KDL::ChainIkSolverVel_wdls solver = harness::kdl_velocity_solver(chain, problem.dimension());
  std::vector<JointVector> rows = {problem.start};
  KDL::JntArray q_dot(chain.getNrOfJoints());
  for (int tick = 1; tick <= problem.ticks; ++tick) {
    const JointVector& q = rows.back();
    const Eigen::Vector3d x_dot =
        (problem.desired_tip(problem.time(tick)) - tip_of(chain, q)) / problem.dt;
    EXPECT_GE(solver.CartToJnt(kdl_joints(q), {kdl_vector(x_dot), KDL::Vector::Zero()}, q_dot), 0);
    rows.emplace_back(q + problem.dt * q_dot.data);
    EXPECT_TRUE(rows.back().allFinite()) << tick;
  }
  return rows;
}

std::vector<JointVector> tracked(const Problem& problem) {
  const auto method = plain_tracking_method().make(ParameterValues({}));
  return test_support::replay(static_cast<ReactiveMethod&>(*method), problem).q;
}

double largest_difference(const std::vector<JointVector>& one,
                          const std::vector<JointVector>& other) {
  double largest = one.size() == other.size() ? 0 : 1e9;
  for (std::size_t k = 0; k < std::min(one.size(), other.size()); ++k) {
    largest = std::max(largest, (one[k] - other[k]).norm());
  }
  return largest;
}

/// Two ways of computing one tick differ by rounding: of the angles, and of the tip's error and the
/// singular vectors, which the pseudo-inverse amplifies by up to 1 / s_m. What a tick adds is carried
/// on by those that follow, as a disturbed start is.
double tolerance(const Problem& problem, const std::vector<JointVector>& rows) {
  double rounding = 0, carried = 1;
  for (const JointVector& q : rows) {
    const TaskJacobian J = test_support::tip_jacobian(problem, q);
    const Eigen::VectorXd s = Eigen::JacobiSVD<Eigen::MatrixXd>(J).singularValues();
    EXPECT_GE(s.minCoeff(), HybridIkSettings{}.singular_threshold);  // lambda = 0
    ChainPose pose;
    problem.chain.forward(q, pose);
    rounding += 10 * std::numeric_limits<double>::epsilon() *
                (q.norm() + (pose.tip().norm() + s.maxCoeff()) / s.minCoeff());
  }
  for (int j = 0; j < problem.chain.joints(); ++j) {
    Problem disturbed = problem;
    disturbed.start(j) += 1e-6;
    carried = std::max(carried, largest_difference(tracked(disturbed), rows) / 1e-6);
  }
  return rounding * carried * std::sqrt(problem.chain.joints());
}

TEST(KdlReference, TracksThePathsOfThePaperAlike) {
  for (const char* name : kScenarios) {
    const Problem problem = scenario(name);
    const std::vector<JointVector> rows = tracked(problem);
    ASSERT_EQ(rows.size(), static_cast<std::size_t>(problem.ticks) + 1);
    EXPECT_GT((rows[rows.size() / 2] - rows[0]).norm(), 0.1) << name;
    const double allowed = tolerance(problem, rows);
    EXPECT_LT(allowed, 1e-9) << name;
    EXPECT_LT(largest_difference(tracked_by_kdl(problem), rows), allowed) << name;
  }
}

}  // namespace
}  // namespace bqsa::baselines
