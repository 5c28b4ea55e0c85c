/// @file
/// Figs. 5 and 6 of the paper and what has to stand beside them: times of detectors and control steps
/// over sizes.
#pragma once

#include <string>
#include <vector>

#include "harness/figures/figure.hpp"
#include "harness/measuring/measurements.hpp"
#include "harness/measuring/miss_rate.hpp"

namespace bqsa::harness {

/// Where times come from, as figures say it.
struct TimesOrigin {
  std::string caption;             ///< one line for the foot of the figure
  std::vector<std::string> lines;  ///< for the head of the script
};

TimesOrigin times_origin(const MeasurementOrigin& origin);

/// Figs. 5 and 6 as the paper draws them: linear axes, test points and BQSA in the paper's form, by the
/// paper's protocol, the mean of 100 repeats. Sizes of which the mean was not taken are left out.
/// @param sweep  `plane_nm` gives Fig. 5, `plane_nk` Fig. 6
Figure paper_times(const Sweep& sweep, const TimesOrigin& origin);

/// The same two series by our own estimator, with 95 % intervals over processes, lines fitted, and along
/// NM the crossover, predicted from the paper's count and measured.
Figure estimated_times(const Sweep& sweep, const TimesOrigin& origin);

/// All detectors of a sweep, those of the plane or of space.
Figure fair_times(const Sweep& sweep, const TimesOrigin& origin);

/// Whole control steps of all methods.
/// @param sweep  `step_nk` or `space_step_nk`
Figure step_times(const Sweep& sweep, const TimesOrigin& origin);

/// What detectors miss of two populations.
struct MissRates {
  std::vector<MissRate> anywhere;
  std::vector<MissRate> first_contact;
};

/// Of all detectors of a sweep along NM, and at each of its sizes of those that sample.
MissRates miss_rates(const Sweep& sweep, std::uint64_t seed);

/// Time a pair against the share of hits that are missed, for all detectors of a sweep along NM; those
/// that miss none stand at a mark of their own.
Figure times_against_miss_rate(const Sweep& sweep, const MissRates& misses,
                               const TimesOrigin& origin);

}  // namespace bqsa::harness
