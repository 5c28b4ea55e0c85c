/// @file
/// What the runs of each method add up to, by family, by robot and over all scenarios, and who is best
/// or tied.
#pragma once

#include <vector>

#include "harness/report/json.hpp"
#include "harness/report/run_index.hpp"

namespace bqsa::harness::report {

/// `MethodSummary` of the schema: all scenarios first, then each family; then the same of each robot,
/// where two or more have names.
Json summary_json(const std::vector<IndexedRun>& runs, std::size_t methods);

}  // namespace bqsa::harness::report
