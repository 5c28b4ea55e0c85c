/// @file
/// What the tests of figures read back.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "harness/figures/figure.hpp"
#include "harness/figures/judged_run.hpp"

namespace bqsa::harness {

/// A CSV as text cells; blank lines are left out.
struct ReadTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  std::size_t column(const std::string& name) const {
    const auto found = std::find(columns.begin(), columns.end(), name);
    if (found == columns.end()) throw std::runtime_error("no column " + name);
    return static_cast<std::size_t>(found - columns.begin());
  }
  const std::string& text(std::size_t row, const std::string& name) const {
    return rows[row].at(column(name));
  }
  double number(std::size_t row, const std::string& name) const {
    return std::stod(text(row, name));
  }
};

inline ReadTable read_table(const CsvTable& csv) {
  ReadTable table;
  std::istringstream lines(csv.text());
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) continue;
    std::vector<std::string> cells;
    std::istringstream words(line + ",");
    for (std::string cell; std::getline(words, cell, ',');) cells.push_back(cell);
    if (table.columns.empty()) {
      table.columns = cells;
    } else {
      EXPECT_EQ(cells.size(), table.columns.size()) << line;
      table.rows.push_back(cells);
    }
  }
  return table;
}

inline ReadTable data_of(const Figure& figure, const std::string& part) {
  for (const auto& [name, table] : figure.data) {
    if (name == part) return read_table(table);
  }
  throw std::runtime_error(figure.name + " has no part '" + part + "'");
}

/// A run of one of the paper's scenarios.
inline JudgedRun run_of(const std::string& scenario, const std::string& method) {
  return judged_run(load_scenario(BQSA_SOURCE_DIR "/scenarios/" + scenario + ".yaml"), method);
}

}  // namespace bqsa::harness
