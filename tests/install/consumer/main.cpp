// Uses headers and compiled parts of the installed library; succeeds if they answer correctly.

#include <bqsa/geometry/segment_test.hpp>
#include <bqsa/hybrid_ik.hpp>
#include <bqsa/kinematics/serial_chain.hpp>

int main() {
  const bqsa::SerialChain arm(bqsa::planar_chain({0.5, 0.5, 0.5}));
  const bqsa::JointVector q = bqsa::JointVector::Constant(3, 0.5);
  bqsa::ChainPose pose;
  arm.forward(q, pose);

  const Eigen::Vector2d start = pose.p_WO.col(1).head<2>(), end = pose.p_WO.col(2).head<2>();
  const bqsa::Ellipse on_the_link(0.5 * (start + end), {0.1, 0.05});
  const bool hit = bqsa::hits(bqsa::polar_form<2>(on_the_link, start, end));

  bqsa::TaskJacobian J;
  arm.jacobian(pose, arm.points() - 1, J);
  bqsa::HybridIkResult step;
  bqsa::solve_hybrid_ik(J, Eigen::Vector2d(0.1, 0), bqsa::JointVector::Ones(3),
                        bqsa::JointVector::Zero(3), {}, step);
  return hit && step.rank == 2 && step.residual < 1e-12 ? 0 : 1;
}
