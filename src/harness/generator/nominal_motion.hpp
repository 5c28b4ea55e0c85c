/// @file
/// The motion of an arm that tracks its path without avoidance, and what a generated obstacle has
/// to be to it.
#pragma once

#include <vector>

#include "harness/generator/arm_motion.hpp"

namespace bqsa::harness {

inline constexpr double kStartClearance =
    0.010;  ///< of every link from every obstacle at t = 0 [m]
inline constexpr double kTipClearance =
    0.020;  ///< of the tip's path, a ball of the last link's radius [m]
inline constexpr double kInnerClearance = 0.010;  ///< of nominal links 1 and 2 at ticks [m]
inline constexpr double kHitDepth = 0.001;  ///< least depth that is a hit of the nominal arm [m]
inline constexpr int kFirstOuterLink = 3;   ///< number of the first link that is to be hit

/// The method `none` on a problem without obstacles.
class NominalMotion : public ArmMotion {
 public:
  explicit NominalMotion(const Problem& problem);

  /// Whether the desired tip stays at ticks in the shell between two distances from a point [m].
  bool path_within(const Eigen::Vector3d& center, double least, double most) const;

  /// Whether all links at the start are kStartClearance away from the obstacle.
  bool start_is_clear(const PlacedShape& obstacle) const;

  /// Whether the straight lines between the desired tips of neighbouring ticks are kTipClearance
  /// away from the obstacle as it stands at either tick.
  bool path_is_clear(const PlacedShape& obstacle) const;

  /// Whether the links before kFirstOuterLink are at all ticks kInnerClearance away.
  bool inner_links_are_clear(const PlacedShape& obstacle) const;

  /// Whether an outer link is kHitDepth deep in the obstacle at a tick.
  bool outer_link_hits(const PlacedShape& obstacle) const;

 private:
  std::vector<Eigen::Vector3d> desired_;  ///< at the ticks [m]
};

}  // namespace bqsa::harness
