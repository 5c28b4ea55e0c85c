// Large results: which runs are replayed, and how large a page gets.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/report/page.hpp"
#include "harness/report/replay_choice.hpp"
#include "results_directory.hpp"
#include "schema_check.hpp"

namespace bqsa::harness::report {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// `scenarios` copies of a scenario file of 400 ticks with `methods` variants each, whose trajectories are
/// that of one real run.
void make_large(ResultsDirectory& results, int scenarios, int methods) {
  results.add(scenario_named("planar_7r"), method_named("none"));
  const nlohmann::json record = results.records()[0];
  std::string text;
  for (int s = 0; s < scenarios; ++s) {
    for (int m = 0; m < methods; ++m) {
      nlohmann::json copy = record;
      copy["scenario"]["name"] = fmt::format("planar_7r_{}", s);
      copy["method"]["variant"] = fmt::format("none_{}", m);
      text += copy.dump() + '\n';
      copy["scenario"]["name"] = "";
    }
  }
  // A trajectory belongs to the last record that names it: each has its own.
  std::string named;
  std::istringstream lines(text);
  int i = 0;
  for (std::string line; std::getline(lines, line); ++i) {
    nlohmann::json copy = nlohmann::json::parse(line);
    const std::string file = fmt::format("trajectories/{}.csv", i);
    std::filesystem::create_hard_link(results.path() / "trajectories/planar_7r/none.csv",
                                      results.path() / file);
    copy["trajectory"] = file;
    named += copy.dump() + '\n';
  }
  results.write(kRunsFile, named);
}

TEST(PageLimits, TwentyScenariosByTenMethodsStayBelow25Megabytes) {
  ResultsDirectory results;
  make_large(results, 20, 10);
  const PageData data = results.page();
  EXPECT_EQ(data.json["replays"].size(), 200U);
  const std::string page = filled_page(page_template(), data.json);
  EXPECT_LT(page.size(), 25'000'000U);
  EXPECT_GT(page.size(), 10'000'000U);
  EXPECT_EQ(schema_errors(as_read(data)), "");
}

TEST(PageLimits, ReplaysNoMoreThanAskedForAndSaysSo) {
  ResultsDirectory results;
  make_large(results, 3, 3);
  PageSources sources = results.sources();
  sources.limits.replays = 4;
  const nlohmann::json page = as_read(page_data(sources, methods()));
  EXPECT_EQ(page["replays"].size(), 4U);
  std::map<int, int> by_scenario;
  int left_out = 0;
  for (const nlohmann::json& run : page["runs"]) {
    if (!run["replay"].is_null()) {
      ++by_scenario[run["scenario"]];
    } else {
      ++left_out;
      EXPECT_THAT(run["no_replay"].get<std::string>(), HasSubstr("--replays"));
    }
  }
  EXPECT_EQ(left_out, 5);
  EXPECT_THAT(by_scenario, ElementsAre(std::pair(0, 2), std::pair(1, 1), std::pair(2, 1)));
  sources.limits.replays = 0;
  const nlohmann::json without = as_read(page_data(sources, methods()));
  EXPECT_EQ(without["replays"].size(), 0U);
  EXPECT_FALSE(without["scenarios"][0]["scene"].is_null());
}

TEST(PageLimits, KeepToASize) {
  ResultsDirectory results;
  make_large(results, 2, 4);
  PageSources sources = results.sources();
  sources.limits.bytes = 300'000;
  const PageData data = page_data(sources, methods());
  EXPECT_EQ(data.json["replays"].size(), 3U);
  const nlohmann::json page = as_read(data);
  EXPECT_EQ(schema_errors(page), "");
  EXPECT_THAT(page["runs"].dump(), HasSubstr("the page would be too large"));
}

IndexedRun indexed(std::size_t scenario, std::size_t method, const ExportedRun& run) {
  return {.scenario = scenario, .method = method, .run = &run};
}

TEST(ReplayChoice, TakesFailuresFirstAndSpreadsOverScenarios) {
  ExportedRun good, bad, unstored;
  good.trajectory = bad.trajectory = "a.csv";
  good.row.success = true;
  // Scenario 0: one good, one bad; scenario 1: good, and bad in a repetition; scenario 2: two bad.
  const std::vector<IndexedRun> runs = {
      indexed(0, 0, good), indexed(0, 1, bad), indexed(1, 0, good), indexed(1, 0, bad),
      indexed(1, 1, good), indexed(2, 0, bad), indexed(2, 1, bad),  indexed(2, 2, unstored)};
  EXPECT_THAT(wanted_replays(runs), ElementsAre(1, 3, 5, 6, 0, 4));
}

}  // namespace
}  // namespace bqsa::harness::report
