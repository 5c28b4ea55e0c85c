/// @file
/// Robot files (schema bqsa-robot/1): an arm with its limits, and where its figures come from.
#pragma once

#include <filesystem>
#include <string>

#include "harness/scenario/robot_reader.hpp"

namespace bqsa::harness {

struct RobotFile {
  std::string name;
  std::string description;
  std::string source;  ///< publication of the figures
  Robot robot;         ///< as the key `robot` of a scenario
};

/// Reads and validates one robot file, converting to SI units.
/// @throws InputError naming file, line, key, what was expected and what was found
RobotFile load_robot(const std::filesystem::path& file);

}  // namespace bqsa::harness
