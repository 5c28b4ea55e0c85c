/// @file
/// The numbers behind a figure, as CSV.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace bqsa::harness {

/// A header line and rows of cells. Numbers have ten significant digits; what is not a number is an
/// empty cell, which gnuplot leaves out. A blank line between rows is where gnuplot lifts the pen.
class CsvTable {
 public:
  /// A number or a name without commas.
  class Cell {
   public:
    Cell(double number);  // NOLINT: a cell is written as what it holds
    Cell(int number);     // NOLINT
    Cell(std::string name) : text_(std::move(name)) {}  // NOLINT

    const std::string& text() const { return text_; }

   private:
    std::string text_;
  };

  explicit CsvTable(const std::vector<std::string>& columns);

  /// @param cells  as many as there are columns
  void add_row(const std::vector<Cell>& cells);

  void lift_pen() { text_ += '\n'; }

  const std::string& text() const { return text_; }

 private:
  std::size_t columns_;
  std::string text_;
};

}  // namespace bqsa::harness
