/// @file
/// Bad input, said once and clearly.
#pragma once

#include <stdexcept>

namespace bqsa::harness {

/// What the user gave cannot be used. The message is complete and names file, line and key where there
/// are any, what was expected and what was found: `a.yaml:14: obstacles[1].semi_axes: expected
/// positive lengths, got -0.1`. The program prints it and exits with status 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace bqsa::harness
