/// @file
/// Scenario files (schema bqsa-scenario/1): the only door through which problems enter.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bqsa/problem.hpp"
#include "harness/input_error.hpp"
#include "harness/judge/self_collision.hpp"
#include "harness/judge/true_obstacle.hpp"
#include "harness/scenario/geometry_ledger.hpp"

namespace bqsa::harness {

/// A problem with where it came from.
struct Scenario {
  std::filesystem::path file;
  std::string description;
  /// Of the bytes of this file and of the files it names, one after the other: that of the robot, that
  /// of the path, then those of the obstacles in their order. As `cat FILES | sha256sum` prints it.
  std::string sha256;
  Problem problem;                                   ///< its name is the scenario's
  std::vector<TrueObstacle> truth;                   ///< for the judge alone
  std::optional<SelfCollision> self_collision = {};  ///< if it is judged, which no method is told
  GeometryLedger geometry;
  std::string robot_name = {};  ///< which robot the problem is about; empty if it has no name

  /// Least clearance of a known solution, where the file states one [m]. It tells how narrow the
  /// problem is at most, and decides nothing.
  std::optional<double> reference_clearance = {};
};

struct LoadOptions {
  bool allow_outside = false;  ///< the files that a scenario names may lie outside its directory
};

/// Reads and validates one scenario file, converting to SI units.
/// @throws InputError naming file, line, key, what was expected and what was found
Scenario load_scenario(const std::filesystem::path& file, const LoadOptions& options = {});

}  // namespace bqsa::harness
