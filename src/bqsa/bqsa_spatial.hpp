/// @file
/// BQSA in space, exact: the 3-D quadratic instead of three projections (beyond the paper's
/// section 4.2).
#pragma once

#include "bqsa/bqsa_settings.hpp"
#include "bqsa/method.hpp"
#include "bqsa/motion_certificate.hpp"
#include "bqsa/obstacle_field.hpp"

namespace bqsa {

/// The backward quadratic search with the parameter form in space. One control tick:
///
///   1, 2. predictor: the hybrid IK with W = I, phi = 0, closed until the tip is on its path
///   3.    backward search, i = n .. 1: quadratic category of link i with every obstacle
///   4.    joints clamping: while link i hits, the arm moves along the self-motion
///         phi = N J(t*)ᵀ g, in increments of dTheta for the fastest joint, and the tip is closed
///         again; g is the outward normal of the ellipsoid's level at the link's vertex point
///         P(t*), J(t*) the Jacobian of that point, interpolated between the link's end-points, N
///         the null-space projector of the tip task
///   5.    links freed earlier are searched again until all are free
///   6.    the motion from the last tick is certified; if it fails, 3 to 5 again with more distance
///
/// A tick that fails holds the last safe configuration and says why.
class BqsaSpatial final : public ReactiveMethod {
 public:
  explicit BqsaSpatial(const BqsaSettings& settings = {}) : settings_(settings) {}

  /// @throws std::invalid_argument if the problem is not spatial
  void prepare(const Problem& problem) override;
  void step(const StepInput& input, StepOutput& output) override;

 private:
  Infeasible search_backward(const StepInput& input, StepOutput& output);
  Infeasible free_link(const StepInput& input, const Link& link, Clamp& clamp);
  bool clamping_velocity(const Link& link, int obstacle, JointVector& phi);
  bool move(const StepInput& input, const JointVector& from, const JointVector& change);
  void settle(const StepInput& input, const Link& link, const JointVector& colliding,
              const JointVector& change);

  BqsaSettings settings_;
  const Problem* problem_ = nullptr;
  ObstacleField<3> obstacles_;
  MotionCertificate certificate_;

  JointVector q_;   ///< configuration being freed [rad]
  ChainPose pose_;  ///< of q_
  TaskJacobian J_tip_, J_start_, J_end_;
  HybridIkResult ik_;
};

}  // namespace bqsa
