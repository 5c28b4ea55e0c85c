// Whatever the bytes, loading gives a scenario or an InputError.
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>
#include <string>

#include "harness/scenario/scenario_files.hpp"

namespace bqsa::harness {
namespace {

std::string content_of(const std::string& name) {
  std::ifstream stream(BQSA_SOURCE_DIR "/scenarios/" + name, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// Replaces, inserts, removes or repeats a few bytes, more often than not with ones that YAML
/// minds.
std::string mutated(std::string text, std::mt19937& random) {
  const std::string special = "[]{}:,-?&*!|>'\"%@`#~\n\t 0123456789.eE+_infaN\\\r\x80\xff";
  const int edits = std::uniform_int_distribution(1, 4)(random);
  for (int edit = 0; edit < edits; ++edit) {
    const std::size_t at = std::uniform_int_distribution<std::size_t>(0, text.size() - 1)(random);
    const std::size_t pick =
        std::uniform_int_distribution<std::size_t>(0, special.size() - 1)(random);
    const auto any = static_cast<char>(std::uniform_int_distribution(0, 255)(random));
    switch (std::uniform_int_distribution(0, 5)(random)) {
      case 0:
        text[at] = any;
        break;
      case 1:
        text[at] = special[pick];
        break;
      case 2:
        text.insert(at, 1, special[pick]);
        break;
      case 3:
        text.erase(at, pick);
        break;
      case 4:
        text.insert(at, text.substr(at / 2, pick));
        break;
      default:
        text[at] = static_cast<char>(text[at] ^ (1 << (pick % 8)));
        break;
    }
    if (text.empty()) text.assign(1, ' ');
  }
  return text;
}

TEST(ScenarioFuzz, AMutatedFileGivesAScenarioOrAnInputError) {
  const TestDirectory directory;
  const std::string originals[] = {content_of("planar_7r.yaml"),
                                   content_of("puma560_ellipsoid.yaml"),
                                   content_of("puma560_wall.yaml")};
  std::mt19937 random(20160209);
  int loaded = 0;
  int refused = 0;
  for (int i = 0; i < 20'000; ++i) {
    const std::string text = mutated(originals[i % 3], random);
    try {
      const Scenario scenario = directory.load(text);
      ASSERT_TRUE(scenario.problem.desired_tip(0.3).allFinite()) << "case " << i << '\n' << text;
      ++loaded;
    } catch (const InputError&) {
      ++refused;
    } catch (...) {
      FAIL() << "another exception in case " << i << '\n' << text;
    }
  }
  RecordProperty("loaded", loaded);
  EXPECT_GT(loaded, 500);
  EXPECT_GT(refused, 10'000);
}

}  // namespace
}  // namespace bqsa::harness
