/// @file
/// Scenario files as a user names them.
#pragma once

#include <filesystem>
#include <vector>

#include "harness/input_error.hpp"

namespace bqsa::harness {

/// The files `*.yaml` of a directory, by name.
/// @throws InputError if it cannot be listed
std::vector<std::filesystem::path> yaml_files(const std::filesystem::path& directory);

/// The files named, with the files `*.yaml` of a directory in its place.
/// @throws InputError for a directory that cannot be listed or holds none
std::vector<std::filesystem::path> with_directories_opened(
    const std::vector<std::filesystem::path>& named);

}  // namespace bqsa::harness
