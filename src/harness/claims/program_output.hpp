/// @file
/// What another program of the same build prints: some figures cannot be found in this one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bqsa::harness::claims {

/// Runs a program to its end; what it says on standard error appears there.
/// @return its standard output
/// @throws std::runtime_error if it cannot be started, or ends with another status than 0
std::string program_output(const std::filesystem::path& program,
                           const std::vector<std::string>& arguments);

}  // namespace bqsa::harness::claims
