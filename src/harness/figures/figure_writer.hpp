/// @file
/// Figures into a directory.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/figures/figure.hpp"
#include "harness/input_error.hpp"

namespace bqsa::harness {

/// Writes data and script of every figure, and draws it as SVG and PNG where there is a gnuplot.
/// Files that are there are replaced; without gnuplot, pictures that no longer belong to the data are
/// removed.
class FigureWriter {
 public:
  /// @param directory  made if missing
  /// @param gnuplot    as find_gnuplot() gives it; empty: no pictures
  /// @throws InputError if it cannot be made
  FigureWriter(std::filesystem::path directory, std::filesystem::path gnuplot);

  /// @throws InputError if a file cannot be written
  /// @throws std::runtime_error with what gnuplot says if it does not draw without complaint
  void write(const Figure& figure);

  /// Writes `index.md`: a line for each figure written so far.
  /// @throws InputError if it cannot be written
  void write_index(const std::string& heading) const;

  std::size_t figures() const { return rows_.size(); }

 private:
  std::filesystem::path directory_;
  std::filesystem::path gnuplot_;
  std::vector<std::string> rows_;  // of the index
};

}  // namespace bqsa::harness
