#include "harness/claims/verdict.hpp"

#include <algorithm>
#include <cmath>

namespace bqsa::harness::claims {
namespace {

/// @param all   whether all of the interval satisfies the bound
/// @param none  whether nothing of it does
Outcome outcome(bool all, bool none) {
  if (all) return Outcome::kHolds;
  return none ? Outcome::kFails : Outcome::kUndecided;
}

bool all_hold(std::span<const Outcome> outcomes) {
  return std::all_of(outcomes.begin(), outcomes.end(),
                     [](Outcome one) { return one == Outcome::kHolds; });
}

bool any_fails(std::span<const Outcome> outcomes) {
  return std::find(outcomes.begin(), outcomes.end(), Outcome::kFails) != outcomes.end();
}

}  // namespace

Outcome outcome_of(const Bound& bound, std::span<const Figure> figures) {
  if (!bound.unknown.empty() || !bound.not_here.empty()) return Outcome::kUndecided;
  const auto figure = std::find_if(figures.begin(), figures.end(),
                                   [&](const Figure& one) { return one.name == bound.figure; });
  if (figure == figures.end()) return Outcome::kUndecided;
  const Interval in = figure->interval.value_or(Interval{figure->value, figure->value});
  if (std::isnan(figure->value) || std::isnan(in.lower) || std::isnan(in.upper)) {
    return Outcome::kUndecided;
  }
  switch (bound.relation) {
    case Relation::kLess:
      return outcome(in.upper < bound.lower, in.lower >= bound.lower);
    case Relation::kAtMost:
      return outcome(in.upper <= bound.lower, in.lower > bound.lower);
    case Relation::kGreater:
      return outcome(in.lower > bound.lower, in.upper <= bound.lower);
    case Relation::kAtLeast:
      return outcome(in.lower >= bound.lower, in.upper < bound.lower);
    case Relation::kEqual:
    case Relation::kWithin:
      return outcome(in.lower >= bound.lower && in.upper <= bound.upper,
                     in.upper < bound.lower || in.lower > bound.upper);
  }
  return Outcome::kUndecided;
}

Verdict verdict_of(std::span<const Outcome> as_stated, std::span<const Outcome> corrected) {
  if (all_hold(as_stated)) return Verdict::kConfirmed;
  if (!any_fails(as_stated)) return Verdict::kUndecided;
  if (corrected.empty() || any_fails(corrected)) return Verdict::kRefuted;
  return all_hold(corrected) ? Verdict::kCorrected : Verdict::kUndecided;
}

const char* name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::kHolds:
      return "holds";
    case Outcome::kFails:
      return "fails";
    case Outcome::kUndecided:
      return "undecided";
  }
  return "";
}

}  // namespace bqsa::harness::claims
