#include "harness/figures/csv_table.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cmath>

namespace bqsa::harness {

CsvTable::Cell::Cell(double number)
    : text_(std::isfinite(number) ? fmt::format("{:.10g}", number) : "") {}

CsvTable::Cell::Cell(int number) : text_(fmt::format("{}", number)) {}

CsvTable::CsvTable(const std::vector<std::string>& columns)
    : columns_(columns.size()), text_(fmt::format("{}\n", fmt::join(columns, ","))) {}

void CsvTable::add_row(const std::vector<Cell>& cells) {
  assert(cells.size() == columns_);
  for (std::size_t i = 0; i < columns_; ++i) {
    if (i > 0) text_ += ',';
    text_ += cells[i].text();
  }
  text_ += '\n';
}

}  // namespace bqsa::harness
