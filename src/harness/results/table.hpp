/// @file
/// The table that a reader judges methods by.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/results/table_row.hpp"

namespace bqsa::harness {

struct TableStyle {
  bool colour = false;  ///< with the escape sequences of a terminal

  /// Lines to stand below those of a run; none if empty.
  std::function<std::string(const TableRow&)> more = {};
};

/// Plain text, unless the style is another, of at most 120 columns (names longer than that excepted): a block a scenario file, a row a method,
/// notes below the rows that need them, a legend with the definition of success. Blocks and rows
/// stand in the order of first appearance; of several runs of the same scenario file,
/// variant and repetition the last counts. Files of the same name with other bytes stand apart.
std::string render_table(const std::vector<TableRow>& rows, const TableStyle& style = {});

/// Text between the escape sequences that turn on one of a terminal's renditions and all of them off.
inline constexpr const char* kBold = "1";
inline constexpr const char* kDim = "2";
inline constexpr const char* kRed = "31";
inline constexpr const char* kGreen = "32";
inline constexpr const char* kYellow = "33";
std::string rendered(std::string_view text, const char* rendition, bool colour);

/// The table's word for a failure of the judge, `collides` for `collision`.
std::string verdict_of(const std::string& failure);

/// Stands before the times of external methods, which are measured at the harness' end of a pipe.
inline constexpr const char* kPipeMark = "^";

/// What the mark means, as a line; empty if no row has it.
std::string pipe_legend(const std::vector<TableRow>& rows);

/// What success means, in lines.
std::string_view success_legend();

}  // namespace bqsa::harness
