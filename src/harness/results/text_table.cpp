#include "harness/results/text_table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace bqsa::harness {
namespace {

constexpr std::size_t kGap = 2;

std::string without_trailing_spaces(const std::string& line) {
  return line.substr(0, line.find_last_not_of(' ') + 1);
}

}  // namespace

std::vector<std::size_t> TextTable::shown_columns() const {
  std::vector<std::size_t> shown;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const bool said = std::any_of(rows_.begin(), rows_.end(), [&](const auto& row) {
      return !is_heading(row) && !row[c].empty() && row[c] != "0";
    });
    if (said || !columns_[c].optional) shown.push_back(c);
  }
  return shown;
}

std::string TextTable::text() const {
  const std::vector<std::size_t> shown = shown_columns();
  std::vector<std::size_t> widths;
  std::size_t others = 0;
  for (const std::size_t c : shown) {
    std::size_t width = std::max(columns_[c].head.size(), columns_[c].unit.size());
    for (const auto& row : rows_) {
      if (!is_heading(row)) width = std::max(width, row[c].size());
    }
    widths.push_back(width);
    if (c > 0) others += width + kGap;
  }
  const std::size_t least = std::max(columns_[0].head.size(), columns_[0].unit.size());
  widths[0] =
      std::min(widths[0], std::max(least, others < kTableWidth ? kTableWidth - others : least));

  std::string text;
  const auto add_line = [&](const auto& cell) {
    std::string line = cell(0);
    if (line.size() > widths[0]) {
      text += line + '\n';
      line.clear();
    }
    line.resize(widths[0], ' ');
    for (std::size_t i = 1; i < shown.size(); ++i) {
      const std::string value = cell(shown[i]);
      const std::string gap(kGap, ' ');
      line += gap + (columns_[shown[i]].left ? fmt::format("{:<{}}", value, widths[i])
                                             : fmt::format("{:>{}}", value, widths[i]));
    }
    text += without_trailing_spaces(line) + '\n';
  };
  add_line([this](std::size_t c) { return columns_[c].head; });
  const bool units = std::any_of(shown.begin(), shown.end(),
                                 [this](std::size_t c) { return !columns_[c].unit.empty(); });
  if (units) add_line([this](std::size_t c) { return columns_[c].unit; });
  for (const auto& row : rows_) {
    if (is_heading(row)) {
      text += row[0] + '\n';
    } else {
      add_line([&row](std::size_t c) { return row[c]; });
    }
  }
  return text;
}

std::string figure(double value) {
  if (!std::isfinite(value)) return "-";
  const double size = std::abs(value);
  if (size == 0) return "0";
  if (size < 1e-3) return fmt::format("{:.1e}", value);
  constexpr double kLongest = 1e6;
  if (size >= kLongest) return fmt::format("{:.1e}", value);
  return size < 100 ? fmt::format("{:.3g}", value) : fmt::format("{:.0f}", value);
}

}  // namespace bqsa::harness
