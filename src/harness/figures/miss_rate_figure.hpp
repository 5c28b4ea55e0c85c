/// @file
/// What speed at equal test points does not say: time against the hits that are missed.
#pragma once

#include <cstdint>
#include <vector>

#include "harness/figures/figure.hpp"
#include "harness/figures/times_figure.hpp"
#include "harness/measuring/miss_rate.hpp"
#include "harness/measuring/sweep.hpp"

namespace bqsa::harness {

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
