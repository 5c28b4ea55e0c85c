#include "harness/campaign/campaign_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "harness/campaign/campaigns.hpp"
#include "harness/methods.hpp"

namespace bqsa::harness {
namespace {

using testing::ElementsAre;

std::string of(const std::string& scenarios, const std::string& methods) {
  return "schema: bqsa-campaign/1\nname: small\nscenarios: " + scenarios + "\nmethods: " + methods +
         "\n";
}

std::vector<std::string> names(const TestDirectory& directory, const std::string& scenarios) {
  std::vector<std::string> names;
  for (const auto& file : load(directory, of(scenarios, "[plain]")).scenarios) {
    names.push_back(file.lexically_relative(directory.path()).string());
  }
  return names;
}

std::vector<std::string> variants(const TestDirectory& directory, const std::string& methods) {
  std::vector<std::string> variants;
  for (const MethodSpec& spec : load(directory, of("[a.yaml]", methods)).methods) {
    variants.push_back(spec.entry.name + ":" + changed_parameters(spec.parameters));
  }
  return variants;
}

TEST(CampaignFile, HasDefaultsForAllButNameScenariosAndMethods) {
  const TestDirectory directory;
  write_scenarios(directory);
  const Campaign campaign = load(directory, of("[a.yaml]", "[plain]"));
  EXPECT_EQ(campaign.file, directory.path() / "campaign");
  EXPECT_EQ(campaign.name, "small");
  EXPECT_EQ(campaign.description, "");
  EXPECT_EQ(campaign.repetitions, 1);
  EXPECT_EQ(campaign.seed, 1u);
  EXPECT_TRUE(campaign.generated.empty());
  EXPECT_EQ(campaign.settings.plan_budget_s, RunSettings{}.plan_budget_s);
  EXPECT_FALSE(campaign.settings.disturbance.on());
  EXPECT_EQ(campaign.limits.wall_s, RunLimits{}.wall_s);
  EXPECT_EQ(campaign.limits.memory_bytes, RunLimits{}.memory_bytes);
  EXPECT_EQ(campaign.trajectories, KeptTrajectories::kAll);
}

TEST(CampaignFile, SaysWhatRunsWithWhat) {
  const TestDirectory directory;
  write_scenarios(directory);
  const Campaign campaign = load(directory, of("[a.yaml]", "[plain]") + R"(description: all
repetitions: 3
seed: 0
plan_budget: 2.5
limits: {time: 30, memory: 512}
disturbance: {joint_noise: 1e-3, latency: 1}
trajectories: failures
)");
  EXPECT_EQ(campaign.description, "all");
  EXPECT_EQ(campaign.repetitions, 3);
  EXPECT_EQ(campaign.seed, 0u);
  EXPECT_EQ(campaign.settings.plan_budget_s, 2.5);
  EXPECT_EQ(campaign.limits.wall_s, 30);
  EXPECT_EQ(campaign.limits.memory_bytes, 512u * 1024 * 1024);
  EXPECT_EQ(campaign.settings.disturbance.joint_noise, 1e-3);
  EXPECT_EQ(campaign.settings.disturbance.latency_ticks, 1);
  EXPECT_EQ(campaign.trajectories, KeptTrajectories::kFailures);
  const std::string none = of("[a.yaml]", "[plain]") + "trajectories: none\n";
  EXPECT_EQ(load(directory, none).trajectories, KeptTrajectories::kNone);
}

TEST(CampaignFile, PatternsNameFilesOnceInTheOrderOfTheListAndThenByName) {
  const TestDirectory directory;
  write_scenarios(directory);
  EXPECT_THAT(names(directory, "['?.yaml']"), ElementsAre("a.yaml", "b.yaml"));
  EXPECT_THAT(names(directory, "['[b-z].yaml', a.yaml]"), ElementsAre("b.yaml", "a.yaml"));
  EXPECT_THAT(names(directory, "['*.yaml', b.yaml, more/../a.yaml]"),
              ElementsAre("a.yaml", "b.yaml"));
  EXPECT_THAT(names(directory, "['*/*.yaml']"), ElementsAre("more/c.yaml", "more/d.yaml"));
  EXPECT_THAT(names(directory, "['[!a]*.yaml']"), ElementsAre("b.yaml"));
}

TEST(CampaignFile, ADirectoryStandsForItsYamlFiles) {
  const TestDirectory directory;
  write_scenarios(directory);
  EXPECT_THAT(names(directory, "[more]"), ElementsAre("more/c.yaml", "more/d.yaml"));
  EXPECT_THAT(names(directory, "['m*']"), ElementsAre("more/c.yaml", "more/d.yaml"));
}

TEST(CampaignFile, ADirectoryWithWildcardsInItsNameIsTakenLiterally) {
  const TestDirectory directory;
  const auto odd = directory.path() / "x[12]*";
  std::filesystem::create_directories(odd);
  std::filesystem::create_directories(directory.path() / "x1");
  directory.write("x[12]*/here.yaml", "");
  directory.write("x1/there.yaml", "");
  directory.write("x[12]*/campaign", of("['*.yaml']", "[plain]"));
  EXPECT_THAT(load_campaign(odd / "campaign", known_methods()).scenarios,
              ElementsAre(odd / "here.yaml"));
}

TEST(CampaignFile, GeneratedScenariosFollowTheFiles) {
  const TestDirectory directory;
  write_scenarios(directory);
  const Campaign campaign = load(directory, of(R"([
  {generate: {family: spatial, seed: 2147483647, count: 3, robots: arms}}, a.yaml,
  {generate: {family: planar, seed: 0, count: 100000}}])",
                                               "[plain]"));
  EXPECT_EQ(campaign.scenarios.size(), 1u);
  ASSERT_EQ(campaign.generated.size(), 2u);
  EXPECT_EQ(campaign.generated[0].family, "spatial");
  EXPECT_EQ(campaign.generated[0].seed, 2147483647u);
  EXPECT_EQ(campaign.generated[0].count, 3);
  EXPECT_EQ(campaign.generated[0].robots, directory.path() / "arms");
  EXPECT_EQ(campaign.generated[1].family, "planar");
  EXPECT_EQ(campaign.generated[1].robots, "robots");
}

TEST(CampaignFile, AGridIsTheProductOfItsListsTheFirstVaryingSlowest) {
  const TestDirectory directory;
  write_scenarios(directory);
  EXPECT_THAT(
      variants(directory, R"([plain, {method: tuned, parameters: {search: slow},
                       grid: {points: [4, 16], gain: [1e-3, 2.50, 7]}}, tuned])"),
      ElementsAre("plain:", "tuned:gain=0.001,points=4,search=slow",
                  "tuned:gain=2.5,points=4,search=slow", "tuned:gain=7,points=4,search=slow",
                  "tuned:gain=0.001,points=16,search=slow", "tuned:gain=2.5,points=16,search=slow",
                  "tuned:gain=7,points=16,search=slow", "tuned:"));
  EXPECT_THAT(variants(directory, "[{method: tuned, grid: {search: [slow, fast]}}]"),
              ElementsAre("tuned:search=slow", "tuned:"));
}

TEST(CampaignFile, VariantsOfOneNameInResultsAreRefused) {
  const TestDirectory directory;
  write_scenarios(directory);
  // Two gains of four digits whose texts have the same 32-bit hash.
  std::map<std::string, std::string> gain_by_name;
  std::string one, other;
  for (int i = 1; i < 1'000'000 && one.empty(); ++i) {
    const std::string gain = std::to_string(i) + "e-6";
    const MethodSpec spec = parse_method_spec("tuned:gain=" + gain, known_methods());
    const auto [place, first] = gain_by_name.try_emplace(variant_name(spec), gain);
    if (!first) {
      one = place->second;
      other = gain;
    }
  }
  ASSERT_FALSE(one.empty());
  const std::string message = message_of(directory, [&] {
    load(directory,
         of("[a.yaml]", "[{method: tuned, grid: {gain: [" + one + ", " + other + "]}}]"));
  });
  EXPECT_THAT(message, testing::StartsWith("campaign:4: methods[0]: expected variants that have "
                                           "different names in results, got tuned:gain="));
}

TEST(CampaignFile, ExternalMethodsAreThoseOfTheCommandLine) {
  const TestDirectory directory;
  write_scenarios(directory);
  std::vector<MethodEntry> known = known_methods();
  MethodEntry external;
  external.name = "mine";
  external.external = "python3 mine.py";
  known.push_back(external);
  const auto file = directory.write("campaign", of("[a.yaml]", "[mine]"));
  EXPECT_EQ(load_campaign(file, known).methods.front().entry.external, "python3 mine.py");
}

TEST(CampaignFile, IsToldFromAScenarioByItsSchema) {
  const TestDirectory directory;
  const auto says = [&directory](const std::string& text) {
    return is_campaign_file(directory.write("file", text));
  };
  EXPECT_TRUE(says("schema: bqsa-campaign/1\n"));
  EXPECT_TRUE(says("name: later\nschema: bqsa-campaign/2\n"));
  EXPECT_FALSE(says(scenario_text("a")));
  EXPECT_FALSE(says("schema: [bqsa-campaign/1]\n"));
  EXPECT_FALSE(says("- schema: bqsa-campaign/1\n"));
  EXPECT_FALSE(says("schema: bqsa-campaign/1\n\t- {"));
  EXPECT_FALSE(says(""));
  EXPECT_FALSE(is_campaign_file(directory.path()));
  EXPECT_FALSE(is_campaign_file(directory.path() / "missing"));
}

TEST(CampaignFile, TheExampleCanBeLoaded) {
  const Campaign campaign = load_campaign(BQSA_SOURCE_DIR "/examples/campaign.yaml", methods());
  EXPECT_EQ(campaign.scenarios.size(), 3u);
  ASSERT_EQ(campaign.generated.size(), 1u);
  EXPECT_EQ(campaign.generated[0].count, 20);
  EXPECT_EQ(campaign.repetitions, 2);
  EXPECT_EQ(campaign.methods.size(), 4u);
}

TEST(CampaignFile, TheReferenceCampaignsCanBeLoaded) {
  int campaigns = 0;
  for (const auto& entry : std::filesystem::directory_iterator(BQSA_SOURCE_DIR "/campaigns")) {
    const Campaign campaign = load_campaign(entry.path(), methods());
    EXPECT_EQ(campaign.name, entry.path().stem());
    ++campaigns;
  }
  EXPECT_EQ(campaigns, 5);
}

}  // namespace
}  // namespace bqsa::harness
