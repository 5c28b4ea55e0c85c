// Other programs: what they print, and what is wrong with them.
#include "harness/claims/program_output.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace bqsa::harness::claims {
namespace {

std::string fault_of(const std::filesystem::path& program,
                     const std::vector<std::string>& arguments) {
  try {
    program_output(program, arguments);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "none";
}

TEST(ProgramOutput, IsWhatItPrints) {
  EXPECT_EQ(program_output("/bin/sh", {"-c", "echo \"$0 $1\"; echo two >&2", "a b", "c"}),
            "a b c\n");
  EXPECT_EQ(program_output("/bin/sh", {"-c", "true"}), "");
}

TEST(ProgramOutput, SaysHowAProgramFailed) {
  EXPECT_EQ(fault_of("/bin/sh", {"-c", "exit 3"}),
            "/bin/sh: expected it to end with status 0, got status 3");
  EXPECT_EQ(fault_of("/bin/sh", {"-c", "kill -9 $$"}),
            "/bin/sh: expected it to end with status 0, got signal 9");
  EXPECT_THAT(fault_of("/nowhere/at_all", {}),
              testing::StartsWith("/nowhere/at_all: cannot be started: "));
}

}  // namespace
}  // namespace bqsa::harness::claims
