#include "harness/claims/evaluation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace bqsa::harness::claims {
namespace {

std::vector<Outcome> outcomes_of(const std::vector<Bound>& bounds,
                                 const std::vector<Figure>& figures) {
  std::vector<Outcome> outcomes;
  outcomes.reserve(bounds.size());
  for (const Bound& bound : bounds) outcomes.push_back(outcome_of(bound, figures));
  return outcomes;
}

/// Why the first of the bounds that say nothing here does not; empty if all do.
std::string not_here(const Claim& claim) {
  std::vector<Bound> bounds = claim.as_stated;
  if (claim.corrected) {
    bounds.insert(bounds.end(), claim.corrected->bounds.begin(), claim.corrected->bounds.end());
  }
  for (const Bound& bound : bounds) {
    if (!bound.not_here.empty()) return bound.not_here;
  }
  return {};
}

EvaluatedClaim evaluate_one(const Claim& claim, Laboratory& laboratory) {
  EvaluatedClaim result{.claim = &claim, .not_here = not_here(claim)};
  for (const EstimatorCall& call : claim.calls) {
    Findings findings;
    try {
      findings = call.estimator->estimate(call.arguments, laboratory);
    } catch (const InputError& error) {
      throw InputError(
          fmt::format("claim {}: estimator {}: {}", claim.id, call.estimator->name, error.what()));
    }
    for (Figure& figure : findings.figures) {
      figure.name = call.prefix + figure.name;
      result.figures.push_back(std::move(figure));
    }
    if (result.not_here.empty()) result.not_here = findings.not_here;
    for (std::string& remark : findings.remarks) {
      const std::string whose = call.prefix.substr(0, call.prefix.find('.'));
      result.remarks.push_back(whose.empty() ? std::move(remark)
                                             : fmt::format("{}: {}", whose, remark));
    }
  }
  result.as_stated = outcomes_of(claim.as_stated, result.figures);
  if (claim.corrected) result.corrected = outcomes_of(claim.corrected->bounds, result.figures);
  result.verdict = verdict_of(result.as_stated, result.corrected);
  return result;
}

/// What the self-tests of the gate say.
struct Gate {
  bool there = false;
  std::string failure;  ///< why no claim on times can be decided; empty if they can
};

Gate gate_of(const std::vector<EvaluatedClaim>& claims) {
  Gate gate;
  for (const EvaluatedClaim& one : claims) {
    if (!one.claim->gate) continue;
    gate.there = true;
    if (one.verdict != Verdict::kConfirmed && gate.failure.empty()) {
      gate.failure = fmt::format("the gate's self-test {} was not confirmed", one.claim->id);
    }
  }
  if (!gate.there) gate.failure = "the claims file has no self-test of the gate";
  return gate;
}

void decide_standing(EvaluatedClaim& one, const TimesState& times, const Gate& gate) {
  const Claim& claim = *one.claim;
  if (claim.timing() && !claim.gate && !gate.failure.empty()) {
    one.verdict = Verdict::kUndecided;
    if (claim.expected != Verdict::kUndecided) one.reason = gate.failure;
  }
  if (one.verdict == Verdict::kUndecided && one.reason.empty() && !one.not_here.empty()) {
    one.standing = Standing::kNotDecidedHere;
    one.reason = one.not_here;
    return;
  }
  if (one.verdict == claim.expected) return;
  one.standing = Standing::kBroken;
  const bool decided = one.verdict != Verdict::kUndecided;
  if (!claim.timing() || decided) {
    // A self-test that fails says nothing of the program where times are only indicative.
    const bool excused = claim.gate && !times.reasons_against.empty();
    if (!excused) return;
  }
  if (!one.reason.empty()) {
    if (gate.there) one.standing = Standing::kNotDecidedHere;  // the self-test itself is broken
    return;
  }
  // Wide intervals tell of the machine; what got slower fails its bound.
  one.standing = Standing::kNotDecidedHere;
  one.reason =
      times.reasons_against.empty()
          ? "intervals reach across a bound; measure again, or longer"
          : fmt::format("times are only indicative: {}", fmt::join(times.reasons_against, ", "));
}

}  // namespace

const FigureDeclaration* EvaluatedClaim::declaration_of(const Figure& figure) const {
  for (const EstimatorCall& call : claim->calls) {
    if (!figure.name.starts_with(call.prefix)) continue;
    const auto* found = call.estimator->find_figure(figure.name.substr(call.prefix.size()));
    if (found != nullptr) return found;
  }
  return nullptr;
}

std::vector<EvaluatedClaim> evaluate(const std::vector<Claim>& claims, Laboratory& laboratory,
                                     const TimesState& times,
                                     const std::function<void(const Claim&)>& starting) {
  std::vector<EvaluatedClaim> results;
  for (const Claim& claim : claims) {
    if (starting) starting(claim);
    results.push_back(evaluate_one(claim, laboratory));
  }
  const Gate gate = gate_of(results);
  for (EvaluatedClaim& one : results) decide_standing(one, times, gate);
  return results;
}

bool any_broken(const std::vector<EvaluatedClaim>& claims) {
  return std::any_of(claims.begin(), claims.end(),
                     [](const EvaluatedClaim& one) { return one.standing == Standing::kBroken; });
}

}  // namespace bqsa::harness::claims
