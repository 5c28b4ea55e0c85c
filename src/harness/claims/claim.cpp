#include "harness/claims/claim.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace bqsa::harness::claims {

bool Claim::timing() const {
  return std::any_of(calls.begin(), calls.end(),
                     [](const EstimatorCall& call) { return call.estimator->timing; });
}

namespace {

void choose_numbers(std::vector<Bound>& bounds, std::string_view instruction_set) {
  for (Bound& bound : bounds) {
    if (bound.numbers.empty()) continue;
    const auto number = std::find_if(
        bound.numbers.begin(), bound.numbers.end(),
        [&](const NumberOfSet& one) { return one.instruction_set == instruction_set; });
    bound.not_here.clear();
    if (number == bound.numbers.end()) {
      bound.not_here =
          fmt::format("vector instructions are {}, bounds are {}", instruction_set, text_of(bound));
    } else {
      bound.lower = bound.upper = number->value;
    }
  }
}

/// `400 with AVX3, 200 with AVX2`.
std::string all_numbers(const Bound& bound) {
  std::string text;
  for (const auto& [instruction_set, value] : bound.numbers) {
    text += fmt::format("{}{:.6g} with {}", text.empty() ? "" : ", ", value, instruction_set);
  }
  return text;
}

}  // namespace

void choose_numbers(std::vector<Claim>& claims, std::string_view instruction_set) {
  for (Claim& claim : claims) {
    choose_numbers(claim.as_stated, instruction_set);
    if (claim.corrected) choose_numbers(claim.corrected->bounds, instruction_set);
  }
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
  const std::string number =
      bound.numbers.empty() ? fmt::format("{:.6g}", bound.lower) : all_numbers(bound);
  return fmt::format("{} {}{}", sign, number, unit);
}

}  // namespace bqsa::harness::claims
