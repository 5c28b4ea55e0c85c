/// @file
/// Whether the links stay out of the obstacles during the whole of a straight joint motion, the
/// obstacles' own motion meanwhile included: a proof by bisection, not a sampling.
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

/// Follows q(s) = from + s (to - from) for s in [0, 1], while the obstacles make their motion to a
/// tick.
///
/// A sub-interval of half width h is read at its midpoint. A pair is free on it if its clearance
/// there exceeds what the motion can take away. Two bounds of that hold, and the better counts:
/// - no point of the link goes further than h sum_j |dq_j| r(j, link), r the speed_bound of
///   JudgeKinematics with the larger of each |q_i| at both ends, and the obstacle comes no nearer than
///   by h ObstacleTrack::travel;
/// - the plane that proves the clearance moves with the obstacle, and as seen from there the ends e
///   of the link approach it by at most h |normal . u_e| + h²/2 b_e, with u_e their velocity at the
///   midpoint and b_e a bound of their acceleration. For an obstacle at rest u_e is the velocity
///   v_e in W, and b_e = sum_jk |dq_j| |dq_k| r(max(j, k), e), but 0 where joint min(j, k) slides:
///   the second derivative of a point by q_j and q_k, j <= k, is axis_j x (dP/dq_k) if joint j turns,
///   with dP/dq_k = axis_k x arm_k or, if joint k slides, axis_k; and a joint j that slides turns
///   nothing. Seen from an obstacle whose centre c
///   moves by c' and which turns by w, u_e = v_e - c' - w x (e - c), and the Coriolis and the
///   centrifugal term add 2 |w| (|v_e| + |c'|) + |w|² |e - c| to b_e.
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

  /// For each of LinkScene::pairs(), a bound of what the motion can take from its clearance [m].
  std::vector<double> travel(const Eigen::VectorXd& from, const Eigen::VectorXd& to,
                             int tick) const;

  /// @param tick   that the motion leads to, for the obstacles
  /// @param pairs  those to be followed
  /// @param limit  largest number of visits; pairs open when it is reached are undecided
  /// @param known  look until the least clearance of the pairs is found if it is below this [m];
  ///               by default only freedom is asked for
  MotionVerdict follow(const Eigen::VectorXd& from, const Eigen::VectorXd& to, int tick,
                       const std::vector<LinkObstaclePair>& pairs, long limit,
                       double known = -std::numeric_limits<double>::infinity()) const;

 private:
  const LinkScene& scene_;
};

/// Bounds of the speed and the acceleration of each point of the chain on a motion, for s in [0, 1].
struct PointBounds {
  std::vector<double> speed;         ///< [m]
  std::vector<double> acceleration;  ///< [m]
};

/// @param change  of the joints over the motion; zero for those that are taken to be at rest [rad, m]
/// @param travel  how far the prismatic joints are from 0, at most [m]
PointBounds point_bounds(const JudgeKinematics& kinematics, const Eigen::VectorXd& change,
                         const Eigen::VectorXd& travel);

/// How far the joints are from 0 on the straight motion from `from` to `to`, at most.
Eigen::VectorXd travel_of(const Eigen::VectorXd& from, const Eigen::VectorXd& to);

/// How far the least clearance found may lie above the true one [m].
double clearance_resolution(double clearance);

/// Position q(s) on the straight motion from `from` to `to`.
Eigen::VectorXd between(const Eigen::VectorXd& from, const Eigen::VectorXd& to, double s);

}  // namespace bqsa::harness
