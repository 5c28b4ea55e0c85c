/// @file
/// Random scenes of solids around an arm that tracks its path without avoidance.
#pragma once

#include <vector>

#include "harness/generator/nominal_motion.hpp"
#include "harness/generator/random_stream.hpp"
#include "harness/generator/scenario_draft.hpp"

namespace bqsa::harness {

/// A box, cylinder, capsule or sphere put on an outer link as draw_on_link() puts an ellipsoid.
ObstacleDraft draw_solid_on_link(const NominalMotion& nominal, RandomStream& random);

/// The same at some distance from any point of the moving arm, as draw_near().
ObstacleDraft draw_solid_near(const NominalMotion& nominal, RandomStream& random);

/// Two parallel walls on both sides of an outer link at a tick in the middle half. What lies between
/// the walls is 120 to 300 mm wide beside the link's radius on both sides; the link is not in its
/// middle, and may stand in the first wall.
std::vector<ObstacleDraft> draw_corridor(const NominalMotion& nominal, RandomStream& random);

/// Five boards around the end of the path, which is a line: bottom, top, two sides and a back. The shelf
/// is open towards the start of the path.
std::vector<ObstacleDraft> draw_shelf(const NominalMotion& nominal, RandomStream& random);

}  // namespace bqsa::harness
