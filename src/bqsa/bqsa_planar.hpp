/// @file
/// BQSA in the plane: the backward quadratic search of the paper's sections 3.2 and 3.3.
#pragma once

#include "bqsa/backward_search.hpp"
#include "bqsa/link_release.hpp"
#include "bqsa/obstacle_field.hpp"
#include "bqsa/planar_self_motion.hpp"

namespace bqsa {

/// What follows the clamping of joints (step 5).
enum class PlanarVariant {
  kExact,  ///< nothing: the clamped configuration itself, a true self-motion of the predicted one
  kPaper,  ///< the paper's: the hybrid IK with the clamping velocity phi and the weights W (Eqs. 17,
           ///< 18, 23), a first-order step; where that would collide, the clamped configuration
};

/// The settings that go with a variant: the paper's has no corrections of the tip and no settling.
BqsaSettings default_settings(PlanarVariant variant);

/// Joints clamping in the plane: a link that hits is turned by self-motions that leave the links beyond
/// an anchor a >= i in place. The exact variant computes the turn at which the link comes free from how
/// deep it is in the obstacle; where that leads nowhere, and in the paper variant always, the link is
/// turned in growing increments to both sides.
class BqsaPlanar final : public BackwardSearch {
 public:
  explicit BqsaPlanar(PlanarVariant variant) : BqsaPlanar(variant, default_settings(variant)) {}
  BqsaPlanar(PlanarVariant variant, const BqsaSettings& settings)
      : BackwardSearch(settings), variant_(variant) {}

  /// @throws std::invalid_argument if the problem is not planar, or its arm has a tool or is not in
  ///   standard Denavit-Hartenberg form (`planar_chain`)
  void prepare(const Problem& problem) override;

 private:
  /// Half of the two-sided search: how far the link has been turned to one side, and how it got there.
  struct Side {
    double direction;
    double offset = 0;
    JointVector q;
    ChainPose pose;
    bool open = true;
  };

  void go_to(int tick) override { obstacles_.go_to(tick); }
  void keep(double distance) override { obstacles_.keep(distance); }
  bool free_together(const Eigen::Vector3d& p_WT, const JointBox& box,
                     StepOutput* output) override {
    return release_.release(p_WT, box, q_, pose_, output);
  }
  Infeasible free_links(const StepInput& input, StepOutput& output) override;
  MotionCertificate::Result finish(const StepInput& input, const JointVector& q_predicted,
                                   StepOutput& output) override;

  /// A link turned from where it was predicted, and the configuration there.
  struct Turned {
    double offset;  ///< [rad]
    JointVector q;
    ChainPose pose;
  };
  /// A link and an obstacle that it hits.
  struct Contact {
    const Link* link;
    int obstacle;
  };

  bool free_link(int link, const JointVector& q_last, Clamp& clamp);
  bool find_exit(int link, int anchor, int lowest, double side, const JointVector& q_last,
                 Clamp& clamp);
  bool find_contact(const ChainPose& pose, int lowest, int highest, Contact& contact) const;
  double gap(const ChainPose& pose, const Contact& contact) const;
  bool advance(Side& side, int link, int anchor, int lowest, const JointVector& q_last);
  void settle(Side& side, int link, int anchor, int lowest, const JointVector& q_last);
  bool links_free(const ChainPose& pose, int lowest, int highest) const;

  PlanarVariant variant_;
  ObstacleField<2> obstacles_;
  LinkRelease<2> release_;
  PlanarSelfMotion self_motion_;
  ChainPose candidate_;  ///< of `settle`: pose of the configuration being tried
  Turned hit_, trial_;   ///< of `find_exit`: the last that hits, and the one being tried
};

}  // namespace bqsa
