#include "harness/figures/panels.hpp"

#include <fmt/format.h>

namespace bqsa::harness {
namespace {

std::string margins(double left, double right, double bottom, double top) {
  return fmt::format(
      "\nset lmargin at screen {:.4f}; set rmargin at screen {:.4f}; set bmargin at screen {:.4f}; "
      "set tmargin at screen {:.4f}\n",
      left, right, bottom, top);
}

}  // namespace

std::string PanelGrid::place(int row, int column) const {
  const double width = (right - left - (columns - 1) * gap_x) / columns;
  const double height = (top - bottom - (rows - 1) * gap_y) / rows;
  const double x = left + column * (width + gap_x);
  const double y = top - (row + 1) * height - row * gap_y;
  return margins(x, x + width, y, y + height);
}

std::string legend_strip(const std::string& entries) {
  return margins(0.03, 0.97, 0.005, 0.055) + fmt::format(R"gp(# the legend
unset border; unset tics; unset grid; unset label; unset arrow; unset logscale
unset xlabel; unset ylabel; unset title
set size noratio
set key center center horizontal samplen 3 width 1 font ",13"
plot [0:1][0:1] {}
)gp",
                                                         entries);
}

}  // namespace bqsa::harness
