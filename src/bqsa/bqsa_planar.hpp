/// @file
/// BQSA in the plane: the backward quadratic search algorithm of the paper's sections 3.2 and 3.3.
#pragma once

#include "bqsa/bqsa_settings.hpp"
#include "bqsa/method.hpp"
#include "bqsa/motion_certificate.hpp"
#include "bqsa/obstacle_field.hpp"
#include "bqsa/planar_self_motion.hpp"

namespace bqsa {

/// What follows the clamping of joints.
enum class PlanarVariant {
  kExact,  ///< the clamped configuration itself, a true self-motion: the tip stays on its path
  kPaper,  ///< the paper's: the hybrid IK with the clamping velocity phi and the weights W (Eqs.
           ///< 17-18, 23), a first-order step, guarded by the exact one where it would collide
};

/// One control tick, with the steps of the paper's Fig. 4:
///
///   1. x_dot = (x_d(t) - tip) / dt, closed over the tip error
///   2. predictor: theta' = theta + dt hybrid_ik(x_dot, W = I, phi = 0); the exact variant then
///   closes
///      the tip on its path, which this first-order step leaves by its second-order error
///   3. backward search, i = n .. 1: quadratic category of link i with every obstacle
///   4. joints clamping: link i is turned, in growing increments to both sides, by self-motions
///   that
///      leave the links beyond the anchor a >= i in place, until links .. a are free
///   5. clamping velocity phi and weights W (paper variant only)
///   6. the motion from the last tick is certified; if it fails, 3 to 5 again with more distance
///
/// A tick that fails holds the last safe configuration and says why.
class BqsaPlanar final : public ReactiveMethod {
 public:
  explicit BqsaPlanar(PlanarVariant variant, const BqsaSettings& settings = {})
      : variant_(variant), settings_(settings) {}

  /// @throws std::invalid_argument if the problem is not planar or its arm has a tool
  void prepare(const Problem& problem) override;
  void step(const StepInput& input, StepOutput& output) override;

 private:
  /// A half of the two-sided search: how far the link has been turned to one side, and how it got
  /// there.
  struct Side {
    double direction;
    double offset = 0;
    JointVector q;
    bool open = true;
  };

  bool search_backward(const JointVector& q_last, StepOutput& output);
  bool free_link(int link, const JointVector& q_last, Clamp& clamp);
  bool advance(Side& side, int link, int anchor, int lowest, const JointVector& q_last);
  void settle(Side& side, int link, int anchor, int lowest);
  JointVector paper_step(const JointVector& q_last, const JointVector& q_predicted,
                         const StepOutput& output);
  JointVector hybrid_step(const JointVector& q, const JointVector& weights, const JointVector& phi);
  bool links_free(int lowest, int highest);
  void forward();

  PlanarVariant variant_;
  BqsaSettings settings_;
  const Problem* problem_ = nullptr;
  ObstacleField<2> obstacles_;
  MotionCertificate certificate_;
  PlanarSelfMotion self_motion_;

  JointVector q_;       ///< configuration being freed [rad]
  ChainPose pose_;      ///< of q_, or of the candidate in hand
  TaskJacobian J_tip_;  ///< at the start of the tick
  TaskVector x_dot_;    ///< [m/s]
  HybridIkResult ik_;
};

}  // namespace bqsa
