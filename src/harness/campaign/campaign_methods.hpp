/// @file
/// The key `methods` of a campaign file.
#pragma once

#include <vector>

#include "harness/method_spec.hpp"
#include "harness/scenario/yaml_value.hpp"

namespace bqsa::harness {

/// More would be likely to share one of the names that variants have in results.
inline constexpr int kMostVariants = 10'000;

/// Reads a list of names and of mappings of `method`, `parameters`, and `grid`, the first key of which
/// varies slowest.
/// @param known  the methods that may be named
std::vector<MethodSpec> read_methods(const YamlValue& value, const std::vector<MethodEntry>& known);

}  // namespace bqsa::harness
