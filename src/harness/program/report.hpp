/// @file
/// What `run` and `show` print of results.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "harness/program/commands.hpp"
#include "harness/results/table_row.hpp"

namespace bqsa::harness {

/// Table or summary, and the failed runs if asked for.
/// @param more  lines to stand below those of a run in the table; none if empty
void print_report(const std::vector<TableRow>& rows, const ReportOptions& options,
                  const Console& console,
                  const std::function<std::string(const TableRow&)>& more = {});

}  // namespace bqsa::harness
