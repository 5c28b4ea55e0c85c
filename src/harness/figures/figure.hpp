/// @file
/// A figure before it is drawn: its data, and how gnuplot is to draw them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "harness/figures/csv_table.hpp"

namespace bqsa::harness {

struct Figure {
  std::string name;   ///< of its files: `fig08_planar_configurations`
  std::string paper;  ///< where it stands in the paper: `Fig. 8`; `-` if it does not
  std::string what;   ///< one sentence without a full stop

  /// Data files by what follows the name of the figure in theirs: "" for NAME.csv, "tip" for
  /// NAME_tip.csv.
  std::vector<std::pair<std::string, CsvTable>> data = {};

  /// Where the data come from, a line each; in the script.
  std::vector<std::string> provenance = {};

  int width = 1200;  ///< [pixel]
  int height = 800;

  /// The gnuplot commands that draw, in one `set multiplot`. The variable `name` is the name of the
  /// figure, line styles 1 to 8 go from dark to light and differ in dashes and markers too, and data
  /// are read as `using "column"`.
  std::string drawing = {};
};

/// Name of a data file of the figure.
std::string data_file(const std::string& figure, const std::string& part);

/// The whole gnuplot script, which draws NAME.svg and NAME.png in the directory it is run in.
std::string gnuplot_script(const Figure& figure);

/// A name with what gnuplot's enhanced text would take for markup escaped: `bqsa\_paper`.
std::string plain(std::string_view text);

}  // namespace bqsa::harness
