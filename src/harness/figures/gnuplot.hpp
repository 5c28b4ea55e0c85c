/// @file
/// The program gnuplot.
#pragma once

#include <filesystem>
#include <string>

namespace bqsa::harness {

/// The gnuplot on the search path; empty if there is none.
std::filesystem::path find_gnuplot();

/// Runs a script in its directory.
/// @return what gnuplot printed, nothing if all was well; with the exit status if that is not 0
/// @throws std::system_error if there is no process or pipe to be had
std::string run_gnuplot(const std::filesystem::path& gnuplot, const std::filesystem::path& script);

}  // namespace bqsa::harness
