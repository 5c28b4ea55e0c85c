/// @file
/// The vector instructions that batched code runs with: chosen at run time, so that one program serves
/// all processors and no other code is compiled for instructions that a processor may lack.
#pragma once

#include <span>
#include <string_view>

namespace bqsa {

/// What batched code can be compiled for, as Highway names it, and how many numbers it then handles at a
/// time.
struct InstructionSet {
  std::string_view name;  ///< `AVX3` is AVX-512 (F, BW, CD, DQ, VL); `SCALAR` needs nothing
  int bytes;              ///< of a vector; 8 for one number, of whatever type
};

/// Those that this processor can run, best first.
std::span<const InstructionSet> instruction_sets();

/// The one in use: the best, unless another was chosen.
const InstructionSet& instruction_set();

/// From now on, in all threads, batched code runs with this one: for tests and measurements. Not to be
/// called while batched code runs.
/// @throws std::invalid_argument unless it is the name of one of instruction_sets()
void use_instruction_set(std::string_view name);

}  // namespace bqsa
