/// @file
/// The control tick that all BQSA variants share (paper, section 3.2, Fig. 4).
#pragma once

#include "bqsa/bqsa_settings.hpp"
#include "bqsa/joint_box.hpp"
#include "bqsa/kinematics/planar_tip.hpp"
#include "bqsa/method.hpp"
#include "bqsa/motion_certificate.hpp"
#include "bqsa/tip_task.hpp"

namespace bqsa {

/// One control tick, numbered as the steps of the reconstructed algorithm:
///
///   1. x_dot = (x_d(t) - tip) / dt, closed over the tip error; with the rows of TipTask where the task has
///      an orientation
///   2. predictor: theta' = theta + dt hybrid_ik(x_dot, W = I, phi), a first-order step, and
///      `corrections` that take its second-order error away; phi = 0, or what sends joints back from their
///      limits (joint_limit_clamp.hpp), if that is asked for
///   3. backward search, i = n .. 1: quadratic category of link i with every obstacle
///   4. joints clamping: links that hit are moved out by self-motions
///   5. what the variant makes of the clamped configuration
///   6. the motion from the last tick is certified, the obstacles' own included; if that fails, 3 to 5 again with twice the distance
///
/// A tick that fails holds the last safe configuration and says why. Variants supply 3, 4 and 5.
class BackwardSearch : public ReactiveMethod {
 public:
  void prepare(const Problem& problem) override;
  void step(const StepInput& input, StepOutput& output) final;

  /// From now on the predictor adds the part of phi [rad/s] that does not move the tip.
  void lean(const JointVector& phi) {
    lean_ = phi;
    leans_ = !phi.isZero(0);
  }

  /// Moves q [rad] by the least self-motion until it is in the box, its tip at p_WT [m] and
  /// turned as the problem wants it at that tick, and all links
  /// keep link radius, margin and `distance` [m] from the obstacles of that tick. False, and q as it
  /// was, if that fails.
  bool fit(int tick, const Eigen::Vector3d& p_WT, double distance, const JointBox& box,
           JointVector& q);

 protected:
  explicit BackwardSearch(const BqsaSettings& settings) : settings_(settings) {}

  /// From now on the obstacles are where they are at this tick.
  virtual void go_to(int tick) = 0;

  /// From now on links hit what is closer than this [m], and links thinner than the thickest, that much
  /// less.
  virtual void keep(double distance) = 0;

  /// Steps 3 and 4: frees all links of q_, changing q_ and pose_, and records the clamps. If that
  /// fails, says why, with the link and the obstacle in `output`.
  virtual Infeasible free_links(const StepInput& input, StepOutput& output) = 0;

  /// Step 4, all links at once (link_release.hpp): frees all links of q_ within the box, changing q_ and
  /// pose_, and records the clamps if `output` is given. Variants without it never free links so.
  virtual bool free_together(const Eigen::Vector3d& p_WT, const JointBox& box, StepOutput* output);

  /// Whether links hit nothing that keep their distance in space. If so, ticks in which lists prove that
  /// they do are done after the prediction.
  virtual bool searches_space() const { return true; }

  /// Steps 5 and 6: whether the motion to q_, or to what the variant makes of it, is certified.
  virtual MotionCertificate::Result finish(const StepInput& input, const JointVector& q_predicted,
                                           StepOutput& output);

  /// The motion from where the tick starts to q_.
  MotionCertificate::Result certify(const StepInput& input) {
    return certificate_.certify(input.tick, input.q, pose_start_, q_, pose_);
  }

  /// The neighbour lists of the certificate, for the variant's own fields to share.
  const std::shared_ptr<NeighbourLists>& neighbours() const { return certificate_.neighbours(); }

  /// q + dt hybrid_ik(...) with the tip's Jacobian and velocity of this tick (Eqs. 17, 18).
  JointVector hybrid_step(const JointVector& q, const JointVector& weights, const JointVector& phi);

  /// Moves q_ until the tip is on its path. False if it stays off it.
  /// @param ik            of the tip's Jacobian at a configuration close to q_
  /// @param error_before  of the tip there, if the last step was to correct it, else 0 [m]
  bool correct_tip(const StepInput& input, const TrackingIk& ik, double error_before);

  /// pose_ of q_.
  void forward();

  /// Counts a clamping increment or a turn to a computed exit. False if this tick has none left.
  bool take_increment();

  BqsaSettings settings_;
  const Problem* problem_ = nullptr;
  TipTask task_;    ///< of this tick
  JointVector q_;   ///< configuration in hand [rad]
  ChainPose pose_;  ///< of q_

 private:
  enum class Way { kOneByOne, kTogether };
  Infeasible search(const StepInput& input, const JointVector& q_predicted, Way way,
                    StepOutput& output);
  Infeasible release_links(const StepInput& input, StepOutput& output);
  void start_at(const JointVector& q);
  bool predict(const StepInput& input);
  const JointVector* clamping_velocity(const JointVector& q);
  bool predict_in_plane(const StepInput& input);
  bool is_clear(const StepInput& input) const;
  void answer(const StepInput& input, StepOutput& output);

  MotionCertificate certificate_;
  ChainPose pose_start_;   ///< at the start of the tick; of the end-points only
  bool answered_ = false;  ///< whether q_ is the last answer
  TaskJacobian J_tip_;     ///< at the start of the tick
  TrackingIk ik_start_;    ///< of J_tip_
  PlanarTip planar_tip_;   ///< of pose_start_
  TaskVector x_dot_;       ///< [m/s]
  JointVector lean_;       ///< [rad/s]
  JointVector phi_;        ///< lean_ and what sends joints back from their limits [rad/s]
  bool leans_ = false;     ///< whether it is not zero
  int increments_left_ = 0;
};

}  // namespace bqsa
