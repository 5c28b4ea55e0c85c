/// @file
/// A motion of an arm along the path of a problem, and how close its links come to obstacles.
#pragma once

#include <cstddef>
#include <vector>

#include "bqsa/method.hpp"
#include "bqsa/problem.hpp"
#include "harness/generator/placed_shape.hpp"

namespace bqsa::harness {

/// Joint angles at the ticks, whatever made them; the obstacles of the problem are not looked at.
class ArmMotion {
 public:
  /// @param q  joint angles at the ticks 0 .. ticks, fewer if the motion ended early [rad]
  ArmMotion(const Problem& problem, std::vector<JointVector> q);

  const Problem& problem() const { return problem_; }
  const ChainPose& pose(int tick) const { return poses_[static_cast<std::size_t>(tick)]; }
  Trajectory trajectory() const;

  /// Whether the joints keep their limits at all ticks.
  bool keeps_limits() const;

  /// Whether the tip error at ticks keeps the tolerance and every step the largest allowed.
  bool tracks() const;

  /// Whether a link (of SerialChain::links) at a tick, with its radius, is closer to the obstacle than `clearance`, or, where that is
  /// negative, deeper in it [m].
  bool is_closer(int tick, std::size_t link, const PlacedShape& obstacle, double clearance) const;

  /// Whether all links are that far away from the obstacle at a tick [m].
  bool is_clear(int tick, const PlacedShape& obstacle, double clearance) const;

 private:
  Problem problem_;
  std::vector<JointVector> q_;
  std::vector<ChainPose> poses_;
};

}  // namespace bqsa::harness
