/// @file
/// A curve in one line of text.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace bqsa::harness::report {

/// Which of the values that share a column it shows.
enum class Shown { kLargest, kSmallest };

/// Blocks of Unicode, `▁` for `bottom` to `█` for `top`, at most so many of them: where there are more values
/// several share one. A space stands where no value is a number.
/// @param columns  positive
std::string sparkline(std::span<const float> values, float bottom, float top, Shown shown,
                      std::size_t columns);

/// Whether text of this process may hold such blocks, by LC_ALL, LC_CTYPE and LANG.
bool locale_is_utf8();

}  // namespace bqsa::harness::report
