/// @file
/// Scenario files (schema bqsa-scenario/1): the only door through which problems enter.
#pragma once

#include <filesystem>
#include <string>

#include "bqsa/problem.hpp"
#include "harness/input_error.hpp"

namespace bqsa::harness {

/// A problem with where it came from.
struct Scenario {
  std::filesystem::path file;
  std::string description;
  /// Of the bytes of this file and of the waypoint files it names, one after the other: that of the
  /// path, then those of the obstacles in their order. As `cat FILES | sha256sum` prints it.
  std::string sha256;
  Problem problem;  ///< its name is the scenario's
};

struct LoadOptions {
  bool allow_outside = false;  ///< the files that a scenario names may lie outside its directory
};

/// Reads and validates one scenario file, converting to SI units.
/// @throws InputError naming file, line, key, what was expected and what was found
Scenario load_scenario(const std::filesystem::path& file, const LoadOptions& options = {});

}  // namespace bqsa::harness
