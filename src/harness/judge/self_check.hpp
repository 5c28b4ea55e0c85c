/// @file
/// Whether the links of an arm keep clear of each other during a whole run, at ticks and between
/// them: a proof by bisection, not a sampling.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "harness/judge/judge.hpp"
#include "harness/judge/self_collision.hpp"

namespace bqsa::harness {

struct SelfVerdict {
  std::vector<SelfContact> contacts;  ///< by first tick
  bool undecided = false;    ///< freedom between ticks could not be proven with the work allowed
  bool touching = false;     ///< came within the touching band of contact
  std::string disagreement;  ///< of the two checkers, the first: where
  double clearance_at_ticks =
      std::numeric_limits<double>::infinity();  ///< least of a pair, with its radii [m]
};

/// Follows q(s) = from + s (to - from), s in [0, 1], from row to row.
///
/// What the motion can take from the clearance of a pair on a sub-interval of half width h around a
/// configuration is bounded as for links and obstacles (motion_check.hpp), as seen from the body of
/// the pair's first link. There the joints before i = SelfScene::first_joint_between() do nothing, so
/// that a point p has the speed of the joints i, i + 1, ... alone, at most sum_j |dq_j| reach(j, p),
/// and of the acceleration no more than sum_jk |dq_j| |dq_k| reach(max(j, k), p). Both links move by
/// that; the first one does not, where its own joint leaves both its ends at rest. The better of two
/// bounds counts:
/// - the distance shrinks by at most h times the sum of both links' largest speeds;
/// - each end e of either link approaches the plane that proves the clearance, which rests in that
///   body, by at most h |normal . v_e| + h²/2 a_e, v_e being its velocity at the midpoint.
///
/// @param limit  largest number of pairs read between ticks; what is open then is undecided
SelfVerdict check_self_collision(const SelfScene& scene, const std::vector<Eigen::VectorXd>& rows,
                                 long limit);

}  // namespace bqsa::harness
