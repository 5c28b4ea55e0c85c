#include "bqsa/batch/instruction_set.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace bqsa {
namespace {

TEST(InstructionSet, TheBestIsInUseAndOthersCanBeChosen) {
  const std::string_view best = instruction_sets().front().name;
  EXPECT_EQ(instruction_set().name, best);
  for (const InstructionSet& set : instruction_sets()) {
    use_instruction_set(set.name);
    EXPECT_EQ(instruction_set().name, set.name);
  }
  EXPECT_EQ(instruction_set().name, "SCALAR") << "has to be there on every processor";
  use_instruction_set(best);
}

TEST(InstructionSet, WhatIsNotThereIsRefused) {
  EXPECT_THROW(use_instruction_set("NEON"), std::invalid_argument);
  EXPECT_THROW(use_instruction_set(""), std::invalid_argument);
}

}  // namespace
}  // namespace bqsa
