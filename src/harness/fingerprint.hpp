/// @file
/// Whether a problem is still what it was.
#pragma once

#include <cstdint>

#include "bqsa/problem.hpp"

namespace bqsa::harness {

/// 64-bit FNV-1a hash of all that a problem says, bit for bit: chain, obstacles with their motion, the
/// path at every tick, start, limits and the other numbers. Two hashes differ if a method has
/// changed any of it.
std::uint64_t fingerprint(const Problem& problem);

}  // namespace bqsa::harness
