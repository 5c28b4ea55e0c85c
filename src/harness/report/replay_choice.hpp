/// @file
/// Which runs a page replays where there are too many.
#pragma once

#include <cstddef>
#include <vector>

#include "harness/report/run_index.hpp"

namespace bqsa::harness::report {

/// Indices of runs with a trajectory, one a scenario and variant, a failed one if there is any: in the order
/// in which they are wanted, failures first, and one of each scenario before a second of any.
std::vector<std::size_t> wanted_replays(const std::vector<IndexedRun>& runs);

}  // namespace bqsa::harness::report
