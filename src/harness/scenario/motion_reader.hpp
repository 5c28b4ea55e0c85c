/// @file
/// The key `motion` of an obstacle.
#pragma once

#include <vector>

#include "bqsa/problem.hpp"
#include "harness/scenario/path_reader.hpp"
#include "harness/scenario/units.hpp"
#include "harness/scenario/waypoint_file.hpp"
#include "harness/scenario/yaml_value.hpp"

namespace bqsa::harness {

/// An obstacle as its other keys describe it.
struct RestingObstacle {
  Ellipsoid shape;
  bool turned = false;  ///< a rotation is written down, be it none
};

/// Reads `motion`, of kind linear or waypoints: where the obstacle is at each tick of the task
/// (Obstacle::motion). Refuses half a turn or more between two ticks, and waypoints that contradict
/// where the other keys put the obstacle at t = 0.
std::vector<Ellipsoid> read_motion(const YamlValue& value, const RestingObstacle& obstacle,
                                   const Units& units, int dimension, const Task& task,
                                   NamedFiles& files);

}  // namespace bqsa::harness
