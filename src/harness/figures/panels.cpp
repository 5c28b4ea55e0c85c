#include "harness/figures/panels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace bqsa::harness {
namespace {

std::string margins(double left, double right, double bottom, double top) {
  return fmt::format(
      "\nset lmargin at screen {:.4f}; set rmargin at screen {:.4f}; set bmargin at screen {:.4f}; "
      "set tmargin at screen {:.4f}\n",
      left, right, bottom, top);
}

/// Characters that are seen of enhanced text.
std::size_t visible_characters(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    const bool continues_character = (static_cast<unsigned char>(c) & 0xc0U) == 0x80U;  // of UTF-8
    return c != '_' && c != '^' && c != '{' && c != '}' && c != '\\' && !continues_character;
  }));
}

}  // namespace

std::string PanelGrid::place(int row, int column) const {
  const double width = (right - left - (columns - 1) * gap_x) / columns;
  const double height = (top - bottom - (rows - 1) * gap_y) / rows;
  const double x = left + column * (width + gap_x);
  const double y = top - (row + 1) * height - row * gap_y;
  return margins(x, x + width, y, y + height);
}

std::string legend_row(const std::vector<LegendEntry>& entries, int width) {
  constexpr double kCharacter = 8.2;  // [pixel], of the font at the size below
  constexpr double kSample = 46;
  constexpr double kGap = 8;     // between sample and text
  constexpr double kSpace = 30;  // between entries
  std::vector<double> widths;
  double total = -kSpace;
  for (const LegendEntry& entry : entries) {
    const auto characters = static_cast<double>(visible_characters(entry.text));
    widths.push_back(kSample + kGap + kCharacter * characters + kSpace);
    total += widths.back();
  }
  std::string text = margins(0, 1, 0.005, 0.055);
  text += fmt::format(R"gp(# the legend
unset border; unset tics; unset grid; unset label; unset arrow; unset object; unset logscale
unset xlabel; unset ylabel; unset title; unset key; unset xzeroaxis
set size noratio
set samples 2
set xrange [0:{}]; set yrange [0:1]
)gp",
                      width);
  std::string samples;
  double x = (width - total) / 2;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const LegendEntry& entry = entries[i];
    text += fmt::format("set label \"{}\" at {:.0f},0.5 left font \",13\"\n", entry.text,
                        x + kSample + kGap);
    const std::string line = fmt::format("[{:.0f}:{:.0f}] 0.5 with ", x, x + kSample);
    if (entry.kind == LegendEntry::kArea) {
      text += fmt::format(
          "set object rectangle from {:.0f},0.2 to {:.0f},0.8 front fillstyle solid border "
          "linecolor "
          "\"#909090\" fillcolor rgb {}\n",
          x, x + kSample, entry.style);
      samples += (samples.empty() ? "" : ", \\\n  ") + line + "dots linecolor bgnd";
    } else {
      samples += (samples.empty() ? "" : ", \\\n  ") + line + "lines " + entry.style;
    }
    if (entry.kind == LegendEntry::kMarkedLine) {
      samples += fmt::format(", \\\n  [{0:.0f}:{0:.0f}.1] 0.5 with points {1}", x + kSample / 2,
                             entry.style);
    }
    x += widths[i];
  }
  return text + "plot sample " + samples + "\n";
}

}  // namespace bqsa::harness
