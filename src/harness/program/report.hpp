/// @file
/// What `run` and `show` print of results.
#pragma once

#include <iosfwd>
#include <vector>

#include "harness/program/commands.hpp"
#include "harness/results/table_row.hpp"

namespace bqsa::harness {

/// Table or summary, and the failed runs if asked for.
void print_report(const std::vector<TableRow>& rows, const ReportOptions& options,
                  std::ostream& out);

}  // namespace bqsa::harness
