// The commands run, show and judge on real scenarios.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "harness/results/result_store.hpp"
#include "program_runner.hpp"

namespace bqsa::harness {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class ProgramRun : public ::testing::Test {
 protected:
  ProgramResult run(std::vector<std::string> words) {
    words.insert(words.begin(), "run");
    words.insert(words.end(), {"--out", out_});
    return run_bqsa_bench(words);
  }

  std::vector<nlohmann::json> records() const {
    std::vector<nlohmann::json> list;
    for (const StoredLine& line : read_lines(runs_file(out_))) {
      list.push_back(nlohmann::json::parse(line.text));
    }
    return list;
  }

  std::string broken_scenario() const {
    const std::string file = (directory_.path() / "broken.yaml").string();
    write_file(file, "schema: bqsa-scenario/1\nname: broken\n");
    return file;
  }

  std::string trajectory(const std::string& variant) const {
    return out_ + "/trajectories/planar_7r/" + variant + ".csv";
  }

  TemporaryDirectory directory_;
  const std::string out_ = (directory_.path() / "results").string();
};

TEST_F(ProgramRun, AllMethodsRunOnAllScenariosAndShowPrintsTheSameTable) {
  const ProgramResult result = run({kPlanar, kPuma});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, IsEmpty());
  const std::vector<nlohmann::json> all = records();
  ASSERT_GE(all.size(), 4u);
  EXPECT_EQ(all.size() % 2, 0u);
  int judged = 0;
  for (const nlohmann::json& record : all) {
    EXPECT_EQ(record["schema"], "bqsa-run/1");
    if (record["judged"].is_null()) continue;
    ++judged;
    EXPECT_TRUE(std::filesystem::exists(out_ + "/" + record["trajectory"].get<std::string>()));
  }
  EXPECT_GE(judged, 4);
  const ProgramResult shown = run_bqsa_bench({"show", out_});
  EXPECT_EQ(shown.status, 0);
  EXPECT_EQ(shown.out, result.out);
  EXPECT_THAT(shown.out, HasSubstr("(7, object)"));
}

TEST_F(ProgramRun, JudgeComesToTheSameVerdictOnTheStoredTrajectory) {
  ASSERT_EQ(run({kPlanar, "--method", "none", "--method", "bqsa"}).status, 0);
  int compared = 0;
  for (const nlohmann::json& record : records()) {
    const std::string file = out_ + "/" + record["trajectory"].get<std::string>();
    const ProgramResult judged = run_bqsa_bench({"judge", kPlanar, file, "--strict"});
    const bool success = record["judged"]["success"].get<bool>();
    EXPECT_EQ(judged.status, success ? 0 : 1) << file;
    EXPECT_THAT(judged.out, HasSubstr(success ? "verdict: success\n" : "verdict: failure: "));
    for (const auto& contact : record["judged"]["contacts"]) {
      EXPECT_THAT(judged.out, HasSubstr("collided: (" + std::to_string(contact["link"].get<int>()) +
                                        ", " + contact["obstacle"].get<std::string>() + ")"));
    }
    ++compared;
  }
  EXPECT_EQ(compared, 2);
  EXPECT_EQ(run_bqsa_bench({"judge", kPlanar, trajectory("none")}).status, 0);
}

TEST_F(ProgramRun, StrictTellsWhetherARunFailed) {
  EXPECT_EQ(run({kPlanar, "--method", "none", "--strict"}).status, 1);
  EXPECT_EQ(run({kPlanar, "--method", "none"}).status, 0);
  EXPECT_EQ(run({kPlanar, "--method", "bqsa", "--strict"}).status, 0);
  // Not applicable is not a failure.
  EXPECT_EQ(run({kPuma, "--method", "bqsa_paper", "--strict"}).status, 0);
}

TEST_F(ProgramRun, QuietPrintsNothing) {
  const ProgramResult result = run({kPlanar, "--method", "none", "--quiet"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_EQ(records().size(), 1u);
}

TEST_F(ProgramRun, ARefusedScenarioDoesNotStopTheOthers) {
  const ProgramResult result = run({broken_scenario(), kPlanar, "--method", "none", "--strict"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("1 of 2 scenarios refused"));
  const std::size_t first = result.err.find("broken.yaml");
  ASSERT_NE(first, std::string::npos);
  EXPECT_NE(result.err.find("broken.yaml", first + 1), std::string::npos) << "no summary";
  ASSERT_EQ(records().size(), 1u);
  EXPECT_EQ(records()[0]["scenario"]["name"], "planar_7r");
  EXPECT_THAT(result.out, HasSubstr("planar_7r"));
}

TEST_F(ProgramRun, ParametersAreRecordedAndNameTheVariant) {
  ASSERT_EQ(run({kPlanar, "--method", "bqsa:search_range=0.5", "--method", "bqsa"}).status, 0);
  const std::vector<nlohmann::json> all = records();
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0]["method"]["parameters"]["search_range"], 0.5);
  EXPECT_EQ(all[0]["method"]["changed"], "search_range=0.5");
  EXPECT_THAT(all[0]["method"]["variant"].get<std::string>(),
              ::testing::MatchesRegex("bqsa@[0-9a-f]+"));
  EXPECT_EQ(all[1]["method"]["variant"], "bqsa");
  EXPECT_TRUE(std::filesystem::exists(trajectory("bqsa")));
  EXPECT_TRUE(std::filesystem::exists(trajectory(all[0]["method"]["variant"])));
}

TEST_F(ProgramRun, RunsAreAddedAndTheLastOneIsShown) {
  ASSERT_EQ(run({kPlanar, "--method", "none"}).status, 0);
  ASSERT_EQ(run({kPlanar, "--method", "none"}).status, 0);
  EXPECT_EQ(records().size(), 2u);
  const std::string table = run_bqsa_bench({"show", out_}).out;
  EXPECT_EQ(table.find("   none "), table.rfind("   none "));
  EXPECT_THAT(table, HasSubstr("   none "));
}

TEST_F(ProgramRun, ShowReportsBrokenLinesAndShowsTheOthers) {
  ASSERT_EQ(run({kPlanar, "--method", "none"}).status, 0);
  const std::string good = content_of(runs_file(out_));
  write_file(runs_file(out_), good + "{\"schema\": \"other/1\"}\n[]\n" + good.substr(0, 300));
  const ProgramResult result = run_bqsa_bench({"show", out_});
  EXPECT_EQ(result.status, 2);
  for (const char* place : {"runs.jsonl:2: ", "runs.jsonl:3: ", "runs.jsonl:4: "}) {
    EXPECT_THAT(result.err, HasSubstr(place));
  }
  EXPECT_THAT(result.err, Not(HasSubstr("runs.jsonl:1: ")));
  EXPECT_THAT(result.err, HasSubstr("runs.jsonl:4: cut short or damaged; left out\n"));
  EXPECT_THAT(result.err, Not(HasSubstr("json.exception")));
  EXPECT_THAT(result.out, HasSubstr("collides"));
}

TEST_F(ProgramRun, ADirectoryThatCannotBeWrittenIsRefusedBeforeAnythingRuns) {
  // Below a regular file nobody can write, root included.
  const std::filesystem::path file = directory_.path() / "file";
  write_file(file, "content");
  const ProgramResult below =
      run_bqsa_bench({"run", kPlanar, "--out", (file / "results").string()});
  EXPECT_EQ(below.status, 2);
  EXPECT_THAT(below.err, HasSubstr("cannot write"));
  EXPECT_THAT(below.out, IsEmpty());
  EXPECT_EQ(run_bqsa_bench({"run", kPlanar, "--out", file.string()}).status, 2);
  EXPECT_EQ(content_of(file), "content");

  std::filesystem::create_directories(runs_file(out_));  // a directory in the place of the file
  const ProgramResult blocked = run({kPlanar});
  EXPECT_EQ(blocked.status, 2);
  EXPECT_THAT(blocked.err, HasSubstr("runs.jsonl: cannot write"));
  EXPECT_THAT(blocked.out, IsEmpty());
}

TEST_F(ProgramRun, JudgeRefusesTrajectoriesThatAreNotWhole) {
  ASSERT_EQ(run({kPlanar, "--method", "none"}).status, 0);
  const std::string whole = content_of(trajectory("none"));
  const std::string file = (directory_.path() / "spoilt.csv").string();

  write_file(file, whole.substr(0, whole.size() - 5));
  const ProgramResult truncated = run_bqsa_bench({"judge", kPlanar, file});
  EXPECT_EQ(truncated.status, 2);
  EXPECT_THAT(truncated.err, HasSubstr("spoilt.csv:402"));

  write_file(file, "t,q1,q2\n0,1,2\n");
  const ProgramResult narrow = run_bqsa_bench({"judge", kPlanar, file});
  EXPECT_EQ(narrow.status, 2);
  EXPECT_THAT(narrow.err, HasSubstr("spoilt.csv:1"));
  EXPECT_THAT(narrow.out, IsEmpty());
}

TEST_F(ProgramRun, ARecordNamesTheCallAndTheBuild) {
  ASSERT_EQ(run({kPlanar, "--method", "none"}).status, 0);
  const nlohmann::json provenance = records().at(0)["provenance"];
  EXPECT_EQ(provenance["command_line"],
            "bqsa-bench run " + kPlanar + " --method none --out " + out_);
  EXPECT_THAT(provenance["date"].get<std::string>(), ::testing::MatchesRegex("20[0-9-]+T[0-9:]+Z"));
  EXPECT_EQ(provenance["libraries"]["Eigen"].get<std::string>().substr(0, 2), "3.");
  EXPECT_EQ(records().at(0)["scenario"]["sha256"].get<std::string>().size(), 64u);
}

TEST_F(ProgramRun, ClosedStandardStreamsDoNotPrintIntoTheResults) {
  const std::string command = BQSA_BENCH " run " + broken_scenario() + " " + kPlanar +
                              " --method none --method bqsa --out " + out_;
  const int status = std::system((command + " <&- >&- 2>&-").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2) << "one scenario is broken";
  EXPECT_EQ(records().size(), 2u);
  EXPECT_EQ(run_bqsa_bench({"show", out_}).status, 0);
  ASSERT_EQ(std::system((BQSA_BENCH " list >&-")), 0);
}

TEST_F(ProgramRun, ALimitOnTheSizeOfFilesLeavesWholeRecords) {
  // Room for some records, not for a trajectory.
  const std::string command = BQSA_BENCH " run " + kPlanar + " -q --method none --out " + out_;
  int recorded = 0;
  for (int i = 0; i < 8; ++i) {
    const int status = std::system(("ulimit -f 16; exec " + command + " 2>/dev/null").c_str());
    ASSERT_TRUE(WIFEXITED(status)) << "ended by a signal";
    EXPECT_EQ(WEXITSTATUS(status), 2);
    EXPECT_EQ(content_of(runs_file(out_)).back(), '\n');
  }
  for (const nlohmann::json& record : records()) {
    ++recorded;
    EXPECT_TRUE(record["trajectory"].is_null());
  }
  EXPECT_GE(recorded, 1);
  EXPECT_LT(recorded, 8);
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(records().size(), recorded + 1u);
}

TEST_F(ProgramRun, OnlyARegularFileHoldsRuns) {
  std::filesystem::create_directories(out_);
  ASSERT_EQ(mkfifo(runs_file(out_).c_str(), 0600), 0);
  const ProgramResult shown = run_bqsa_bench({"show", out_});
  EXPECT_EQ(shown.status, 2);
  EXPECT_THAT(shown.err, HasSubstr("runs.jsonl: cannot read"));
  const ProgramResult added = run({kPlanar, "--method", "none"});
  EXPECT_EQ(added.status, 2);
  EXPECT_THAT(added.err, HasSubstr("runs.jsonl: cannot write: not a regular file"));
}

TEST_F(ProgramRun, AReaderThatGoesAwayCostsNoResults) {
  // The reader is gone before the refusal of the first scenario is printed.
  const std::string command = "(sleep 0.3; " BQSA_BENCH " run " + broken_scenario() + " " +
                              kPlanar + " --method none --method bqsa --out " + out_ +
                              ") 2>&1 | true";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(records().size(), 2u);
}

}  // namespace
}  // namespace bqsa::harness
