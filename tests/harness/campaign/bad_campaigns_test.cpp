// Every bad campaign is refused by an InputError that says where, what was expected and what was found.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <string>

#include "harness/campaign/campaigns.hpp"

namespace bqsa::harness {
namespace {

YAML::Node table() {
  return YAML::LoadFile(BQSA_SOURCE_DIR "/tests/harness/campaign/bad_campaigns.yaml");
}

std::string refusal(const TestDirectory& directory, const std::string& text) {
  return message_of(directory, [&] { load(directory, text); });
}

TEST(BadCampaigns, TheirOriginalsAreGood) {
  const TestDirectory directory;
  write_scenarios(directory);
  const YAML::Node bases = table();
  EXPECT_EQ(refusal(directory, bases["short"].as<std::string>()), "no error");
  EXPECT_EQ(refusal(directory, bases["full"].as<std::string>()), "no error");
}

TEST(BadCampaigns, AreRefusedWithLineKeyExpectedAndFound) {
  const TestDirectory directory;
  write_scenarios(directory);
  const YAML::Node bases = table();
  int cases = 0;
  for (const YAML::Node& bad : bases["cases"]) {
    SCOPED_TRACE(bad["name"].as<std::string>());
    const std::string text = with(bases[bad["base"].as<std::string>()].as<std::string>(),
                                  bad["replace"].as<std::string>(), bad["by"].as<std::string>());
    EXPECT_EQ(refusal(directory, text), "campaign:" + bad["expect"].as<std::string>());
    ++cases;
  }
  EXPECT_GE(cases, 60);
}

TEST(BadCampaigns, GridsBeyondAllBoundsAreRefusedBeforeTheyAreMade) {
  const TestDirectory directory;
  write_scenarios(directory);
  std::string numbers = "0";
  for (int i = 1; i < 1000; ++i) numbers += fmt::format(", {}", i * 1e-3);
  const std::string head = "schema: bqsa-campaign/1\nname: large\nscenarios: [a.yaml]\nmethods:\n";
  EXPECT_EQ(refusal(directory, head + "  - method: tuned\n    grid:\n      gain: [" + numbers +
                                   "]\n      points: [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]\n"),
            "campaign:8: methods[0].grid.points: expected at most 10000 variants of methods, got "
            "11000");
}

TEST(BadCampaigns, AFileThatIsNoneIsRefused) {
  const TestDirectory directory;
  EXPECT_EQ(
      message_of(directory, [&] { load_campaign(directory.path() / "missing", known_methods()); }),
      "missing: expected a file, got nothing there");
  EXPECT_EQ(refusal(directory, ""), "campaign:1: expected one YAML document, got an empty file");
  EXPECT_EQ(refusal(directory, scenario_text("a")),
            "campaign:1: schema: expected bqsa-campaign/1, got bqsa-scenario/1");
}

}  // namespace
}  // namespace bqsa::harness
