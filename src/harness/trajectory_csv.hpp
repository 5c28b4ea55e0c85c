/// @file
/// Trajectories as CSV: header `t,q1..qn`, seconds and radians, one row a tick including the start.
#pragma once

#include <filesystem>
#include <string>

#include "bqsa/method.hpp"
#include "harness/input_error.hpp"

namespace bqsa::harness {

/// The text of the file, with all digits, so that reading gives the same numbers. A trajectory
/// without rows gives the header `t` alone; rows of uneven width are written as they are, and reading
/// refuses both.
std::string trajectory_text(const Trajectory& trajectory);

/// Writes that text; the file appears complete or not at all.
/// @throws InputError if the file cannot be written
void write_trajectory(const std::filesystem::path& file, const Trajectory& trajectory);

/// Reads a trajectory of `joints` joints; any number of rows, finite or not (the judge decides).
/// @throws InputError naming file, line, what was expected and found: no file, wrong header, wrong
///   width, text that is not a number, a last line cut short
Trajectory read_trajectory(const std::filesystem::path& file, int joints);

}  // namespace bqsa::harness
