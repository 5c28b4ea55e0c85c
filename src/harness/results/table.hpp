/// @file
/// The table that a reader judges methods by.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "harness/results/table_row.hpp"

namespace bqsa::harness {

/// Plain text of at most 120 columns (names longer than that excepted): a block a scenario file, a row a method,
/// notes below the rows that need them, a legend with the definition of success. Blocks and rows
/// stand in the order of first appearance; of several runs of the same scenario file,
/// variant and repetition the last counts. Files of the same name with other bytes stand apart.
std::string render_table(const std::vector<TableRow>& rows);

/// The table's word for a failure of the judge, `collides` for `collision`.
std::string verdict_of(const std::string& failure);

/// Stands before the times of external methods, which are measured at the harness' end of a pipe.
inline constexpr const char* kPipeMark = "^";

/// What the mark means, as a line; empty if no row has it.
std::string pipe_legend(const std::vector<TableRow>& rows);

/// What success means, in lines.
std::string_view success_legend();

}  // namespace bqsa::harness
