/// @file
/// Robot files (schema bqsa-robot/1): an arm with its limits, and where its figures come from.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/scenario/robot_reader.hpp"
#include "harness/scenario/units.hpp"

namespace bqsa::harness {

struct RobotFile {
  std::string name;
  std::string description;
  std::string source;  ///< publication of the figures
  Robot robot;         ///< as the key `robot` of a scenario

  Units units;  ///< of the file

  /// What a scenario with this robot says of it: the keys `units` and `robot` as YAML, each line
  /// ended.
  std::string yaml;
  std::vector<std::string> named;  ///< files that the key `robot` names, from the file's directory
};

/// Reads and validates one robot file, converting to SI units.
/// @throws InputError naming file, line, key, what was expected and what was found
RobotFile load_robot(const std::filesystem::path& file);

}  // namespace bqsa::harness
