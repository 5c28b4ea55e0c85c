/// @file
/// What speed at equal test points does not say: time against the hits that are missed.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
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

/// Those of a detector with the test points of a size; null if it was not asked with them.
const MissRate* miss_of(const std::vector<MissRate>& misses, std::string_view detector,
                        const WorkloadSize& size);

/// Of all detectors of a sweep, and of those that sample with all its numbers of test points.
MissRates miss_rates(const Sweep& sweep, std::uint64_t seed);

/// Of the hits at any place and at first contact, what `test_points` with those of a size miss, for the
/// columns kMissColumns of a table of times; not a number if they were not asked.
inline constexpr std::array kMissColumns{"missed by test points",
                                         "missed by test points at first contact"};
std::array<double, 2> missed_by_test_points(const MissRates& misses, const WorkloadSize& size);

/// An upper axis along NM, in gnuplot's commands, that says what test points miss of the hits at any
/// place; nothing if they were not asked.
std::string miss_axis(const Sweep& sweep, const MissRates& misses);

/// The same of a single size, as `test points miss 1.4 % of hits, 0 % at first contact`.
std::string miss_text(const MissRates& misses, const WorkloadSize& size);

/// Time a pair against the share of hits that are missed, for all detectors of a sweep along NM; those
/// that miss none stand at a mark of their own.
Figure times_against_miss_rate(const Sweep& sweep, const MissRates& misses,
                               const TimesOrigin& origin);

}  // namespace bqsa::harness
