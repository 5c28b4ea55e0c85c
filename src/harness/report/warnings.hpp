/// @file
/// What a reader of a page has to know before believing its figures.
#pragma once

#include <string>
#include <vector>

#include "harness/exchange/exported_runs.hpp"
#include "harness/report/run_index.hpp"

namespace bqsa::harness::report {

/// Why figures are not publishable, and what is missing.
/// @param planned  runs of the campaign's plan; 0 without one
std::vector<std::string> warnings(const ExportedRuns& runs, const RunIndex& index, int planned);

}  // namespace bqsa::harness::report
