/// @file
/// What the spatial BQSA variants share: backward sweeps, and steps along self-motions.
#pragma once

#include "bqsa/backward_search.hpp"

namespace bqsa {

/// Searches from the tip to the base and has every link that hits freed, until a whole sweep finds
/// all links free: a self-motion of the whole arm can push a link that was freed before back in.
/// Variants say what hits and how a link is freed.
class SpatialSearch : public BackwardSearch {
 public:
  /// @throws std::invalid_argument if the problem is not spatial
  void prepare(const Problem& problem) override;

 protected:
  explicit SpatialSearch(const BqsaSettings& settings) : BackwardSearch(settings) {}

  /// The first obstacle, counted from `from`, that the link hits in pose_; -1 if none.
  virtual int first_hit(const Link& link, int from) const = 0;

  /// Step 4: changes q_ and pose_ until the link hits nothing, and records the clamps. If that
  /// fails, says why.
  virtual Infeasible free_link(const StepInput& input, const Link& link, StepOutput& output) = 0;

  /// phi = N direction, N the null-space projector of the tip task in pose_. False if hardly
  /// anything of `direction` is a self-motion.
  bool self_motion(const JointVector& direction, JointVector& phi);

  /// q_ = from + change, then corrected until the tip is on its path. False if it stays off it.
  /// To be called after `self_motion` at `from`.
  bool move(const StepInput& input, const JointVector& from, const JointVector& change);

  /// Takes back as much of the last move, made from `colliding`, as leaves the link free.
  void settle(const StepInput& input, const Link& link, const JointVector& colliding,
              const JointVector& change);

  /// Enters into the clamps from `first` on how the link was freed, from q_start to q_.
  void complete_clamps(int first, const JointVector& q_start, int increments, StepOutput& output);

 private:
  Infeasible free_links(const StepInput& input, StepOutput& output) final;

  TaskJacobian J_tip_;  ///< where `self_motion` was last asked
  TrackingIk ik_;       ///< of J_tip_
};

}  // namespace bqsa
