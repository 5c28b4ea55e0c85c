// Calls in a process of their own: what comes back, and how a crash is told.
#include "harness/guarded_call.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

#include "harness/input_error.hpp"

namespace bqsa::harness {
namespace {

using testing::HasSubstr;

std::string end_of(const std::function<std::string()>& function) {
  try {
    return "answered " + guarded_call(function);
  } catch (const EndedCall& ended) {
    return ended.what();
  }
}

TEST(GuardedCall, GivesWhatTheFunctionGives) {
  EXPECT_EQ(guarded_call([] { return std::string(); }), "");
  const std::string long_one(std::size_t{5} << 20U, '\0');  // more than a pipe holds
  EXPECT_EQ(guarded_call([&] { return long_one; }), long_one);
}

TEST(GuardedCall, LeavesTheCallerAsItIs) {
  int calls = 0;
  guarded_call([&] { return std::to_string(++calls); });
  EXPECT_EQ(calls, 0);
}

TEST(GuardedCall, ThrowsWhatIsWrongWithTheInput) {
  try {
    guarded_call([]() -> std::string { throw InputError("a.stl: expected better"); });
    FAIL() << "expected an error";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "a.stl: expected better");
  }
}

TEST(GuardedCall, SaysHowItsProcessEnded) {
  EXPECT_THAT(end_of([]() -> std::string {
                std::raise(SIGKILL);
                return "";
              }),
              HasSubstr("killed by signal 9"));
  EXPECT_THAT(end_of([]() -> std::string { std::_Exit(3); }), HasSubstr("exit status 3"));
  EXPECT_THAT(end_of([]() -> std::string { std::_Exit(0); }), HasSubstr("exit status 0"));
  EXPECT_EQ(end_of([]() -> std::string { throw std::runtime_error("no luck"); }), "no luck");
  EXPECT_EQ(end_of([]() -> std::string { throw 1; }), "threw what is no exception");
}

}  // namespace
}  // namespace bqsa::harness
