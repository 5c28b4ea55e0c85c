/// @file
/// Several panels and one legend in one figure, as gnuplot commands.
#pragma once

#include <string>
#include <vector>

namespace bqsa::harness {

/// Panels of equal size in rows and columns; lengths are parts of the figure's width or height.
struct PanelGrid {
  int rows;
  int columns;
  double left = 0.09;  ///< of the first column's left axis
  double right = 0.98;
  double bottom = 0.16;
  double top = 0.93;
  double gap_x = 0.09;
  double gap_y = 0.05;

  /// The command that puts the next panel there, both counted from 0, row 0 on top.
  std::string place(int row, int column) const;
};

/// One line of a legend.
struct LegendEntry {
  enum Kind { kLine, kMarkedLine, kArea };

  Kind kind;
  std::string style;  ///< of gnuplot, as `linestyle 1`; of an area its fill colour, as `"#dcdcdc"`
  std::string text;   ///< enhanced
};

/// A row at the bottom of the figure with nothing but a legend, to be drawn after all panels. Unlike
/// gnuplot's own, its columns are only as wide as their texts.
/// @param width  of the figure [pixel]
std::string legend_row(const std::vector<LegendEntry>& entries, int width);

}  // namespace bqsa::harness
