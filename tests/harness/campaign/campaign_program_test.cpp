// Campaigns as a user runs them: the same results however they are run, and only what is missing is run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "campaign_runs.hpp"

namespace bqsa::harness {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(CampaignTest, ResultsDoNotDependOnJobsOrderOrShards) {
  const Findings alone = undisturbed();
  ASSERT_EQ(alone.size(), kRuns);

  EXPECT_EQ(run("two", {"--jobs", "2"}).status, 0);
  EXPECT_EQ(findings_of(runs_of("two")), alone);

  EXPECT_EQ(run("shuffled", {"--jobs", "2", "--shuffle", "3"}).status, 0);
  EXPECT_EQ(findings_of(runs_of("shuffled")), alone);

  for (const char* shard : {"3/5", "1/5", "5/5", "2/5", "4/5"}) {
    EXPECT_EQ(run("sharded", {"--shard", shard}).status, 0);
  }
  EXPECT_FALSE(std::filesystem::exists(runs_of("sharded")));
  EXPECT_EQ(run_bqsa_bench({"merge", path("sharded"), "--out", path("merged")}).status, 0);
  EXPECT_EQ(findings_of(runs_of("merged")), alone);
}

TEST_F(CampaignTest, ShufflingChangesTheOrder) {
  run("plan", {"--jobs", "1"});
  run("shuffled", {"--jobs", "1", "--shuffle", "3"});
  const auto keys_of = [&](const std::string& directory) {
    std::vector<std::string> keys;
    for (const std::string& line : lines_of(runs_of(directory))) {
      keys.push_back(nlohmann::json::parse(line)["campaign"]["key"]);
    }
    return keys;
  };
  EXPECT_NE(keys_of("plan"), keys_of("shuffled"));
  EXPECT_THAT(keys_of("shuffled"), ::testing::UnorderedElementsAreArray(keys_of("plan")));
}

TEST_F(CampaignTest, WhatIsRecordedIsNotRunAgain) {
  const Findings alone = undisturbed();
  const std::string before = content_of(runs_of("undisturbed"));
  const ProgramResult again = run("undisturbed");
  EXPECT_EQ(again.status, 0);
  EXPECT_THAT(again.err, HasSubstr("12 runs planned, 12 recorded, 0 to do"));
  EXPECT_EQ(content_of(runs_of("undisturbed")), before);

  // Lines in the middle and at the end are lost.
  std::vector<std::string> lines = lines_of(runs_of("undisturbed"));
  std::string rest;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (i != 4 && i != 11) rest += lines[i] + "\n";
  }
  write_file(runs_of("undisturbed"), rest);
  EXPECT_THAT(run("undisturbed").err, HasSubstr("10 recorded, 2 to do"));
  EXPECT_EQ(findings_of(runs_of("undisturbed")), alone);
}

TEST_F(CampaignTest, ForceRepeatsAndTheLaterRecordCounts) {
  run("out");
  EXPECT_EQ(run("out", {"--force"}).status, 0);
  EXPECT_EQ(lines_of(runs_of("out")).size(), 2 * kRuns);
  const std::string status = run_bqsa_bench({"status", path("out")}).out;
  EXPECT_THAT(status, HasSubstr("recorded   12 (100.0 %)"));
  EXPECT_THAT(status, HasSubstr("repeated   12"));

  const std::string last = lines_of(runs_of("out")).back();
  EXPECT_EQ(run_bqsa_bench({"merge", path("out"), "--out", path("merged")}).status, 0);
  EXPECT_EQ(lines_of(runs_of("merged")).size(), kRuns);
  EXPECT_THAT(content_of(runs_of("merged")), HasSubstr(last));
}

TEST_F(CampaignTest, OtherParametersMakeOldRecordsStale) {
  run("out");
  write_campaign("[{method: bqsa, parameters: {increment: 0.004}}, maciejewski_klein]");
  EXPECT_THAT(run("out").err, HasSubstr("12 runs planned, 6 recorded, 6 to do"));
  EXPECT_THAT(run_bqsa_bench({"status", path("out")}).out, HasSubstr("stale      6 records"));
  // In the summary there is nothing of the old ones.
  const std::string shown = run_bqsa_bench({"show", path("out"), "--summary"}).out;
  EXPECT_THAT(shown, HasSubstr("bqsa@"));
  EXPECT_THAT(shown, Not(HasSubstr("bqsa   ")));
}

TEST_F(CampaignTest, AnotherScenarioMakesItsRecordsStale) {
  run("out");
  const std::filesystem::path file = path("out/scenarios/planar_s5_00002.yaml");
  std::filesystem::create_directory(path("mine"));
  for (const auto& entry : std::filesystem::directory_iterator(path("out/scenarios"))) {
    std::filesystem::copy(entry.path(), path("mine") / entry.path().filename());
  }
  write_file(campaign_,
             "schema: bqsa-campaign/1\nname: small\nscenarios: [\"mine/*.yaml\"]\n"
             "methods: [bqsa, maciejewski_klein]\n");
  EXPECT_THAT(run("out").err, HasSubstr("12 recorded, 0 to do")) << "the same bytes elsewhere";
  write_file(path("mine/planar_s5_00002.yaml"), content_of(file) + "# another byte\n");
  EXPECT_THAT(run("out").err, HasSubstr("10 recorded, 2 to do"));
}

TEST_F(CampaignTest, MissingNamesTheShardsToRunAgain) {
  for (const char* shard : {"1/4", "2/4", "4/4"}) run("out", {"--shard", shard});
  EXPECT_EQ(run_bqsa_bench({"missing", "4", path("out")}).out, "3\n");
  EXPECT_EQ(run_bqsa_bench({"missing", "12", path("out")}).out, "3,6,9\n");
  const ProgramResult merged = run_bqsa_bench({"merge", path("out"), "--out", path("merged")});
  EXPECT_EQ(merged.status, 1);
  EXPECT_THAT(merged.err, HasSubstr("missing: planar_s5_00001 bqsa repetition 1"));
  EXPECT_EQ(findings_of(runs_of("merged")).size(), 9U);

  run("out", {"--shard", "3/4"});
  EXPECT_EQ(run_bqsa_bench({"missing", "4", path("out")}).out, "\n");
  // A shard that is complete has nothing to do, and neither has the whole.
  EXPECT_THAT(run("out", {"--shard", "3/4"}).err, HasSubstr("3 recorded, 0 to do"));
  EXPECT_THAT(run("out").err, HasSubstr("12 recorded, 0 to do"));
}

TEST_F(CampaignTest, MergingInPlaceKeepsStaleRecordsAndDropsShardFiles) {
  run("out", {"--shard", "1/2"});
  write_campaign("[{method: bqsa, parameters: {increment: 0.004}}, maciejewski_klein]");
  run("out", {"--shard", "1/2"});
  run("out", {"--shard", "2/2"});
  EXPECT_EQ(run_bqsa_bench({"merge", path("out"), "--out", path("out")}).status, 0);
  EXPECT_EQ(findings_of(runs_of("out")).size(), kRuns + 3);
  EXPECT_FALSE(std::filesystem::exists(path("out/shards/1-of-2.jsonl")));
}

TEST_F(CampaignTest, MergeTakesTrajectoriesAlong) {
  run("one", {"--shard", "1/2"});
  run("two", {"--shard", "2/2"});
  EXPECT_EQ(run_bqsa_bench({"merge", path("one"), path("two"), "--out", path("both")}).status, 0);
  int files = 0;
  for (const std::string& line : lines_of(runs_of("both"))) {
    const std::string name = nlohmann::json::parse(line)["trajectory"];
    files += std::filesystem::exists(path("both") + "/" + name);
  }
  EXPECT_EQ(files, static_cast<int>(kRuns));
}

TEST_F(CampaignTest, DirectoriesOfDifferentCampaignsAreNotMixed) {
  run("out");
  write_file(campaign_,
             "schema: bqsa-campaign/1\nname: other\n"
             "scenarios: [{generate: {family: planar, seed: 5, count: 1}}]\n"
             "methods: [bqsa]\n");
  const ProgramResult refused = run("out");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("campaign small"));
  const ProgramResult single = run_bqsa_bench({"run", kPlanar, "-m", "none", "--out", path("out")});
  EXPECT_EQ(single.status, 2);
  EXPECT_THAT(single.err, HasSubstr("got that of a campaign"));
  run("other");
  const ProgramResult merged =
      run_bqsa_bench({"merge", path("out"), path("other"), "--out", path("both")});
  EXPECT_EQ(merged.status, 2);
  EXPECT_THAT(merged.err, HasSubstr("expected the same plan"));
  EXPECT_FALSE(std::filesystem::exists(runs_of("both")));
}

TEST_F(CampaignTest, OptionsThatTheCampaignHasItselfAreRefused) {
  EXPECT_THAT(run("out", {"--method", "bqsa"}).err, HasSubstr("--method: is for scenarios"));
  EXPECT_THAT(run("out", {"--seed", "2"}).err, HasSubstr("--seed: is for scenarios"));
  EXPECT_THAT(run_bqsa_bench({"run", kPlanar, "--shard", "1/2", "--out", path("out")}).err,
              HasSubstr("--shard: is for a campaign"));
  for (const char* shard : {"0/2", "3/2", "1", "a/b", "1/2/3", "-1/2", "1/100001"}) {
    EXPECT_THAT(run("out", {"--shard", shard}).err, HasSubstr("expected k/N")) << shard;
  }
}

}  // namespace
}  // namespace bqsa::harness
