/// @file
/// Figs. 5 and 6 of the paper and what has to stand beside them: times of detectors and control steps
/// over sizes.
#pragma once

#include "harness/figures/figure.hpp"
#include "harness/figures/miss_rate_figure.hpp"
#include "harness/figures/times_figure.hpp"
#include "harness/measuring/sweep.hpp"

namespace bqsa::harness {

/// Figs. 5 and 6 as the paper draws them: linear axes, test points and BQSA in the paper's form, by the
/// paper's protocol, the mean of 100 repeats.
/// @param sweep   `plane_nm` gives Fig. 5, `plane_nk` Fig. 6
/// @param misses  of its numbers of test points: what stands beside the times of test points, here and
///                below
Figure paper_times(const Sweep& sweep, const MissRates& misses, const TimesOrigin& origin);

/// The same two series by our own estimator, with 95 % intervals over processes, lines fitted, and along
/// NM the crossover, predicted from the paper's count and measured.
Figure estimated_times(const Sweep& sweep, const MissRates& misses, const TimesOrigin& origin);

/// All detectors of a sweep, those of the plane or of space.
Figure fair_times(const Sweep& sweep, const MissRates& misses, const TimesOrigin& origin);

/// Whole control steps of all methods.
/// @param sweep  `step_nk` or `space_step_nk`
Figure step_times(const Sweep& sweep, const TimesOrigin& origin);

}  // namespace bqsa::harness
