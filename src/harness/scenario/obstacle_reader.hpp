/// @file
/// The keys of `obstacles`.
#pragma once

#include <optional>
#include <vector>

#include "bqsa/envelope/cover.hpp"
#include "bqsa/problem.hpp"
#include "harness/judge/true_obstacle.hpp"
#include "harness/scenario/geometry_ledger.hpp"
#include "harness/scenario/path_reader.hpp"
#include "harness/scenario/units.hpp"
#include "harness/scenario/waypoint_file.hpp"
#include "harness/scenario/yaml_value.hpp"

namespace bqsa::harness {

/// The obstacles of a scenario, for methods and for the judge.
struct ScenarioObstacles {
  std::vector<Obstacle> told;       ///< ellipsoids
  std::vector<TrueObstacle> truth;  ///< in the order of the file
  std::vector<LedgerEntry> ledger;  ///< of the solids among them
};

/// Reads the list of obstacles: kind ellipse for a planar robot (`dimension` 2), ellipsoid, sphere or
/// a solid for a spatial one, each at rest or with a motion. Solids are enclosed by ellipsoids; one
/// alone has the name of the obstacle, several also `#` and a number from 1 on. At most 1000
/// ellipsoids in all, obstacles of different names, and those that move at most 1e6 times the ticks
/// of the task in all.
/// @param envelope  of solids that have no own
ScenarioObstacles read_obstacles(const std::optional<YamlValue>& value, const Units& units,
                                 int dimension, const Task& task, const CoverSettings& envelope,
                                 NamedFiles& files);

}  // namespace bqsa::harness
