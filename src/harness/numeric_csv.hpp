/// @file
/// Tables of numbers as CSV text.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "harness/input_error.hpp"

namespace bqsa::harness {

/// A table as read; row r stands in line r + 2 of its file.
struct NumericTable {
  std::size_t columns = 0;
  std::vector<double> values;  ///< row by row

  std::size_t rows() const { return columns == 0 ? 0 : values.size() / columns; }
  double operator()(std::size_t row, std::size_t column) const {
    return values[row * columns + column];
  }
  static std::size_t line(std::size_t row) { return row + 2; }
};

/// Reads a file of exactly the given header line (names and commas, no blanks) and rows of as many
/// numbers. `nan` and `inf` are numbers here. Lines end in LF or CRLF, the last one too: a file cut
/// short is refused. A byte order mark of UTF-8 at the beginning is skipped.
/// @throws InputError naming file, line, column, what was expected and what was found
NumericTable read_numeric_csv(const std::filesystem::path& file, const std::string& header,
                              std::size_t max_bytes);

/// The same from the content of a file that may have any of several headers.
/// @param file  its name in messages
NumericTable parse_numeric_csv(const std::string& file, std::string_view text,
                               const std::vector<std::string>& headers);

/// Appends the shortest text that reads back as the same number.
void append_number(std::string& text, double number);

}  // namespace bqsa::harness
