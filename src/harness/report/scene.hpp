/// @file
/// What a page draws of a scenario: arm, obstacles as they are and as methods are told, desired path.
#pragma once

#include <cstddef>

#include "harness/report/json.hpp"
#include "harness/scenario/scenario.hpp"

namespace bqsa::harness::report {

/// A `Scene` of the schema.
Json scene_json(const Scenario& scenario);

/// About how long that is as text [byte].
std::size_t scene_size(const Scenario& scenario);

}  // namespace bqsa::harness::report
