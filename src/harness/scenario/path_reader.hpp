/// @file
/// The keys of `task`.
#pragma once

#include "harness/scenario/orientation_reader.hpp"
#include "harness/scenario/path.hpp"
#include "harness/scenario/units.hpp"
#include "harness/scenario/waypoint_file.hpp"
#include "harness/scenario/yaml_value.hpp"

namespace bqsa::harness {

/// What the tip has to do.
struct Task {
  Path path;
  Profile profile = Profile::kLinear;
  double duration = 0;  ///< [s]
  int ticks = 0;
  Turning turning = {};  ///< orientation of the tip, if the task has one
};

/// Reads `task: {path, timing, orientation}`.
/// @param dimension  of the robot's task: 2 or 3
Task read_task(const YamlValue& value, const Units& units, int dimension, NamedFiles& files);

}  // namespace bqsa::harness
