/// @file
/// How the curves of detectors and methods look, the same in all figures.
#pragma once

#include <string>
#include <string_view>

namespace bqsa::harness {

/// gnuplot's line and point of a detector: families by colour, light or dark, their members by dashes and
/// markers.
std::string detector_style(std::string_view name);

/// The i-th of many styles that differ in lightness, dashes and markers, from 0.
std::string numbered_style(std::size_t index);

/// The name that figures show of a detector, else the name itself; plain().
std::string series_label(std::string_view name);

}  // namespace bqsa::harness
