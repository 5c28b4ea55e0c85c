/// @file
/// The keys of `robot`.
#pragma once

#include <string>
#include <vector>

#include "bqsa/problem.hpp"
#include "harness/scenario/units.hpp"
#include "harness/scenario/waypoint_file.hpp"
#include "harness/scenario/yaml_value.hpp"

namespace bqsa::harness {

/// An arm with what bounds it.
struct Robot {
  SerialChain chain;
  JointLimits limits;
  double link_radius = 0;                     ///< of all links, or of the thickest [m]
  std::vector<double> link_radii = {};        ///< each link's own, or none [m]
  std::vector<std::string> joint_names = {};  ///< of a robot in URDF
  std::string name = {};                      ///< empty if it has none
};

/// Reads `robot`: kind planar, dh, mdh or urdf.
Robot read_robot(const YamlValue& value, const Units& units, NamedFiles& files);

}  // namespace bqsa::harness
