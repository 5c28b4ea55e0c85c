/// @file
/// Several panels and one legend in one figure, as gnuplot commands.
#pragma once

#include <string>

namespace bqsa::harness {

/// Panels of equal size in rows and columns; lengths are parts of the figure's width or height.
struct PanelGrid {
  int rows;
  int columns;
  double left = 0.08;  ///< of the first column's left axis
  double right = 0.98;
  double bottom = 0.16;
  double top = 0.93;
  double gap_x = 0.09;
  double gap_y = 0.05;

  /// The command that puts the next panel there, both counted from 0, row 0 on top.
  std::string place(int row, int column) const;
};

/// A strip at the bottom of the figure with nothing but a legend, to be drawn after all panels.
/// All entries get as much room as the longest needs; what does not fit in one row is ugly.
/// @param entries  plot elements of `NaN`, as `NaN with lines linestyle 1 title "a", ...`
std::string legend_strip(const std::string& entries);

}  // namespace bqsa::harness
