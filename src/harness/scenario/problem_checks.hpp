/// @file
/// Can the problem be started and followed at all? What no method could repair is refused at the
/// door.
#pragma once

#include <vector>

#include "bqsa/problem.hpp"
#include "harness/judge/true_obstacle.hpp"
#include "harness/scenario/path_reader.hpp"
#include "harness/scenario/units.hpp"
#include "harness/scenario/yaml_value.hpp"

namespace bqsa::harness {

/// Refuses a start beyond the joint limits or with a link in an obstacle or nearer to one than the
/// margin. Either may be missed by 1e-6 m: the judge calls that touching, and free. Obstacles count
/// as they are: within the ellipsoids around a solid, but not in it, is free.
void check_start(const YamlValue& value, const Problem& problem,
                 const std::vector<TrueObstacle>& truth, const Units& units);

/// Refuses a path that begins farther than `start_tolerance` [m] from the tip at the start, leaves
/// the space that the arm's lengths let it reach (joint limits not considered), or enters an
/// obstacle, the tip taken as a ball of the link radius. Of an obstacle at rest the path must keep
/// out as a set of points, of one that moves the tip wherever the two are at the same time. Both
/// hold for the whole motion, to the touching band of 1e-6 m; a path that keeps so near to moving
/// obstacles that 2^21 looks do not show it is refused too. Obstacles count as they are.
void check_path(const YamlValue& value, const Problem& problem,
                const std::vector<TrueObstacle>& truth, const Task& task, double start_tolerance,
                const Units& units);

/// Refuses an orientation that begins further than `tolerance` [rad] from that of the tip at the start.
void check_start_orientation(const YamlValue& value, const Problem& problem, double tolerance,
                             const Units& units);

}  // namespace bqsa::harness
