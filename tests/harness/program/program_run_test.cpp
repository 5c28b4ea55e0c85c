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

  /// What `run` says last.
  std::string report_line() const { return "report: " + out_ + "/report.html\n"; }

  std::string trajectory(const std::string& variant) const {
    return out_ + "/trajectories/planar_7r/" + variant + ".csv";
  }

  TemporaryDirectory directory_;
  const std::string out_ = (directory_.path() / "results").string();
};

TEST_F(ProgramRun, TheClosestPointRivalsSolveThePlanarSceneWithTheirDefaults) {
  const ProgramResult result =
      run({kPlanar, "--strict", "--method", "maciejewski_klein", "--method", "fcl_gp"});
  EXPECT_EQ(result.status, 0) << result.out;
  const std::vector<nlohmann::json> all = records();
  ASSERT_EQ(all.size(), 2u);
  for (const nlohmann::json& record : all) {
    EXPECT_EQ(record["judged"]["success"], true) << record["method"]["name"];
    EXPECT_EQ(record["claimed"]["status"], "nothing");
  }
}

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
  EXPECT_EQ(shown.out + report_line(), result.out);
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
  EXPECT_EQ(result.err.find("broken.yaml", first + 1), std::string::npos) << "said twice";
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
  EXPECT_EQ(provenance["out_of_tree"], nlohmann::json::array());
  const nlohmann::json& libraries = provenance["libraries"];
  EXPECT_EQ(libraries["Eigen"].get<std::string>().substr(0, 2), "3.");
  EXPECT_EQ(libraries.size(), 11u);
  for (const auto& [name, version] : libraries.items()) {
    EXPECT_THAT(version.get<std::string>(), ::testing::MatchesRegex("[0-9]+[.][0-9.]+")) << name;
  }
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

/// Copies of the planar scenario, named `planar_s1_1`, `planar_s1_2`, ...
std::filesystem::path copies_in(const std::filesystem::path& directory, int count) {
  const std::filesystem::path copies = directory / "scenarios";
  std::filesystem::create_directories(copies);
  const std::string original = content_of(kPlanar);
  const std::string name = "name: planar_7r\n";
  const std::size_t place = original.find(name);
  if (place == std::string::npos) throw std::runtime_error("no name in " + kPlanar);
  for (int i = 1; i <= count; ++i) {
    std::string copy = original;
    copy.replace(place, name.size(), "name: planar_s1_" + std::to_string(i) + "\n");
    write_file(copies / ("planar_s1_" + std::to_string(i) + ".yaml"), copy);
  }
  write_file(copies / "readme.txt", "no scenario");
  return copies;
}

TEST_F(ProgramRun, ADirectoryOfManyScenariosGivesASummary) {
  const std::string many = copies_in(directory_.path(), 13).string();
  const ProgramResult result = run({many, "--method", "none", "--no-trajectories"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(records().size(), 13u);
  EXPECT_EQ(records()[1]["scenario"]["name"], "planar_s1_10") << "not in the order of names";
  EXPECT_THAT(result.out, HasSubstr("13 runs on 13 scenarios of 1 families\n"));
  EXPECT_THAT(result.out, ::testing::ContainsRegex("\nplanar\n  none +13 +0 +0.0 "));
  EXPECT_THAT(result.out, Not(HasSubstr("planar_s1_7:")));
  EXPECT_TRUE(std::filesystem::is_empty(out_ + "/trajectories"));
  EXPECT_TRUE(records()[0]["trajectory"].is_null());

  EXPECT_EQ(run_bqsa_bench({"show", out_}).out + report_line(), result.out);
  EXPECT_EQ(run_bqsa_bench({"show", out_, "--summary"}).out + report_line(), result.out);
  const std::string table = run_bqsa_bench({"show", out_, "--table"}).out;
  EXPECT_THAT(table, HasSubstr("planar_s1_13: 7 joints"));
  EXPECT_THAT(table, Not(HasSubstr("13 runs")));
  const std::string failures = run_bqsa_bench({"show", out_, "--failures"}).out;
  EXPECT_THAT(failures, ::testing::ContainsRegex("\nplanar_s1_7 +none +collides +[0-9]+ +6 "));
}

TEST_F(ProgramRun, FewScenariosGiveATableUnlessASummaryIsAskedFor) {
  const std::string few = copies_in(directory_.path(), 2).string();
  const ProgramResult result = run({few, "--method", "none", "--summary"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("2 runs on 2 scenarios"));
  EXPECT_THAT(run_bqsa_bench({"show", out_}).out, HasSubstr("planar_s1_2: 7 joints"));
}

TEST_F(ProgramRun, DisturbedRunsStandBesideTheOthers) {
  ASSERT_EQ(run({kPlanar, "--method", "none"}).status, 0);
  ASSERT_EQ(run({kPlanar, "--method", "none", "--latency"}).status, 0);
  const std::vector<std::string> noisy = {kPlanar, "--method", "none", "--joint-noise",
                                          "1e-3",  "--seed",   "5"};
  const ProgramResult result = run(noisy);
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("normal noise of 0.001 rad, seed 5"));
  ASSERT_EQ(run(noisy).status, 0);
  const std::vector<nlohmann::json> all = records();
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[1]["method"]["variant"], "none+latency");
  EXPECT_EQ(all[2]["method"]["variant"], "none+noise=0.001+seed=5");
  EXPECT_EQ(all[2]["judged"], all[3]["judged"]) << "the same seed";
  EXPECT_NE(all[2]["judged"], all[0]["judged"]);
  EXPECT_TRUE(std::filesystem::exists(trajectory("none")));
  EXPECT_TRUE(std::filesystem::exists(trajectory("none+noise=0.001+seed=5")));
  const std::string table = run_bqsa_bench({"show", out_}).out;
  for (const char* row : {"x   none ", "x   none+latency ", "x   none+noise=0.001+seed=5"}) {
    EXPECT_THAT(table, HasSubstr(row));
  }
}

TEST_F(ProgramRun, StepRepeatsTheSlowestTick) {
  ASSERT_EQ(run({kPlanar, "--method", "bqsa"}).status, 0);
  const nlohmann::json times = records().at(0)["times"];
  const int tick = times["warm_max_tick"];
  const ProgramResult slowest =
      run_bqsa_bench({"step", kPlanar, "--method", "bqsa", "--slowest", out_});
  ASSERT_EQ(slowest.status, 0) << slowest.err;
  EXPECT_THAT(slowest.out, HasSubstr("tick: " + std::to_string(tick) + " of 400"));
  EXPECT_THAT(slowest.out, HasSubstr("time of 1000 repetitions [us]: median "));
  EXPECT_THAT(slowest.out, Not(HasSubstr("remembers")));

  // The answer is the row that follows in the trajectory, and the state can be taken from there.
  std::istringstream rows(content_of(trajectory("bqsa")));
  std::string row;
  for (int line = 0; line < tick + 2; ++line) std::getline(rows, row);
  EXPECT_THAT(slowest.out, HasSubstr("q after [rad]: " + row.substr(row.find(',') + 1) + "\n"));
  const ProgramResult same = run_bqsa_bench({"step", kPlanar, "--method", "bqsa", "--tick",
                                             std::to_string(tick), "--state", trajectory("bqsa")});
  ASSERT_EQ(same.status, 0) << same.err;
  const auto without_time = [](const std::string& text) {
    return text.substr(0, text.find("time of"));
  };
  EXPECT_EQ(without_time(same.out), without_time(slowest.out));

  const ProgramResult other =
      run_bqsa_bench({"step", kPlanar, "--method", "none", "--slowest", out_});
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("holds no slowest tick of none on this file of planar_7r"));
}

TEST_F(ProgramRun, StepRepeatsTheSlowestTickOfAllRepetitionsOfACampaign) {
  ASSERT_EQ(run({kPlanar, "--method", "bqsa", "--joint-noise", "1e-6"}).status, 0);
  nlohmann::json record = records().at(0);
  record["method"]["variant"] = "bqsa+noise=1e-06";
  std::string lines, plan;
  const auto add = [&](int repetition, const std::string& key, int tick, double seconds,
                       bool planned) {
    record["campaign"] = {{"name", "small"}, {"key", key}, {"repetition", repetition}};
    record["times"]["warm_max_tick"] = tick;
    record["times"]["warm_max_s"] = seconds;
    lines += record.dump() + "\n";
    if (!planned) return;
    plan += nlohmann::json{{"key", key},
                           {"scenario", "planar_7r"},
                           {"variant", "bqsa+noise=1e-06"},
                           {"repetition", repetition}}
                .dump() +
            "\n";
  };
  add(1, "k1", 11, 1e-3, true);
  add(2, "k2", 22, 3e-3, true);
  add(3, "old", 44, 9e-3, false);  // of a changed program: the last of its repetition, too
  add(3, "k3", 33, 2e-3, true);
  add(4, "stale", 55, 9e-3, false);
  write_file(out_ + "/runs.jsonl", lines);
  write_file(out_ + "/plan.jsonl",
             R"({"schema":"bqsa-plan/1","campaign":"small","program":"p","runs":3})"
             "\n" +
                 plan);
  const ProgramResult slowest =
      run_bqsa_bench({"step", kPlanar, "--method", "bqsa", "--slowest", out_});
  ASSERT_EQ(slowest.status, 0) << slowest.err;
  EXPECT_THAT(slowest.out, HasSubstr("tick: 22 of 400"));
}

TEST_F(ProgramRun, StepSaysWhatWasCleared) {
  ASSERT_EQ(run({kPlanar, "--method", "bqsa"}).status, 0);
  bool cleared = false;
  for (int tick = 150; tick < 250 && !cleared; ++tick) {
    const ProgramResult step =
        run_bqsa_bench({"step", kPlanar, "--method", "bqsa", "--tick", std::to_string(tick),
                        "--state", trajectory("bqsa")});
    ASSERT_EQ(step.status, 0) << step.err;
    if (step.out.find("state: clamped") == std::string::npos) continue;
    cleared = true;
    EXPECT_THAT(step.out, HasSubstr("clamp: (6, obstacle), anchor "));
    EXPECT_THAT(step.out, ::testing::ContainsRegex("increments: [1-9]"));
    EXPECT_THAT(step.out, ::testing::ContainsRegex("work: [1-9][0-9]* quadratics"));
  }
  EXPECT_TRUE(cleared);
}

TEST_F(ProgramRun, PlannersRunOnceWithEachSeedOthersOnce) {
  const ProgramResult result =
      run({kPlanar, "--method", "none", "--method", "ompl", "--seed", "7", "--seeds", "3"});
  ASSERT_EQ(result.status, 0) << result.err;
  const std::vector<nlohmann::json> all = records();
  ASSERT_EQ(all.size(), 4u);
  EXPECT_TRUE(all[0]["method"]["seed"].is_null());
  for (std::size_t k = 1; k < all.size(); ++k) {
    EXPECT_EQ(all[k]["method"]["seed"], 6 + k);
    EXPECT_EQ(all[k]["judged"]["success"], true);
  }
  EXPECT_NE(content_of(trajectory("ompl+seed=7")), content_of(trajectory("ompl+seed=8")));
  const ProgramResult show = run_bqsa_bench({"show", out_, "--summary"});
  EXPECT_THAT(show.out, HasSubstr("4 runs on 1 scenarios"));
}

TEST_F(ProgramRun, InThisProcessOrInItsOwnARunIsTheSame) {
  ASSERT_EQ(run({kPlanar, "--method", "bqsa"}).status, 0);
  const std::string isolated = content_of(trajectory("bqsa"));
  ASSERT_EQ(run({kPlanar, "--method", "bqsa", "--in-process"}).status, 0);
  EXPECT_EQ(content_of(trajectory("bqsa")), isolated);
  EXPECT_EQ(records()[0]["provenance"]["isolated"], true);
  EXPECT_EQ(records()[1]["provenance"]["isolated"], false);
  EXPECT_EQ(records()[0]["counters"], records()[1]["counters"]);
}

TEST_F(ProgramRun, ARunBeyondItsLimitsIsAnOutcomeAndTheOthersGoOn) {
  const ProgramResult result = run({kPlanar, "--time-limit", "1", "--memory-limit", "256",
                                    "--method", "test_point:n=10000,m=100000", "--method", "none"});
  EXPECT_EQ(result.status, 0) << result.err;
  const std::vector<nlohmann::json> all = records();
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0]["claimed"]["status"], "timed out");
  EXPECT_EQ(all[0]["judged"]["failures"][0], "timed_out");
  EXPECT_EQ(all[0]["judged"]["success"], false);
  EXPECT_EQ(all[1]["claimed"]["status"], "nothing");
  EXPECT_THAT(result.out, HasSubstr("timed out"));
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
