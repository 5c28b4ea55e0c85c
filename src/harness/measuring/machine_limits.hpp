/// @file
/// What the machine can do at most with the vector instructions in use: multiply-adds a second, and
/// bytes a second from memory. What batched code is compared with, measured in the same run.
#pragma once

#include <cstddef>
#include <cstdint>

namespace bqsa::harness {

/// Makes at least so many multiply-adds of double precision, each lane of a vector being one: in chains
/// that do not wait for each other, with all numbers in registers. Where the instruction set has no fused
/// instruction, a multiplication and an addition.
/// @return a number that depends on all of them
double make_multiply_adds(std::int64_t count);

/// The same in single precision.
float make_float_multiply_adds(std::int64_t count);

/// Reads all of it once, from the first on, and does as little else as can be.
/// @param values  aligned to 64 bytes
/// @param count   a multiple of 64
/// @return a number that depends on all of them
double read_all(const double* values, std::size_t count);

}  // namespace bqsa::harness
