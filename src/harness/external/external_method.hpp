/// @file
/// Methods that are programs of their own (docs/external-methods.md).
#pragma once

#include <string_view>

#include "bqsa/method.hpp"

namespace bqsa::harness {

/// Time within which a program has to say what it is [s].
inline constexpr double kDescribeLimit = 10;

/// The method that a program is: it is started, asked, and ended. Each method made from the entry
/// starts the program anew when it is constructed and ends it when it is destroyed; a program that
/// fails then makes `prepare`, `step` or `plan` throw ExternalFault.
///
/// Unlike other methods these allocate in every step. How long an answer may take is for others to
/// limit, as run_isolated() does.
/// @param name_and_command  `NAME=COMMAND`: NAME [a-z][a-z0-9_]*, COMMAND split by
///   command_words()
/// @throws InputError naming both if they cannot be used, or if the program cannot be started or does
///   not describe itself as it has to
MethodEntry external_method(std::string_view name_and_command);

}  // namespace bqsa::harness
