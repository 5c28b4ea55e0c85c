// The inputs that fuzzing left behind, again and without a fuzzer.
#include <gtest/gtest.h>

#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <string>

#include "fuzz/targets.hpp"

namespace bqsa::fuzz {

static void PrintTo(const Target& target, std::ostream* out) { *out << target.name; }

namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class Corpus : public testing::TestWithParam<Target> {};

TEST_P(Corpus, EachInputIsAcceptedOrRefusedAsDocumented) {
  int accepted = 0;
  int refused = 0;
  for (const auto& entry :
       fs::directory_iterator(fs::path(BQSA_SOURCE_DIR "/tests/fuzz/corpus") / GetParam().name)) {
    SCOPED_TRACE(entry.path().filename().string());
    try {
      ++(GetParam().run(content_of(entry.path())) ? accepted : refused);
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
    }
  }
  EXPECT_GE(accepted, 5);
  EXPECT_GE(refused, 5);
}

INSTANTIATE_TEST_SUITE_P(, Corpus, testing::ValuesIn(kTargets),
                         [](const auto& target) { return std::string(target.param.name); });

}  // namespace
}  // namespace bqsa::fuzz
