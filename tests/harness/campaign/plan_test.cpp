#include "harness/campaign/plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "harness/campaign/campaigns.hpp"
#include "harness/generator/generator.hpp"
#include "harness/sha256.hpp"

namespace bqsa::harness {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

MethodSpec spec_of(const std::string& text) { return parse_method_spec(text, known_methods()); }

PlannedScenario scenario_of(char digit) { return {"any.yaml", "any", std::string(64, digit)}; }

std::string content_of(const fs::path& file) {
  std::stringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// A campaign on `a.yaml` and `more`, with three variants and two repetitions.
std::string campaign_text() {
  return R"(schema: bqsa-campaign/1
name: small
scenarios: [a.yaml, more]
methods: [plain, {method: tuned, parameters: {gain: 1}}, planner]
repetitions: 2
)";
}

TEST(RunSeed, IsTheFirst32BitsOfADocumentedHash) {
  // python3 -c 'from hashlib import sha256; print(int(sha256(
  //   ("bqsa-seed/1\n1\n" + "a" * 64 + "\n1\n").encode()).hexdigest()[:8], 16))'
  EXPECT_EQ(run_seed(1, scenario_of('a'), spec_of("plain"), 1), 3629084885u);
  // with "\n2\n" for the end
  EXPECT_EQ(run_seed(1, scenario_of('a'), spec_of("plain"), 2), 2627884771u);
  // with "\n1\nplanner\nrange=0.5\n"
  EXPECT_EQ(run_seed(1, scenario_of('a'), spec_of("planner"), 1), 969437457u);
}

TEST(RunSeed, OfMethodsThatAnswerTickByTickIsTheSameForAll) {
  const std::uint64_t seed = run_seed(1, scenario_of('a'), spec_of("plain"), 1);
  EXPECT_EQ(run_seed(1, scenario_of('a'), spec_of("tuned"), 1), seed);
  EXPECT_EQ(run_seed(1, scenario_of('a'), spec_of("tuned:gain=1"), 1), seed);
}

TEST(RunSeed, DependsOnCampaignScenarioAndRepetitionAndOfAPlannerOnItsParameters) {
  std::set<std::uint64_t> seeds;
  for (const char* method : {"plain", "planner", "planner:range=0.25"}) {
    for (const std::uint64_t campaign_seed : {0u, 1u}) {
      for (const char scenario : {'a', 'b'}) {
        for (const int repetition : {1, 2}) {
          seeds.insert(run_seed(campaign_seed, scenario_of(scenario), spec_of(method), repetition));
        }
      }
    }
  }
  EXPECT_EQ(seeds.size(), 3u * 2 * 2 * 2);
  PlannedScenario renamed = scenario_of('a');
  renamed.file = "elsewhere/other.yaml";
  EXPECT_EQ(run_seed(1, renamed, spec_of("planner"), 1),
            run_seed(1, scenario_of('a'), spec_of("planner"), 1));
}

/// What a key is made of.
struct Ingredients {
  PlannedScenario scenario = scenario_of('a');
  MethodSpec method = spec_of("tuned");
  int repetition = 2;
  std::uint64_t seed = 12345;
  RunSettings settings = {
      .seed = 1, .plan_budget_s = 10, .disturbance = {.joint_noise = 1e-3, .latency_ticks = 1}};
  RunLimits limits = {};
  std::string program = "program p\n";

  std::string key() const {
    return run_key(scenario, method_identity(method), repetition, seed, settings, limits, program);
  }
};

TEST(RunKey, IsADocumentedHash) {
  // python3 -c 'from hashlib import sha256; print(sha256(("bqsa-key/1\nscenario " + "a" * 64 +
  //   "\nmethod tuned\nparameters gain=2,points=8,search=fast\nrepetition 2\nseed 12345\nnoise 0.001 rad\n"
  //   "latency 1\nbudget 10 s\nwall 120 s\nmemory 4294967296\nprogram p\n").encode()).hexdigest()[:32])'
  EXPECT_EQ(Ingredients().key(), "14bf41c85a0d8c5b40ec3bb669a1f891");
}

TEST(RunKey, ChangesWithEveryIngredient) {
  std::vector<Ingredients> changed(12);
  changed[1].scenario = scenario_of('b');
  changed[2].method = spec_of("plain");
  changed[3].method = spec_of("tuned:gain=1");
  changed[4].repetition = 1;
  changed[5].seed = 12346;
  changed[6].settings.disturbance.joint_noise = 2e-3;
  changed[7].settings.disturbance.latency_ticks = 0;
  changed[8].settings.plan_budget_s = 11;
  changed[9].limits.wall_s = 121;
  changed[10].limits.memory_bytes = 1u << 30u;
  changed[11].program = "program q\n";
  std::set<std::string> keys;
  for (const Ingredients& one : changed) keys.insert(one.key());
  EXPECT_EQ(keys.size(), changed.size());
}

TEST(RunKey, ChangesWithNothingElse) {
  Ingredients same;
  same.scenario.file = "elsewhere/other.yaml";
  same.scenario.name = "other";
  same.settings.seed = 77;  // that of the run counts, which is given
  same.method.entry.summary = "another text";
  EXPECT_EQ(same.key(), Ingredients().key());
}

TEST(MethodIdentity, OfAnExternalMethodHasTheCommandAndTheFilesThatItNames) {
  const TestDirectory directory;
  const fs::path script = directory.write("mine.py", "print(1)\n");
  MethodSpec spec = spec_of("tuned");
  const std::string inside = method_identity(spec);
  spec.entry.external = "cat " + script.string() + " --fast";
  const std::string identity = method_identity(spec);
  EXPECT_NE(identity, inside);
  EXPECT_THAT(identity, HasSubstr(sha256_of("print(1)\n")));
  EXPECT_EQ(method_identity(spec), identity);
  directory.write("mine.py", "print(2)\n");
  EXPECT_NE(method_identity(spec), identity);
  directory.write("mine.py", "print(1)\n");
  EXPECT_EQ(method_identity(spec), identity);
  spec.entry.external = "cat " + script.string() + " --slow";
  EXPECT_NE(method_identity(spec), identity);

  const fs::path program = directory.write("program", "one");
  spec.entry.external = program.string();
  const std::string first = method_identity(spec);
  directory.write("program", "two");
  EXPECT_NE(method_identity(spec), first);
}

TEST(MethodIdentity, FindsTheProgramAsAShellDoes) {
  MethodSpec spec = spec_of("plain");
  spec.entry.external = "cat";
  std::string cat;
  for (const char* place : {"/usr/local/bin/cat", "/usr/bin/cat", "/bin/cat"}) {
    if (cat.empty() && fs::exists(place)) cat = place;
  }
  EXPECT_THAT(method_identity(spec), HasSubstr(sha256_of(content_of(cat))));
}

TEST(ProgramIdentity, HasTheBytesOfAProgramWithMethodsOutOfTree) {
  const std::string own = sha256_of(content_of("/proc/self/exe"));
  EXPECT_THAT(program_identity({"mine"}), HasSubstr(own));
  EXPECT_THAT(program_identity({}), HasSubstr("compiler "));
}

TEST(Plan, ListsRunsByScenarioThenMethodThenRepetition) {
  const TestDirectory directory;
  write_scenarios(directory);
  const Campaign campaign = load(directory, campaign_text());
  const Plan plan = make_plan(campaign, directory.path() / "out");
  EXPECT_EQ(plan.campaign, "small");
  ASSERT_EQ(plan.scenarios.size(), 3u);
  EXPECT_EQ(plan.scenarios[0].name, "a");
  EXPECT_EQ(plan.scenarios[2].name, "d");
  EXPECT_EQ(plan.scenarios[2].sha256, sha256_of(scenario_text("d")));
  ASSERT_EQ(plan.runs.size(), 3u * 3 * 2);
  std::size_t index = 0;
  std::set<std::string> keys;
  for (std::size_t s = 0; s < 3; ++s) {
    for (std::size_t m = 0; m < 3; ++m) {
      for (int repetition = 1; repetition <= 2; ++repetition) {
        const PlannedRun& run = plan.runs[index++];
        EXPECT_EQ(run.scenario, s);
        EXPECT_EQ(run.method, m);
        EXPECT_EQ(run.repetition, repetition);
        EXPECT_EQ(run.seed, run_seed(1, plan.scenarios[s], plan.methods[m], repetition));
        EXPECT_EQ(run.key, run_key(plan.scenarios[s], method_identity(plan.methods[m]), repetition,
                                   run.seed, plan.settings, plan.limits, program_identity({})));
        keys.insert(run.key);
      }
    }
  }
  EXPECT_EQ(keys.size(), plan.runs.size());
}

TEST(Plan, IsTheSameEveryTimeAndWhereverTheScenariosLie) {
  const TestDirectory directory;
  write_scenarios(directory);
  const Campaign campaign = load(directory, campaign_text());
  const Plan plan = make_plan(campaign, directory.path() / "out");
  fs::rename(directory.path() / "more", directory.path() / "less");
  const Campaign moved = load(directory, with(campaign_text(), "[a.yaml, more]", "[a.yaml, less]"));
  const Plan again = make_plan(moved, directory.path() / "other");
  ASSERT_EQ(again.runs.size(), plan.runs.size());
  for (std::size_t i = 0; i < plan.runs.size(); ++i) EXPECT_EQ(again.runs[i].key, plan.runs[i].key);
}

TEST(Plan, AChangedScenarioChangesItsKeysAndNoOthers) {
  const TestDirectory directory;
  write_scenarios(directory);
  const Campaign campaign = load(directory, campaign_text());
  const Plan before = make_plan(campaign, directory.path() / "out");
  directory.write("a.yaml", scenario_text("a") + "# as before\n");
  const Plan after = make_plan(campaign, directory.path() / "out");
  ASSERT_EQ(after.runs.size(), before.runs.size());
  for (std::size_t i = 0; i < before.runs.size(); ++i) {
    EXPECT_EQ(after.runs[i].key == before.runs[i].key, before.runs[i].scenario != 0) << i;
  }
}

TEST(Plan, ScenariosOfOneNameAreRefused) {
  const TestDirectory directory;
  write_scenarios(directory);
  directory.write("more/c.yaml", scenario_text("a"));
  const Campaign campaign = load(directory, campaign_text());
  EXPECT_EQ(message_of(directory, [&] { make_plan(campaign, directory.path() / "out"); }),
            "a.yaml and " + (directory.path() / "more/c.yaml").string() +
                ": expected scenarios of different names, both are 'a'");
}

TEST(Plan, AScenarioThatCannotBeUsedIsRefusedByItsOwnMessage) {
  const TestDirectory directory;
  write_scenarios(directory);
  directory.write("more/c.yaml", with(scenario_text("c"), "start: [0, 90]", "start: [0]"));
  const Campaign campaign = load(directory, campaign_text());
  EXPECT_EQ(message_of(directory, [&] { make_plan(campaign, directory.path() / "out"); }),
            "more/c.yaml:5: start: expected a list of 2 angles, one a joint, got a list of 1");
}

std::string generating(int count) {
  return "schema: bqsa-campaign/1\nname: small\nscenarios:\n  - generate: {family: planar, seed: "
         "7, count: " +
         std::to_string(count) + "}\nmethods: [plain]\n";
}

TEST(Plan, GeneratesScenariosAsTheCommandDoes) {
  const TestDirectory directory;
  const fs::path out = directory.path() / "out";
  const Plan plan = make_plan(load(directory, generating(4)), out);
  ASSERT_EQ(plan.scenarios.size(), 4u);
  Rejections rejections;
  for (int i = 0; i < 4; ++i) {
    const GeneratedScenario expected = generate(*find_family("planar"), 7, i, {}, rejections);
    const PlannedScenario& planned = plan.scenarios[static_cast<std::size_t>(i)];
    EXPECT_EQ(planned.name, expected.name);
    EXPECT_EQ(planned.file, out / "scenarios" / (expected.name + ".yaml"));
    EXPECT_EQ(content_of(planned.file), expected.yaml);
    EXPECT_EQ(planned.sha256, load_scenario(planned.file).sha256);
  }
}

TEST(Plan, GeneratedScenariosAreKeptAndMissingOnesMadeAgain) {
  const TestDirectory directory;
  const fs::path out = directory.path() / "out";
  const Plan plan = make_plan(load(directory, generating(4)), out);
  fs::remove(plan.scenarios[3].file);
  const auto before = fs::last_write_time(plan.scenarios[2].file);
  const Plan again = make_plan(load(directory, generating(5)), out);
  EXPECT_EQ(fs::last_write_time(plan.scenarios[2].file), before);
  ASSERT_EQ(again.scenarios.size(), 5u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(again.runs[i].key, plan.runs[i].key);
  EXPECT_TRUE(fs::exists(again.scenarios[4].file));
  EXPECT_EQ(make_plan(load(directory, generating(3)), out).scenarios.size(), 3u);
}

TEST(Plan, GeneratedScenariosThatWereChangedAreRefused) {
  for (const char* changed : {"planar_s7_00000.yaml", "planar_s7_00003.yaml"}) {
    const TestDirectory directory;
    const fs::path out = directory.path() / "out";
    make_plan(load(directory, generating(4)), out);
    std::ofstream(out / "scenarios" / changed, std::ios::app) << "# changed\n";
    EXPECT_THAT(message_of(directory, [&] { make_plan(load(directory, generating(4)), out); }),
                testing::StartsWith("out/scenarios/" + std::string(changed) + ": expected "));
  }
}

TEST(Plan, AListOfHashesIsNotBelievedWhereTheGeneratorMakesAnother) {
  const TestDirectory directory;
  const fs::path out = directory.path() / "out";
  make_plan(load(directory, generating(4)), out);
  const std::string changed = content_of(out / "scenarios/planar_s7_00001.yaml") + "# changed\n";
  const fs::path list = out / "scenarios/planar_s7.sha256";
  const std::string hashes = content_of(list);
  const std::string old = sha256_of(content_of(out / "scenarios/planar_s7_00001.yaml"));
  std::ofstream(out / "scenarios/planar_s7_00001.yaml", std::ios::binary) << changed;
  std::ofstream(list, std::ios::binary) << with(hashes, old, sha256_of(changed));
  EXPECT_EQ(message_of(directory, [&] { make_plan(load(directory, generating(4)), out); }),
            "out/scenarios/planar_s7_00001.yaml: expected no file or what is to be written, got "
            "another one");
}

TEST(Plan, WhicheverRobotHasChangedItIsNoticed) {
  const TestDirectory directory;
  const std::vector<std::string> robots = {"robots/kuka_lbr_iiwa14.yaml",
                                           "robots/franka_panda.yaml", "robots/ur5e.yaml",
                                           "robots/ur10e.yaml", "robots/puma560.yaml"};
  fs::create_directory(directory.path() / "robots");
  for (const std::string& robot : robots) {
    directory.write(robot, content_of(fs::path(BQSA_SOURCE_DIR) / robot));
  }
  const std::string text =
      with(campaign_text(), "more]",
           "{generate: {family: stretched, seed: 7, count: 6, robots: robots}}]");
  const fs::path out = directory.path() / "out";
  write_scenarios(directory);
  make_plan(load(directory, text), out);
  make_plan(load(directory, text), out);
  for (const std::string& robot : robots) {
    const std::string before = content_of(directory.path() / robot);
    directory.write(robot, with(before, "\n  name: ", "\n  name: New "));
    EXPECT_THAT(message_of(directory, [&] { make_plan(load(directory, text), out); }),
                testing::StartsWith("out/scenarios/stretched_s7_0000"))
        << robot;
    directory.write(robot, before);
  }
}

TEST(Plan, TellsHowManyScenariosAreDone) {
  const TestDirectory directory;
  write_scenarios(directory);
  const Campaign campaign =
      load(directory,
           with(campaign_text(), "more]", "{generate: {family: planar, seed: 7, count: 2}}]"));
  std::vector<std::size_t> told;
  const auto progress = [&told](std::size_t done, std::size_t all) {
    EXPECT_EQ(all, 3u);
    told.push_back(done);
  };
  make_plan(campaign, directory.path() / "out", {.progress = progress});
  EXPECT_THAT(told, testing::ElementsAre(1, 2, 3));
}

TEST(Plan, ADirectoryThatCannotBeMadeIsRefused) {
  const TestDirectory directory;
  directory.write("out", "a file");
  EXPECT_THAT(
      message_of(directory,
                 [&] { make_plan(load(directory, generating(1)), directory.path() / "out"); }),
      testing::StartsWith("out/scenarios: expected a directory that can be made"));
}

}  // namespace
}  // namespace bqsa::harness
