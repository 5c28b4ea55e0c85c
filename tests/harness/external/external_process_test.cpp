#include "harness/external/external_process.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "harness/temporary_directory.hpp"
#include "running_process.hpp"

namespace bqsa::harness {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

std::string fault_of(const std::string& command, const ExternalRequest& request) {
  try {
    ExternalProcess(command).ask(request);
  } catch (const ExternalFault& fault) {
    return fault.what();
  }
  return "none";
}

TEST(ExternalProcess, AnswersALineWithALine) {
  ExternalProcess echo("cat");
  for (const char* line : {"first", "", "{\"a\": 1}"}) {
    EXPECT_EQ(echo.ask({.name = "echo", .line = line}), line);
  }
  const std::string long_line(200'000, 'x');  // more than the pipes hold
  EXPECT_EQ(
      ExternalProcess("sh -c 'read line; echo \"$line\"'").ask({.name = "echo", .line = long_line}),
      long_line);
}

TEST(ExternalProcess, ALimitEndsTheWait) {
  for (const char* command : {"sleep 1000", "sh -c 'yes noise | cat >&2'",
                              "sh -c 'read line; printf unended; sleep 1000'"}) {
    const std::string fault = fault_of(command, {.name = "describe", .line = "{}", .limit_s = 0.3});
    EXPECT_THAT(fault, HasSubstr(command));
    EXPECT_THAT(fault, EndsWith("asked to describe: expected an answer within 0.3 s, got none"));
  }
}

TEST(ExternalProcess, ALineIsRefusedWhenItIsTooLongAlready) {
  EXPECT_THAT(fault_of("sh -c 'read line; exec cat /dev/zero'",
                       {.name = "x", .line = "", .longest_answer = 1000}),
              HasSubstr("a line of at most 0.000954 MiB"));
  const std::string just_right(1000, 'x');
  EXPECT_EQ(ExternalProcess("cat").ask({.name = "x", .line = just_right, .longest_answer = 1000}),
            just_right);
  EXPECT_THAT(fault_of("cat", {.name = "x", .line = just_right, .longest_answer = 999}),
              HasSubstr("a longer one"));
}

TEST(ExternalProcess, TheLastLineOfTheStandardErrorIsShown) {
  EXPECT_EQ(fault_of("sh -c 'yes noise | head -100000 >&2; echo why >&2; echo >&2; exit 7'",
                     {.name = "x", .line = ""}),
            "'sh -c 'yes noise | head -100000 >&2; echo why >&2; echo >&2; exit 7'', asked to x: "
            "expected one line, got none: ended its process with exit status 7: why");
}

TEST(ExternalProcess, WhatIsWrittenUnaskedIsNoAnswer) {
  const TemporaryDirectory directory;
  const std::string mark = directory.path() / "mark";
  ExternalProcess program("sh -c 'echo early; touch " + mark + "; cat'");
  ASSERT_TRUE(within_a_minute([&mark] { return std::filesystem::exists(mark); }));
  try {
    program.ask({.name = "x", .line = "late"});
    FAIL() << "took it for the answer";
  } catch (const ExternalFault& fault) {
    EXPECT_THAT(fault.what(), HasSubstr("nothing before, got 'early\\x0a' too early"));
  }
}

TEST(ExternalProcess, TheProgramGetsNoFilesOfTheHarness) {
  const Descriptor passed_on(open("/dev/null", O_RDONLY));  // but for what the class does
  ExternalProcess program("sh -c 'read line; ls /proc/self/fd | tr \"\\n\" \" \"; echo'");
  // 3 is the directory that is listed.
  EXPECT_EQ(program.ask({.name = "list", .line = ""}), "0 1 2 3 ");
}

TEST(ExternalProcess, AProgramIsGivenTimeToEnd) {
  const TemporaryDirectory directory;
  const std::string file = directory.path() / "last words";
  ExternalProcess program("sh -c 'read a; echo; read b; sleep 0.2; echo \"$b\" > \"" + file +
                          "\"'");
  program.ask({.name = "x", .line = ""});
  program.say_goodbye("farewell");
  std::ifstream in(file);
  std::string words;
  std::getline(in, words);
  EXPECT_EQ(words, "farewell");
}

}  // namespace
}  // namespace bqsa::harness
