#include "harness/external/command_words.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "harness/input_error.hpp"

namespace bqsa::harness {
namespace {

using Words = std::vector<std::string>;

TEST(CommandWords, SplitsAtWhiteSpaceOutsideQuotes) {
  EXPECT_EQ(command_words("python3 mine.py"), (Words{"python3", "mine.py"}));
  EXPECT_EQ(command_words("  a \t b\n"), (Words{"a", "b"}));
  EXPECT_EQ(command_words("'my file' \"your file\" his\\ file"),
            (Words{"my file", "your file", "his file"}));
  EXPECT_EQ(command_words("a'b c'\"d e\"f"), (Words{"ab cd ef"}));
  EXPECT_EQ(command_words("'' \"\""), (Words{"", ""}));
}

TEST(CommandWords, NothingButQuotesMeansAnything) {
  EXPECT_EQ(command_words("$HOME *.py ~ `ls` a|b > c;"),
            (Words{"$HOME", "*.py", "~", "`ls`", "a|b", ">", "c;"}));
}

TEST(CommandWords, RefusesWhatHasNoEnd) {
  for (const char* text : {"", "  ", "'a", "\"a", "a\\", "\"a\\"}) {
    EXPECT_THROW(command_words(text), InputError) << text;
  }
}

/// What a shell makes of the words, each on a line.
std::string by_shell(const std::string& text) {
  const std::string command = "printf '<%s>\\n' " + text;
  std::FILE* pipe = popen(command.c_str(), "r");
  std::string lines;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) lines += static_cast<char>(c);
  pclose(pipe);
  return lines;
}

TEST(CommandWords, SplitsLikeAShell) {
  constexpr char kLetters[] = {'a', 'b', ' ', '\'', '"', '\\', '\t', 'c'};
  std::mt19937 random(1);
  int compared = 0;
  for (int i = 0; i < 600; ++i) {
    std::string text = "x";
    for (int k = 0; k < 12; ++k) text += kLetters[random() % std::size(kLetters)];
    Words words;
    try {
      words = command_words(text);
    } catch (const InputError&) {
      continue;  // a shell would ask for more
    }
    std::string lines;
    for (const std::string& word : words) {
      lines += '<';
      lines += word;
      lines += ">\n";
    }
    ASSERT_EQ(lines, by_shell(text)) << text;
    ++compared;
  }
  EXPECT_GT(compared, 100);
}

}  // namespace
}  // namespace bqsa::harness
