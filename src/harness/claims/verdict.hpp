/// @file
/// From figures to a verdict, by rule. Pure functions.
#pragma once

#include <span>
#include <vector>

#include "harness/claims/claim.hpp"

namespace bqsa::harness::claims {

enum class Outcome { kHolds, kFails, kUndecided };

/// Holds if all of the figure's interval satisfies the bound, fails if none of it does; else, and for
/// a figure that is not there or not a number, or a bound that is unknown or says nothing here, it is
/// undecided. A figure
/// without interval is the interval of its value alone.
Outcome outcome_of(const Bound& bound, std::span<const Figure> figures);

/// All as stated hold: confirmed. One fails: refuted if there is no correction or one of its bounds
/// fails too, confirmed with correction if all of them hold. Otherwise not decidable.
/// @param as_stated  not empty
/// @param corrected  empty if there is no correction
Verdict verdict_of(std::span<const Outcome> as_stated, std::span<const Outcome> corrected);

const char* name_of(Outcome outcome);

}  // namespace bqsa::harness::claims
