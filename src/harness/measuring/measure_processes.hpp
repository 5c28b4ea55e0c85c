/// @file
/// Measuring in several processes, one after the other: what a process is lucky or unlucky with, where
/// its code and data lie for instance, is not taken for a property of what is measured.
#pragma once

#include <string>
#include <vector>

#include "harness/measuring/sweep.hpp"

namespace bqsa::harness {

/// Runs `COMMAND --process I --out FILE` for I from 1 on, afresh each time, and pools the measurements in
/// the files. What it says on standard error appears there.
/// @param command    a program that does what `bqsa-bench measure` does, and its arguments
/// @param processes  at least one
/// @throws std::runtime_error if a process cannot be started, or ends with another status than 0
/// @throws InputError if a file cannot be read
std::vector<Sweep> measure_processes(const std::vector<std::string>& command, int processes);

}  // namespace bqsa::harness
