/// @file
/// BQSA in space as the paper does it: by projections on the coordinate planes (paper, section
/// 4.2).
#pragma once

#include <optional>

#include "bqsa/shadow_field.hpp"
#include "bqsa/spatial_search.hpp"

namespace bqsa {

/// A link hits if its projections on all three coordinate planes hit the obstacle's shadows. It is
/// then turned in one plane, in growing increments of the angle psi of its projection and to both
/// sides, the side it came from first, until the projections of some plane are free. A projected
/// link changes its length, so that section 3.3's circle construction does not hold; the turn is
/// the self-motion
///
///     C dtheta = [0; ±dTheta],   C = [J_tip; d psi / d theta],
///
/// of least norm, after which the tip is put back on its path.
///
/// By Lemma 1 what is free here is free in space. The converse is false: this variant moves links
/// that are free, and fails where no posture has a free projection.
class BqsaProjection final : public SpatialSearch {
 public:
  /// @param plane  in which links are turned; none: all are tried in step, and the first exit wins
  explicit BqsaProjection(std::optional<CoordinatePlane> plane = {},
                          const BqsaSettings& settings = {})
      : SpatialSearch(settings), plane_(plane) {}

  /// @throws std::invalid_argument if the problem is not spatial
  void prepare(const Problem& problem) override;

 private:
  /// One branch of the search: how far the link has been turned in a plane to one side, and how it
  /// got there.
  struct Branch {
    CoordinatePlane plane = CoordinatePlane::kXy;
    double direction = 0;
    double offset = 0;
    JointVector q = {};
    bool open = false;
  };

  void go_to(int tick) override { shadows_.go_to(tick); }
  void keep(double distance) override { shadows_.keep(distance); }
  bool searches_space() const override { return false; }
  int first_hit(const Link& link, int from) const override {
    return shadows_.first_hit(pose_, link, from);
  }
  Infeasible free_link(const StepInput& input, const Link& link, StepOutput& output) override;

  bool advance(const StepInput& input, const Link& link, Branch& branch);
  bool turn_rate(const Link& link, CoordinatePlane plane, JointVector& rate);

  std::optional<CoordinatePlane> plane_;
  ShadowField shadows_;
  TaskJacobian J_start_, J_end_;  ///< of pose_
  ChainPose pose_last_;           ///< at the start of the tick
};

}  // namespace bqsa
