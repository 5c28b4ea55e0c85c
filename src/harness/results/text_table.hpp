/// @file
/// Aligned columns of plain text.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace bqsa::harness {

/// No line of a table is longer, names that alone are longer excepted.
inline constexpr std::size_t kTableWidth = 120;

/// Rows of cells under a head of two lines. The first column, of names, takes the room that the
/// others leave; a name that is longer stands on a line of its own.
class TextTable {
 public:
  struct Column {
    std::string head;
    std::string unit;       ///< second line of the head
    bool left = false;      ///< aligned to the left
    bool optional = false;  ///< left out if all its cells are empty or "0"
  };

  explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}

  void add_row(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }

  /// A line above the rows of a group.
  void add_heading(std::string text) { rows_.push_back({std::move(text)}); }

  std::string text() const;

 private:
  bool is_heading(const std::vector<std::string>& row) const { return row.size() == 1; }
  std::vector<std::size_t> shown_columns() const;

  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

/// Three significant digits, as short as they allow; "-" where there is no number.
std::string figure(double value);

}  // namespace bqsa::harness
