/// @file
/// Whether the links stay out of the obstacles during the whole of a straight joint motion: a proof
/// by bisection, not a sampling.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "harness/judge/link_scene.hpp"

namespace bqsa::harness {

/// What was found of a motion.
struct MotionVerdict {
  std::vector<LinkObstaclePair> colliding;
  std::vector<LinkObstaclePair> undecided;  ///< neither proven free nor found colliding
  bool touching = false;  ///< a visited configuration is within the touching band of contact
  double clearance = std::numeric_limits<double>::infinity();  ///< least one visited [m]
  /// For each pair followed: bound that its clearance was proven not to fall below [m]. Means
  /// nothing for one that is colliding or undecided.
  std::vector<double> proven;
  std::string contradiction;  ///< the first of the two checkers, with its pair
  long visits = 0;            ///< pairs read
};

/// Follows q(s) = from + s (to - from) for s in [0, 1].
///
/// A sub-interval of half width h is read at its midpoint. A pair is free on it if its clearance
/// there exceeds what the motion can take away. Two bounds of that hold, and the better counts:
/// - no point of the link goes further than h sum_j |dq_j| reach(j, link);
/// - the plane that proves the clearance stays, and the ends e of the link approach it by at most
///   h |normal . v_e| + h²/2 sum_jk |dq_j| |dq_k| reach(max(j, k), e), with v_e their velocity at
///   the midpoint. The double sum bounds their acceleration: the second derivative of a point by
///   q_j and q_k, j <= k, is axis_j x (axis_k x arm_k).
///
/// Pairs not free are bisected until the bound has fallen below the touching band. A clearance
/// below -Judge::kTouching at any midpoint is a collision; a pair that is still open when the bound
/// is a small part of the band touches, and counts as free.
///
/// Where a clearance already known is given, the bisection is branch and bound as well: a
/// sub-interval is left only when its bound is not below the least clearance found so far by more
/// than clearance_resolution.
class MotionCheck {
 public:
  explicit MotionCheck(const LinkScene& scene) : scene_(scene) {}

  /// For each link, a bound of the way that any of its points goes [m].
  std::vector<double> travel(const Eigen::VectorXd& from, const Eigen::VectorXd& to) const;

  /// @param pairs  those to be followed
  /// @param limit  largest number of visits; pairs open when it is reached are undecided
  /// @param known  look until the least clearance of the pairs is found if it is below this [m];
  ///               by default only freedom is asked for
  MotionVerdict follow(const Eigen::VectorXd& from, const Eigen::VectorXd& to,
                       const std::vector<LinkObstaclePair>& pairs, long limit,
                       double known = -std::numeric_limits<double>::infinity()) const;

 private:
  const LinkScene& scene_;
};

/// How far the least clearance found may lie above the true one [m].
double clearance_resolution(double clearance);

/// Position q(s) on the straight motion from `from` to `to`.
Eigen::VectorXd between(const Eigen::VectorXd& from, const Eigen::VectorXd& to, double s);

}  // namespace bqsa::harness
