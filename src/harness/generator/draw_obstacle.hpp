/// @file
/// Random obstacles on and near the links of an arm that tracks its path without avoidance.
#pragma once

#include <utility>

#include "harness/generator/nominal_motion.hpp"
#include "harness/generator/random_stream.hpp"
#include "harness/generator/scenario_draft.hpp"

namespace bqsa::harness {

/// An obstacle at rest, put on an outer link of the nominal arm at a tick in the middle half, and
/// shifted sideways by part of its size.
ObstacleDraft draw_on_link(const NominalMotion& nominal, RandomStream& random);

/// The same, moving evenly so that it is there at that tick; in half of the draws it turns as well.
ObstacleDraft draw_moving(const NominalMotion& nominal, RandomStream& random);

/// An obstacle at rest, at some distance from any point of the moving arm.
ObstacleDraft draw_near(const NominalMotion& nominal, RandomStream& random);

/// Planar: two obstacles at rest on both sides of an outer link at a tick in the middle half, so
/// that a gap between parallel tangents is left; the link stands beside the gap, in the first of
/// the two.
std::pair<ObstacleDraft, ObstacleDraft> draw_gap(const NominalMotion& nominal,
                                                 RandomStream& random);

}  // namespace bqsa::harness
