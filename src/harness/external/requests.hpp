/// @file
/// What an external method is told: the requests of the protocol bqsa-method/1
/// (docs/external-methods.md), each one line of JSON without its end. Doubles are written with as many
/// digits as it takes to read the same ones back.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bqsa/method.hpp"

namespace bqsa::harness {

/// The version that this program speaks.
inline constexpr const char* kMethodProtocol = "bqsa-method/1";

std::string describe_request();

/// The whole problem, and a value for each declared parameter.
std::string prepare_request(const Problem& problem,
                            const std::vector<ParameterDeclaration>& declared,
                            const ParameterValues& values);

/// @param turned  whether the task has an orientation, which is then told too
std::string step_request(const StepInput& input, bool turned = false);
std::string plan_request(double budget_s, std::uint64_t seed);
std::string quit_request();

}  // namespace bqsa::harness
