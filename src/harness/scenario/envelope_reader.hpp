/// @file
/// The key `envelope`: how closely ellipsoids have to enclose a solid.
#pragma once

#include <optional>

#include "bqsa/envelope/cover.hpp"
#include "harness/scenario/units.hpp"
#include "harness/scenario/yaml_value.hpp"

namespace bqsa::harness {

/// Where a scenario says nothing: up to 8 ellipsoids for each convex part, more than one if it
/// inflates by more than 50 mm; none thinner than 1 mm on either side of its middle.
CoverSettings default_envelope();

/// Reads `{inflation, volume_ratio, max_ellipsoids, least_semi_axis}`; what is absent is as in
/// `defaults`.
CoverSettings read_envelope(const std::optional<YamlValue>& value, const Units& units,
                            const CoverSettings& defaults);

}  // namespace bqsa::harness
