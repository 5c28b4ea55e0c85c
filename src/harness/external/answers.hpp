/// @file
/// What an external method answers: the answers of the protocol bqsa-method/1
/// (docs/external-methods.md), checked.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

#include "bqsa/method.hpp"

namespace bqsa::harness {

/// An answer that cannot be used, or one by which the method says that it failed. The message has the
/// key, what was expected and what was found.
struct AnswerError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// All but `make` and `external` of an entry; its name is empty if the program has none for itself.
/// @throws AnswerError, like all below
MethodEntry read_describe_answer(std::string_view line);

void read_prepare_answer(std::string_view line);

/// @param obstacles  number of them in the problem
/// @param counters   replaced if the answer has any
void read_step_answer(std::string_view line, const StepInput& input, int obstacles,
                      StepOutput& output, WorkCounters& counters);

/// Longest answer to `plan` that is read for so many ticks and joints [byte].
std::size_t longest_plan_answer(int ticks, int joints);

PlanningMethod::Plan read_plan_answer(std::string_view line, int joints, WorkCounters& counters);

}  // namespace bqsa::harness
