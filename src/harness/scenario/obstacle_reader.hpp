/// @file
/// The keys of `obstacles`.
#pragma once

#include <vector>

#include "bqsa/problem.hpp"
#include "harness/scenario/units.hpp"
#include "harness/scenario/yaml_value.hpp"

namespace bqsa::harness {

/// Reads the list of obstacles: kind ellipse for a planar robot (`dimension` 2), ellipsoid or
/// sphere for a spatial one. At most 1000, of different names.
std::vector<Obstacle> read_obstacles(const YamlValue& value, const Units& units, int dimension);

}  // namespace bqsa::harness
