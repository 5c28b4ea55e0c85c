/// @file
/// What all figures of times have in common.
#pragma once

#include <string>
#include <vector>

#include "harness/figures/figure.hpp"
#include "harness/measuring/measurements.hpp"

namespace bqsa::harness {

/// Where times come from, as figures say it.
struct TimesOrigin {
  std::string caption;             ///< one line for the foot of the figure
  std::string against;             ///< why they must not be published; empty if they may
  std::vector<std::string> lines;  ///< of both and more, for the head of the script
};

TimesOrigin times_origin(const MeasurementOrigin& origin);

/// A figure of one or more panels whose drawing has begun with what stands at its foot, and above it if
/// its times must not be published; the commands clear_origin() end that for further panels.
Figure new_times_figure(std::string name, std::string paper, std::string what,
                        const TimesOrigin& origin);
std::string clear_origin();

/// Both axes logarithmic, labelled 10^k.
std::string log_axes();

bool in_space(const Sweep& sweep);

/// Names of all series, those that take longest at the last size they were measured at first: the order
/// of the curves at their ends.
std::vector<std::string> by_last_time(const Sweep& sweep);

}  // namespace bqsa::harness
