/// @file
/// What a claim is: a statement of the paper, how it is estimated, and the bounds that decide it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/claims/estimator.hpp"

namespace bqsa::harness::claims {

enum class Relation {
  kLess,
  kAtMost,
  kGreater,
  kAtLeast,
  kEqual,
  kWithin,  ///< from `lower` to `upper`, both included
};

/// A number for one set of vector instructions.
struct NumberOfSet {
  std::string instruction_set;  ///< as bqsa/batch/instruction_set.hpp names it
  double value;
};

/// What a figure has to be for the statement to hold.
struct Bound {
  std::string figure;
  Relation relation = Relation::kEqual;
  double lower = 0;  ///< of kWithin; else the number that the figure is compared with
  double upper = 0;  ///< of kWithin; else the same
  std::string unit;  ///< of both, that of the figure

  /// Why nothing decides this part of the statement; such a bound has no figure.
  std::string unknown = {};

  /// Where the number depends on the vector instructions: those it is known for. choose_numbers() puts
  /// one of them into `lower` and `upper`.
  std::vector<NumberOfSet> numbers = {};

  /// Why it says nothing on this machine: the number for its vector instructions is not known.
  std::string not_here = {};
};

/// The statement as it would have to be put to hold.
struct Correction {
  std::string text;
  std::vector<Bound> bounds;
};

enum class Verdict { kConfirmed, kCorrected, kRefuted, kUndecided };

/// One way to get figures, as the claim asks for it.
struct EstimatorCall {
  const Estimator* estimator;
  Arguments arguments;
  std::string prefix;  ///< of the figures' names, `points.` for `as: points`; may be empty
};

struct Claim {
  std::string id;
  std::string statement;  ///< the paper's, short
  std::string source;     ///< section, figure or equation of the paper
  std::vector<EstimatorCall> calls;
  std::vector<Bound> as_stated;
  std::optional<Correction> corrected;
  Verdict expected;  ///< of the reference: any other means that the claim no longer holds
  std::string note;  ///< what a reader has to know; may be empty

  /// Of the gate itself: must be confirmed, or no claim that rests on times is decided.
  bool gate = false;

  /// Rests on measured times.
  bool timing() const;
};

/// Settles all bounds whose number depends on the vector instructions; where it is not known for this
/// set, the bound says so in `not_here`.
void choose_numbers(std::vector<Claim>& claims, std::string_view instruction_set);

const char* name_of(Verdict verdict);

/// `< 3.5 mm`, `unknown: ...`, or `>= 400 with AVX3, 200 with AVX2` where nothing was chosen.
std::string text_of(const Bound& bound);

}  // namespace bqsa::harness::claims
