/// @file
/// The key `scenarios` of a campaign file.
#pragma once

#include <filesystem>
#include <vector>

#include "harness/campaign/campaign_file.hpp"
#include "harness/scenario/yaml_value.hpp"

namespace bqsa::harness {

/// What the list names: files that are there, and scenarios to be generated.
struct NamedScenarios {
  std::vector<std::filesystem::path> files;  ///< each once, in the order of the list, then by name
  std::vector<GeneratedScenarios> generated;
};

/// Reads a list of patterns and `generate: {family, seed, count, robots}`. A pattern is one of
/// glob(7); a directory that it matches stands for its files `*.yaml`.
/// @param directory  of the campaign file; patterns, and `robots`, are relative to it
NamedScenarios read_scenarios(const YamlValue& value, const std::filesystem::path& directory);

}  // namespace bqsa::harness
