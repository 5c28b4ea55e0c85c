/// @file
/// A sweep's times as table, curves and words, for the figures of them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "harness/figures/csv_table.hpp"
#include "harness/figures/miss_rate_figure.hpp"
#include "harness/measuring/sweep.hpp"

namespace bqsa::harness {

inline constexpr double kMicrosecond = 1e-6;  ///< [s]

/// `NM` or `nk`, and with what it means.
const char* axis_name(const Sweep& sweep);
const char* axis_label(const Sweep& sweep);

/// What is the same at all sizes, as `nk = 27`.
std::string fixed_text(const Sweep& sweep);

/// The same in a title, where what test points miss is the same at all sizes, with that.
std::string fixed_text(const Sweep& sweep, const MissRates& misses);

std::string time_column(std::string_view series);

/// Times of series over a sweep, with their intervals, and what test points miss.
CsvTable times_table(const Sweep& sweep, const std::vector<std::string>& names,
                     const MissRates& misses);

/// The bars of its intervals, if it has any, and a curve, as plot elements.
std::string curve_with_bars(const Sweep& sweep, const std::string& name, const std::string& style,
                            const std::string& label);

/// What test points miss, along NM.
std::string upper_axis(const Sweep& sweep, const MissRates& misses);

}  // namespace bqsa::harness
