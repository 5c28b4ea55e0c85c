/// @file
/// Tests of vector code run with all instruction sets of the processor.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "bqsa/batch/instruction_set.hpp"

namespace bqsa::test_support {

/// Runs `test` with each instruction set, then leaves the best in use.
template <typename Test>
void with_all_instruction_sets(const Test& test) {
  for (const InstructionSet& set : instruction_sets()) {
    const testing::ScopedTrace trace(__FILE__, __LINE__, std::string(set.name));
    use_instruction_set(set.name);
    test();
  }
  use_instruction_set(instruction_sets().front().name);
}

}  // namespace bqsa::test_support
