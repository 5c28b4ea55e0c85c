/// @file
/// Tests of batched code that run with every instruction set of the processor.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "bqsa/batch/instruction_set.hpp"

namespace bqsa::test_support {

/// The best is in use again afterwards.
class InstructionSetTest : public testing::TestWithParam<InstructionSet> {
 protected:
  void SetUp() override { use_instruction_set(GetParam().name); }
  void TearDown() override { use_instruction_set(instruction_sets().front().name); }
};

inline auto all_instruction_sets() {
  return testing::ValuesIn(instruction_sets().begin(), instruction_sets().end());
}

inline std::string instruction_set_name(const testing::TestParamInfo<InstructionSet>& set) {
  return std::string(set.param.name);
}

}  // namespace bqsa::test_support
