/// @file
/// BQSA in space, exact: the 3-D quadratic instead of three projections (beyond the paper's section
/// 4.2).
#pragma once

#include <cmath>

#include "bqsa/link_release.hpp"
#include "bqsa/obstacle_field.hpp"
#include "bqsa/spatial_search.hpp"

namespace bqsa {

/// Joints clamping in space: while link i hits, the arm moves along the self-motion
///
///     phi = N J(t*)ᵀ g
///
/// and the tip is put back on its path: as far as the link's depth asks for to first order and then back to
/// the exit by the secant method; where that leads nowhere, in increments of dTheta for the fastest
/// joint. g is the outward normal of the ellipsoid's level at the link's vertex point P(t*), J(t*) the Jacobian of
/// that point, interpolated between the link's end-points, N the null-space projector of the tip
/// task.
class BqsaSpatial final : public SpatialSearch {
 public:
  explicit BqsaSpatial(const BqsaSettings& settings = {}) : SpatialSearch(settings) {}

  /// @throws std::invalid_argument if the problem is not spatial
  void prepare(const Problem& problem) override;

 private:
  void go_to(int tick) override { obstacles_.go_to(tick); }
  void keep(double distance) override { obstacles_.keep(distance); }
  int first_hit(const Link& link, int from) const override {
    return obstacles_.first_hit(pose_, link, from);
  }
  Infeasible free_link(const StepInput& input, const Link& link, StepOutput& output) override;
  bool free_together(const Eigen::Vector3d& p_WT, const JointBox& box,
                     StepOutput* output) override {
    return release_.release(p_WT, box, q_, pose_, output);
  }

  /// How far the arm moves before the link is asked again.
  enum class Stride { kEstimated, kIncrement };

  Infeasible push_out(const StepInput& input, const Link& link, Stride stride, StepOutput& output,
                      int& increments);
  bool clamping_velocity(const Link& link, int obstacle, JointVector& phi);
  double gap(const Link& link, int obstacle) const {
    return obstacles_.proximity(pose_, link, obstacle).distance - obstacles_.distance(link);
  }
  /// How far beyond its exit a link may end [rad].
  double resolution() const { return std::ldexp(settings_.increment, -settings_.settling); }
  void find_exit(const StepInput& input, const Link& link, int obstacle, double gap_hit,
                 const JointVector& colliding, const JointVector& change);

  ObstacleField<3> obstacles_;
  LinkRelease<3> release_;
  TaskJacobian J_start_, J_end_;  ///< of pose_
};

}  // namespace bqsa
