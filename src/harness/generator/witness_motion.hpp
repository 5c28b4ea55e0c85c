/// @file
/// Witnesses: motions by which generated problems are known to have a solution.
#pragma once

#include <optional>

#include "harness/generator/arm_motion.hpp"
#include "harness/generator/random_stream.hpp"

namespace bqsa::harness {

inline constexpr double kWitnessClearance = 0.010;  ///< of every link from obstacles at ticks [m]
inline constexpr int kWitnessDraws = 10;

/// A motion from the start along the path with a smooth random self-motion, by the hybrid inverse
/// kinematics with W = I and, at the part s of the duration T,
///
///     phi(s) = A / T (pi/2 a sin(pi s) + b sin(2 pi s)),
///
/// a and b uniform in [-1, 1] for each joint, A uniform in 0.3 .. 1.5 rad. It knows nothing of
/// obstacles. Drawn again while it exceeds a joint limit, a largest step or the tolerance; none if
/// all of kWitnessDraws do. Joint angles are of six decimals (`rounded`).
std::optional<ArmMotion> draw_witness(const Problem& problem, RandomStream& random);

/// Whether every link is kWitnessClearance away from the obstacle at all ticks.
bool keeps_clear(const ArmMotion& witness, const PlacedShape& obstacle);

}  // namespace bqsa::harness
