/// @file
/// Evaluates claims: figures, outcomes, verdicts, and which no longer hold.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "harness/claims/claim.hpp"
#include "harness/claims/laboratory.hpp"
#include "harness/claims/verdict.hpp"

namespace bqsa::harness::claims {

/// Whether a verdict is the reference's.
enum class Standing {
  kAsExpected,
  kBroken,  ///< another verdict than expected: the claim no longer holds

  /// Nothing is decided: this machine lacks the vector instructions that bounds are given for, or this
  /// build a program that is needed; or the claim rests on times, and the gate's self-test failed, or
  /// intervals reach across a bound.
  kNotDecidedHere,
};

struct EvaluatedClaim {
  const Claim* claim;
  std::vector<Figure> figures = {};  ///< of all its estimators, named as in bounds
  std::vector<std::string> remarks = {};
  std::vector<Outcome> as_stated = {};  ///< one a bound
  std::vector<Outcome> corrected = {};
  Verdict verdict = Verdict::kUndecided;
  Standing standing = Standing::kAsExpected;
  std::string reason = {};    ///< why nothing was decided here; else empty
  std::string not_here = {};  ///< what machine or build lack for it; else empty

  const FigureDeclaration* declaration_of(const Figure& figure) const;
};

/// What is known of the times that claims rest on.
struct TimesState {
  std::vector<std::string> reasons_against;  ///< as of reasons_against_times()
};

/// In the order of the claims. No claim on times is decided unless there are claims marked `gate` and
/// all of them are confirmed.
/// @param claims    outlive the result
/// @param starting  told of every claim before it is evaluated; may be empty
/// @throws InputError naming the claim if an argument means nothing
std::vector<EvaluatedClaim> evaluate(const std::vector<Claim>& claims, Laboratory& laboratory,
                                     const TimesState& times,
                                     const std::function<void(const Claim&)>& starting = {});

/// Whether any claim no longer holds.
bool any_broken(const std::vector<EvaluatedClaim>& claims);

}  // namespace bqsa::harness::claims
