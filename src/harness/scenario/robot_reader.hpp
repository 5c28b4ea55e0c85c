/// @file
/// The keys of `robot`.
#pragma once

#include "bqsa/problem.hpp"
#include "harness/scenario/units.hpp"
#include "harness/scenario/yaml_value.hpp"

namespace bqsa::harness {

/// An arm with what bounds it.
struct Robot {
  SerialChain chain;
  JointLimits limits;
  double link_radius = 0;  ///< [m]
};

/// Reads `robot`: kind planar, dh or mdh.
Robot read_robot(const YamlValue& value, const Units& units);

}  // namespace bqsa::harness
