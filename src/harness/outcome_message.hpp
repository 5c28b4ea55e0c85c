/// @file
/// The outcome of a run as bytes, to bring it from one process to another of the same program.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "harness/runner.hpp"

namespace bqsa::harness {

std::string outcome_message(const RunOutcome& outcome);

/// None if the bytes are not a whole message: the process that wrote them may have been damaged by
/// the method that it ran.
std::optional<RunOutcome> read_outcome_message(std::string_view bytes);

}  // namespace bqsa::harness
