/// @file
/// The keys of `obstacles`.
#pragma once

#include <vector>

#include "bqsa/problem.hpp"
#include "harness/scenario/path_reader.hpp"
#include "harness/scenario/units.hpp"
#include "harness/scenario/waypoint_file.hpp"
#include "harness/scenario/yaml_value.hpp"

namespace bqsa::harness {

/// Reads the list of obstacles: kind ellipse for a planar robot (`dimension` 2), ellipsoid or
/// sphere for a spatial one, each at rest or with a motion. At most 1000, of different names, and
/// those that move at most 1e6 times the ticks of the task in all.
std::vector<Obstacle> read_obstacles(const YamlValue& value, const Units& units, int dimension,
                                     const Task& task, NamedFiles& files);

}  // namespace bqsa::harness
