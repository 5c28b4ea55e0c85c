/// @file
/// Collision check of the planners: postures, and motions between them with proof.
#pragma once

#include <optional>
#include <vector>

#include "bqsa/batch/motion_filter.hpp"
#include "bqsa/problem.hpp"
#include "bqsa/work_counters.hpp"

namespace bqsa::baselines {

/// Whether links keep radius, margin and a little more from obstacles, by the exact distance.
///
/// Time is continuous: moving obstacles are where their evenly moving, evenly turning way from tick
/// to tick has them at t.
class MotionCheck {
 public:
  /// Kept beyond link radius and margin, so that results do not live on the contact threshold [m].
  static constexpr double kSafety = 1e-5;

  /// Problem and counters must outlive the check. May allocate.
  void assign(const Problem& problem, WorkCounters& counters);

  /// Whether all links of the posture are free at time t [s]. Does not allocate once warm.
  bool is_free(double t, const JointVector& q);

  /// Whether the straight joint motion from q0 at t0 to q1 at t1 >= t0 is free from end to end. For
  /// every link and obstacle, half the motion that both can make is compared with their distance in
  /// the middle; where it does not suffice, the motion is halved, at most kMaxHalvings times, beyond
  /// which it counts as not free. If all obstacles are at rest, the
  /// batched test (motion_filter.hpp) is asked before: it may prove that the motion is free, and else
  /// says nothing, so that the verdict is that of the distance. Does not allocate once warm.
  bool is_free(double t0, const JointVector& q0, double t1, const JointVector& q1);

 private:
  static constexpr int kMaxHalvings = 12;

  struct Pair {
    int link;      ///< index into SerialChain::links
    int obstacle;  ///< index into Problem::obstacles
  };

  bool is_free_between(double t0, const JointVector& q0, double t1, const JointVector& q1,
                       const std::vector<Pair>& pairs, int halvings);
  /// By the batched test; false says nothing.
  bool is_certainly_free(const JointVector& q0, const JointVector& q1);

  void go_to(double t);

  /// How far any point of the link or obstacle gets, at most, from where it is in the middle of the
  /// motion [m].
  /// @param change  of each joint on either side of the middle, not negative [rad, m]
  /// @param travel  furthest that each joint is from 0 [rad, m]
  double link_motion(const Link& link, const JointVector& change, const JointVector& travel) const;
  double obstacle_motion(int obstacle, double t0, double t1) const;

  const Problem* problem_ = nullptr;
  WorkCounters* counters_ = nullptr;
  std::vector<double> clearances_;      ///< of the links' axes [m]
  std::optional<MotionFilter> filter_;  ///< none if an obstacle moves
  std::vector<Pair> all_pairs_;
  std::vector<std::vector<Pair>> open_;      ///< pairs still open at each depth
  std::vector<Ellipsoid> shapes_;            ///< at the time of go_to()
  std::vector<std::vector<double>> travel_;  ///< of a moving obstacle: bound of the way of any of
                                             ///< its points from tick 0 to each tick [m]
  ChainPose pose_;
};

}  // namespace bqsa::baselines
