/// @file
/// Tip error and clearance of runs over their ticks, as lines of text.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "harness/results/table_row.hpp"

namespace bqsa::harness {

/// A function that gives two lines for a run of a results directory, of its tip error and its clearance; none
/// where its trajectory or its scenario is not found, or the locale has no blocks to draw with.
/// @param colour  with the escape sequences of a terminal
/// The function throws InputError if there are no records.
std::function<std::string(const TableRow&)> curves_of_runs(const std::filesystem::path& directory,
                                                           bool colour);

}  // namespace bqsa::harness
