#include "harness/claims/claim.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace bqsa::harness::claims {

bool Claim::timing() const {
  return std::any_of(calls.begin(), calls.end(),
                     [](const EstimatorCall& call) { return call.estimator->timing; });
}

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::kConfirmed:
      return "confirmed";
    case Verdict::kCorrected:
      return "confirmed with correction";
    case Verdict::kRefuted:
      return "refuted";
    case Verdict::kUndecided:
      return "not decidable";
  }
  return "";
}

std::string text_of(const Bound& bound) {
  if (!bound.unknown.empty()) return "unknown: " + bound.unknown;
  const std::string unit = bound.unit == "-" ? "" : " " + bound.unit;
  const char* sign = "";
  switch (bound.relation) {
    case Relation::kWithin:
      return fmt::format("within {:.6g} to {:.6g}{}", bound.lower, bound.upper, unit);
    case Relation::kLess:
      sign = "<";
      break;
    case Relation::kAtMost:
      sign = "<=";
      break;
    case Relation::kGreater:
      sign = ">";
      break;
    case Relation::kAtLeast:
      sign = ">=";
      break;
    case Relation::kEqual:
      sign = "==";
      break;
  }
  return fmt::format("{} {:.6g}{}", sign, bound.lower, unit);
}

}  // namespace bqsa::harness::claims
