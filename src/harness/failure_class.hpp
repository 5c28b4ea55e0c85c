/// @file
/// Why a reactive method may have given up: what the problem offers at that tick.
#pragma once

#include <limits>

#include "bqsa/method.hpp"

namespace bqsa::harness {

/// In the order in which they are asked; the first that holds is the class.
enum class FailureClass {
  kSingular,  ///< the method's correction diverged, or the arm is next to a singularity
  kMissed,    ///< there was a way within this tick: the exact search finds one
  kLate,      ///< there was a way, but too far for one tick: found once joints may step further
  kNoRoom,    ///< no free posture was found; that none exists is not proven
  kBranch,    ///< free postures exist, but no way leads there in one tick
};

struct Diagnosis {
  FailureClass failure = FailureClass::kSingular;

  /// kBranch: largest joint difference to the nearest free posture found, an upper bound of that to
  /// the nearest one [rad]; else not a number.
  double nearest_free = std::numeric_limits<double>::quiet_NaN();
};

/// Looks for ways out of where a method gave up. This is an analysis for people, which no verdict
/// and no method depends on. It knows nothing of the method but the reason it gave.
///
///   1. kSingular: `reason` is kDiverged, or the smallest singular value of the tip's Jacobian at q
///      is below s_0 of the BQSA settings, for arms that reach less than 1 m in proportion to the
///      reach.
///   2. kMissed: one tick of the exact search (exact_search.hpp), freeing all links at once first,
///      is certified from q to x_d of that tick.
///   3. kLate: the same, if every joint may step 1 rad, or further where it may anyway.
///   4. kNoRoom: of 2000 random postures whose tip is put onto x_d of that tick (tip_closure.hpp),
///      none is within the joint limits and has all links further from all obstacles than link
///      radius and margin. A quarter each are drawn within 0.1, 0.3 and 1 rad of q at every joint,
///      and anywhere.
///   5. kBranch: otherwise.
///
/// The random numbers are the same at every call and on every machine. An arm that the exact search
/// does not take, a planar one with a tool say, is never kMissed or kLate.
///
/// @param tick  at which the method gave up, 1 .. ticks
/// @param q     where the arm was, at tick - 1 [rad]
Diagnosis diagnose(const Problem& problem, int tick, Infeasible reason, const JointVector& q);

const char* name_of(FailureClass failure);

}  // namespace bqsa::harness
