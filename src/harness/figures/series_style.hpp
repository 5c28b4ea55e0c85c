/// @file
/// How the curves of detectors and methods look, the same in all figures.
#pragma once

#include <string>
#include <string_view>

namespace bqsa::harness {

/// gnuplot's line and point of a detector: families by colour, light or dark, their members by dashes and
/// markers; of a detector without a style of its own a plain black one.
std::string detector_style(std::string_view name);

/// The same of a method, by its place in the list of methods; one that is not there looks like the first.
std::string method_style(std::string_view name);

/// The name that figures show of a detector; plain().
/// @throws InputError if there is no such detector
std::string detector_label(std::string_view name);

}  // namespace bqsa::harness
