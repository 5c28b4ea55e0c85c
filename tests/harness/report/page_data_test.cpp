// What a page says of real results: as recorded, within the schema, and honest about what is missing.
#include "harness/report/page_data.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "bulk_reader.hpp"
#include "harness/report/paper_figures.hpp"
#include "harness/results/summary.hpp"
#include "harness/statistics/estimates.hpp"
#include "results_directory.hpp"
#include "schema_check.hpp"

namespace bqsa::harness::report {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::vector<const char*> kTimes = {"step_median_s", "step_p99_s", "step_p999_s",
                                         "step_max_s",    "plan_s",     "run_s"};

const std::vector<const char*> kMarks = {"best_rate", "best_tip_error", "best_step"};

/// A success, a collision, a crash, and a pair that does not fit.
class Page : public ::testing::Test {
 protected:
  Page() {
    const Scenario planar = scenario_named("planar_7r");
    results_.add(planar, method_named("bqsa"));
    results_.add(planar, method_named("none"));
    results_.add(planar, crashing());
    results_.add(planar, method_named("bqsa_projection"));
    results_.add(scenario_named("puma560_ellipsoid"), method_named("bqsa_projection"));
  }

  ResultsDirectory results_;
};

TEST_F(Page, KeepsToTheSchema) {
  const PageData page = results_.page();
  EXPECT_EQ(schema_errors(as_read(page)), "");
  EXPECT_THAT(page.problems, IsEmpty());
}

TEST_F(Page, SaysOfEachRunWhatItsRecordSays) {
  const nlohmann::json page = as_read(results_.page());
  const std::vector<nlohmann::json> records = results_.records();
  ASSERT_EQ(page["runs"].size(), records.size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    const nlohmann::json& record = records[i];
    const nlohmann::json run =
        *std::find_if(page["runs"].begin(), page["runs"].end(), [i](const nlohmann::json& one) {
          return one["record"] == fmt::format("runs.jsonl:{}", i + 1);
        });
    const nlohmann::json& scenario = page["scenarios"][run["scenario"].get<std::size_t>()];
    EXPECT_EQ(scenario["name"], record["scenario"]["name"]);
    EXPECT_EQ(scenario["sha256"], record["scenario"]["sha256"]);
    EXPECT_EQ(page["methods"][run["method"].get<std::size_t>()]["variant"],
              record["method"]["variant"]);
    EXPECT_EQ(run["applicable"], !record["judged"].is_null());
    EXPECT_EQ(run["date"], record["provenance"]["date"]);
    if (record["judged"].is_null()) continue;
    const nlohmann::json& judged = record["judged"];
    EXPECT_EQ(run["success"], judged["success"]);
    EXPECT_EQ(run["tip_error_mean_m"], judged["tip_error_at_ticks"]["mean_m"]);
    EXPECT_EQ(run["tip_error_rms_m"], judged["tip_error_at_ticks"]["rms_m"]);
    EXPECT_EQ(run["tip_error_max_m"], judged["tip_error_at_ticks"]["max_m"]);
    EXPECT_EQ(run["tip_error_max_tick"], judged["tip_error_at_ticks"]["max_tick"]);
    EXPECT_EQ(run["tip_error_between_max_m"], judged["tip_error_between_ticks"]["max_m"]);
    EXPECT_EQ(run["start_error_m"], judged["start_error_m"]);
    EXPECT_EQ(run["clearance_m"], judged["clearance_m"]);
    EXPECT_EQ(run["max_joint_step_rad"], judged["max_joint_step_rad"]);
    EXPECT_TRUE(run["max_joint_slide_m"].is_null());
    for (const auto& [key, value] : record["motion"].items()) EXPECT_EQ(run[key], value) << key;
    EXPECT_FALSE(run["jerk_rms_rad_s3"].is_null());
    EXPECT_EQ(run["clamp_starts"], record["ticks"]["clamp_starts"]);
    EXPECT_EQ(run["contacts"], judged["contacts"]);
    EXPECT_EQ(run["clamped"], record["ticks"]["clamped_pairs"]);
    EXPECT_EQ(run["counters"], record["counters"]);
    EXPECT_EQ(run["rows"], judged["rows"]);
  }
}

TEST(PageOfPrismaticJoints, SaysHowFarTheySlideInATick) {
  ResultsDirectory results;
  results.add(load_scenario(BQSA_SOURCE_DIR "/tests/harness/program/rail_arm.yaml"),
              scripted("jumping", [](const StepInput& input, StepOutput& output) {
                output.q = input.q;
                if (input.tick == 7) output.q(0) -= 0.3;
              }));
  const nlohmann::json page = as_read(results.page());
  EXPECT_EQ(schema_errors(page), "");
  const nlohmann::json& run = page["runs"][0];
  EXPECT_EQ(run["failures"][0], "jump");
  EXPECT_NEAR(run["max_joint_slide_m"].get<double>(), 0.3, 1e-12);
  EXPECT_EQ(run["max_joint_slide_tick"], 7);
  EXPECT_EQ(run["max_joint_step_rad"], 0);
}

TEST_F(Page, HasTimesOfSuccessesOnly) {
  const nlohmann::json page = as_read(results_.page());
  int successes = 0;
  for (const nlohmann::json& run : page["runs"]) {
    if (run["success"] == true) ++successes;
    for (const char* time : kTimes) {
      EXPECT_TRUE(run["success"] == true || run[time].is_null()) << run["record"] << time;
    }
  }
  EXPECT_EQ(successes, 2);
  EXPECT_GT(run_of(page, "bqsa")["step_median_s"], 0);
  EXPECT_GT(run_of(page, "bqsa")["run_s"], 0);
  for (const nlohmann::json& summary : page["summary"]) {
    EXPECT_TRUE(summary["successes"] > 0 || summary["step_median_s"].is_null());
  }
}

TEST_F(Page, ShowsCrashesAndPairsThatDoNotFitAsSuch) {
  const nlohmann::json page = as_read(results_.page());
  const nlohmann::json crash = run_of(page, "crashing");
  EXPECT_EQ(crash["claimed"], "crashed at tick 5");
  EXPECT_THAT(crash["claim_detail"].get<std::string>(), HasSubstr("out of ideas"));
  EXPECT_EQ(crash["success"], false);
  const nlohmann::json misfit = run_of(page, "bqsa_projection");
  EXPECT_EQ(misfit["applicable"], false);
  EXPECT_EQ(misfit["why_not"], "planar problems not supported yet");
  EXPECT_EQ(misfit["claimed"], "not applicable");
  EXPECT_TRUE(misfit["replay"].is_null());
  EXPECT_EQ(misfit["no_replay"], "");
  EXPECT_EQ(page["source"]["runs"], 4);
  EXPECT_EQ(page["source"]["not_applicable"], 1);
}

TEST_F(Page, ReplaysWhatIsStored) {
  const nlohmann::json page = as_read(results_.page());
  ASSERT_EQ(page["replays"].size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    const nlohmann::json& replay = page["replays"][i];
    const nlohmann::json& run = page["runs"][replay["run"].get<std::size_t>()];
    EXPECT_EQ(run["replay"], i);
    EXPECT_EQ(replay["rows"], run["rows"]);
    const std::vector<float> error = numbers_of<float>(replay["tip_error_m"]);
    EXPECT_NEAR(*std::max_element(error.begin() + 1, error.end()),
                run["tip_error_max_m"].get<double>(), 1e-6);
    const std::vector<float> clearance = numbers_of<float>(replay["clearance_m"]);
    EXPECT_NEAR(*std::min_element(clearance.begin(), clearance.end()),
                run["clearance_at_ticks_m"].get<double>(), 1e-6);
  }
}

TEST_F(Page, AddsUpAsTheStatisticsSay) {
  const nlohmann::json page = as_read(results_.page());
  int all = 0;
  for (const nlohmann::json& summary : page["summary"]) {
    if (summary["family"].is_null() && summary["robot"].is_null())
      all += summary["runs"].get<int>();
    if (summary["runs"] == 0) continue;
    const double successes = summary["successes"], runs = summary["runs"];
    EXPECT_DOUBLE_EQ(summary["rate"], successes / runs);
    const Interval interval = wilson_interval(successes, runs);
    EXPECT_DOUBLE_EQ(summary["rate_lower"], interval.lower);
    EXPECT_DOUBLE_EQ(summary["rate_upper"], interval.upper);
  }
  EXPECT_EQ(all, 4);
}

TEST_F(Page, AddsUpByRobotWhereTwoHaveNames) {
  const auto name_robots = [this](const char* of_the_plane, const char* of_space) {
    results_.change([&](nlohmann::json& record) {
      record["problem"]["robot"] =
          record["scenario"]["name"] == "planar_7r" ? of_the_plane : of_space;
    });
  };
  name_robots("flat </script>", "tall");
  const nlohmann::json page = as_read(results_.page());
  EXPECT_EQ(schema_errors(page), "");
  EXPECT_EQ(page["scenarios"][0]["robot"], "flat </script>");
  EXPECT_EQ(page["scenarios"][1]["robot"], "tall");
  // Both robots have one family each, named as its one scenario.
  std::map<std::tuple<std::string, std::string, std::size_t>, std::pair<int, int>> expected;
  for (const nlohmann::json& run : page["runs"]) {
    const nlohmann::json& scenario = page["scenarios"][run["scenario"].get<std::size_t>()];
    for (const std::string& family : {std::string("all"), scenario["name"].get<std::string>()}) {
      auto& [runs, successes] = expected[{scenario["robot"], family, run["method"]}];
      runs += run["applicable"] == true ? 1 : 0;
      successes += run["success"] == true ? 1 : 0;
    }
  }
  std::map<std::tuple<std::string, std::string, std::size_t>, std::pair<int, int>> found;
  for (const nlohmann::json& entry : page["summary"]) {
    if (entry["robot"].is_null()) continue;
    const std::string family = entry["family"].is_null() ? "all" : entry["family"];
    EXPECT_TRUE(found
                    .insert({{entry["robot"], family, entry["method"]},
                             {entry["runs"], entry["successes"]}})
                    .second);
  }
  EXPECT_EQ(found, expected);

  name_robots("tall", "tall");
  const nlohmann::json of_one_robot = as_read(results_.page());
  for (const nlohmann::json& entry : of_one_robot["summary"]) {
    EXPECT_TRUE(entry["robot"].is_null());
  }
}

TEST_F(Page, HasNoSceneOfAScenarioThatHasChanged) {
  results_.change([](nlohmann::json& record) {
    if (record["scenario"]["name"] == "planar_7r") {
      record["scenario"]["sha256"] = std::string(64, '0');
    }
  });
  const nlohmann::json page = as_read(results_.page());
  EXPECT_EQ(schema_errors(page), "");
  ASSERT_EQ(page["scenarios"].size(), 2U);
  EXPECT_TRUE(page["scenarios"][0]["scene"].is_null());
  EXPECT_THAT(page["scenarios"][0]["scene_missing"].get<std::string>(), HasSubstr("has changed"));
  EXPECT_FALSE(page["scenarios"][1]["scene"].is_null());
  EXPECT_EQ(page["scenarios"][1]["scene_missing"], "");
  EXPECT_EQ(page["replays"].size(), 1U);
  EXPECT_THAT(run_of(page, "bqsa")["no_replay"].get<std::string>(), HasSubstr("has changed"));
}

TEST_F(Page, FindsScenariosThatWereMoved) {
  results_.change([](nlohmann::json& record) {
    record["scenario"]["file"] =
        "gone/scenarios/" + record["scenario"]["name"].get<std::string>() + ".yaml";
  });
  EXPECT_TRUE(as_read(results_.page())["scenarios"][0]["scene"].is_null());
  PageSources sources = results_.sources();
  sources.scenarios = {BQSA_SOURCE_DIR "/scenarios"};
  EXPECT_FALSE(as_read(page_data(sources, methods()))["scenarios"][0]["scene"].is_null());
  sources.scenarios = {BQSA_SOURCE_DIR};
  EXPECT_FALSE(as_read(page_data(sources, methods()))["scenarios"][0]["scene"].is_null());
}

TEST_F(Page, SaysWhyTrajectoriesAreNotThere) {
  std::filesystem::remove(results_.path() / "trajectories/planar_7r/bqsa.csv");
  results_.write("trajectories/planar_7r/none.csv", "t,q1\n0,1\n");
  results_.change([this](nlohmann::json& record) {
    if (record["method"]["name"] == "crashing") record["trajectory"] = "../../secret.csv";
    if (record["scenario"]["name"] == "puma560_ellipsoid") {
      record["trajectory"] = results_.path() / record["trajectory"].get<std::string>();
    }
  });
  const nlohmann::json page = as_read(results_.page());
  EXPECT_EQ(schema_errors(page), "");
  EXPECT_THAT(run_of(page, "bqsa")["no_replay"].get<std::string>(), HasSubstr("bqsa.csv"));
  EXPECT_THAT(run_of(page, "none")["no_replay"].get<std::string>(),
              AllOf(HasSubstr("none.csv"), HasSubstr("expected")));
  EXPECT_THAT(run_of(page, "crashing")["no_replay"].get<std::string>(), HasSubstr("outside"));
  EXPECT_THAT(page["runs"].back()["no_replay"].get<std::string>(), HasSubstr("outside"));
}

TEST_F(Page, ReportsLinesThatAreNoRecords) {
  results_.append("{\"schema\":\"bqsa-run/1\",\"scen");
  results_.append("</script><script>alert(1)</script>");
  const PageData page = results_.page();
  EXPECT_EQ(page.problems.size(), 2U);
  const nlohmann::json json = as_read(page);
  EXPECT_EQ(schema_errors(json), "");
  ASSERT_EQ(json["source"]["bad_lines"].size(), 2U);
  EXPECT_THAT(json["source"]["bad_lines"][0].get<std::string>(), HasSubstr("runs.jsonl:6"));
  EXPECT_THAT(json["warnings"].dump(), HasSubstr("2 lines that are no record"));
}

TEST_F(Page, KeepsHostileNames) {
  const std::string name = "</script><script>alert(1)</script>\"'&\\ \xF0\x9F\xA4\x96";
  const std::string obstacle(10'000, '"');
  results_.change([&](nlohmann::json& record) {
    record["scenario"]["name"] = name;
    record["scenario"]["file"] = name;
    record["problem"]["obstacles"] = {obstacle, "<!--"};
    record["method"]["variant"] = record["method"]["name"].get<std::string>() + name;
    record["claimed"]["message"] = name;
    record["provenance"]["host"] = name;
  });
  const PageData page = results_.page();
  EXPECT_EQ(schema_errors(as_read(page)), "");
  const nlohmann::json json = as_read(page);
  EXPECT_EQ(json["scenarios"][0]["name"], name);
  EXPECT_EQ(json["scenarios"][0]["obstacles"][0], obstacle);
  EXPECT_EQ(run_of(json, "bqsa" + name)["success"], true);
}

TEST_F(Page, CountsTheLastOfSeveralRuns) {
  results_.add(scenario_named("planar_7r"), method_named("none"));
  const nlohmann::json page = as_read(results_.page());
  EXPECT_EQ(page["source"]["superseded"], 1);
  EXPECT_EQ(page["runs"].size(), 5U);
  EXPECT_EQ(run_of(page, "none")["record"], "runs.jsonl:6");
}

TEST_F(Page, WarnsOfWhatMakesFiguresDoubtful) {
  int i = 0;
  results_.change([&i](nlohmann::json& record) {
    record["provenance"]["processor"] = ++i % 2 == 0 ? "one" : "another";
    record["provenance"]["dirty"] = true;
    if (record.contains("times")) record["times"]["against"] = {"build type Debug"};
  });
  const std::string warnings = as_read(results_.page())["warnings"].dump();
  EXPECT_THAT(warnings, HasSubstr("runs of 2 processor models: another; one"));
  EXPECT_THAT(warnings, HasSubstr("sources that differ"));
  EXPECT_THAT(warnings, HasSubstr("times of 4 runs are only indicative: build type Debug"));
}

TEST_F(Page, SaysWhatItsMethodsAre) {
  results_.add(scenario_named("planar_7r"), method_named("bqsa:increment=0.004"));
  const nlohmann::json page = as_read(results_.page());
  const nlohmann::json& methods = page["methods"];
  std::vector<std::string> names;
  for (const nlohmann::json& method : methods) names.push_back(method["name"]);
  EXPECT_THAT(names, ElementsAre("none", "bqsa", "bqsa", "bqsa_projection", "crashing"));
  const nlohmann::json& changed = methods[2];
  EXPECT_EQ(changed["changed"], "increment=0.004");
  int seen = 0;
  for (const nlohmann::json& parameter : changed["parameters"]) {
    EXPECT_EQ(parameter["changed"], parameter["name"] == "increment") << parameter["name"];
    if (parameter["name"] != "increment") continue;
    ++seen;
    EXPECT_EQ(parameter["value"], "0.004");
    EXPECT_EQ(parameter["unit"], "rad");
  }
  EXPECT_EQ(seen, 1);
  EXPECT_NE(methods[1]["description"], "");
  EXPECT_EQ(methods[4]["description"], "");
}

TEST_F(Page, LeavesOutWhatLiesBesideAndCannotBeRead) {
  results_.write("measurements.json", "{}");
  results_.write("claims/claims.json", "[]");
  results_.write("figures/notes.txt", "");  // another's directory of figures
  const PageData page = results_.page();
  EXPECT_EQ(schema_errors(as_read(page)), "");
  EXPECT_EQ(page.problems.size(), 2U);
  EXPECT_TRUE(page.json["measurements"].is_null());
  EXPECT_TRUE(page.json["claims"].is_null());
  PageSources sources = results_.sources();
  sources.claims = results_.path() / "claims/claims.json";
  EXPECT_THROW(page_data(sources, methods()), InputError);
}

TEST_F(Page, LinksToTheFiguresThatAreThere) {
  results_.write("figures/index.md",
                 "# Figures\n\n| paper | figure | what it shows | files |\n|---|---|---|---|\n"
                 "| Fig. 5 | `fig05` | Time against NM | [csv](fig05.csv) [svg](fig05.svg) |\n"
                 "| - | `gone` | Nothing | [csv](gone.csv) [bad](../runs.jsonl) |\n"
                 "| - | `odd` | <b> | [csv](a b#.csv) |\n");
  results_.write("figures/fig05.svg", "");
  results_.write("figures/a b#.csv", "");
  const nlohmann::json page = as_read(results_.page());
  EXPECT_EQ(schema_errors(page), "");
  ASSERT_EQ(page["figures"].size(), 2U);
  EXPECT_EQ(page["figures"][0]["paper"], "Fig. 5");
  EXPECT_EQ(page["figures"][0]["files"],
            nlohmann::json::parse(R"([{"label": "svg", "href": "figures/fig05.svg"}])"));
  EXPECT_EQ(page["figures"][1]["files"][0]["href"], "figures/a%20b%23.csv");
}

/// The page may lie anywhere.
TEST_F(Page, LinksFromWhereItLies) {
  results_.write("figures/index.md", "| - | `one` | One | [csv](one.csv) |\n");
  results_.write("figures/one.csv", "");
  EXPECT_EQ(figures_json(results_.path() / "figures",
                         results_.path() / "pages/a.html")[0]["files"][0]["href"],
            "../figures/one.csv");
}

TEST(PageData, NeedsRecords) {
  const ResultsDirectory results;
  EXPECT_THROW(results.page(), InputError);
  results.write(kRunsFile, "not a record\n");
  try {
    results.page();
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("expected records of runs, got none"));
  }
}

/// Summaries of made-up runs, copies of a real success and of a real failure.
class PageSummary : public ::testing::Test {
 protected:
  struct Run {
    std::string method;
    int scenario = 0;
    bool success = true;
    int seed = 0;
    int repetition = 0;  ///< 0: not of a campaign
    double tip_error_m = 1e-5;
    double step_s = 1e-6;
  };

  PageSummary() {
    ResultsDirectory real;
    real.add(scenario_named("planar_7r"), method_named("bqsa"));
    real.add(scenario_named("planar_7r"), method_named("none"));
    success_ = real.records()[0];
    failure_ = real.records()[1];
    failure_["method"] = success_["method"];
    success_["times"]["against"] = nlohmann::json::array();
  }

  void add(const Run& run, const std::string& against_times = "") {
    nlohmann::json record = run.success ? success_ : failure_;
    record["scenario"]["name"] = fmt::format("planar_s1_{:05}", run.scenario);
    record["method"]["name"] = run.method;
    record["method"]["variant"] = run.method;
    record["method"]["seed"] = run.seed;
    if (run.repetition > 0) {
      record["campaign"] = {
          {"name", "made_up"}, {"key", std::string(32, '0')}, {"repetition", run.repetition}};
    }
    if (run.success) {
      record["judged"]["tip_error_at_ticks"]["max_m"] = run.tip_error_m;
      record["times"]["warm_median_s"] = run.step_s;
      if (!against_times.empty()) record["times"]["against"] = {against_times};
    }
    text_ += record.dump() + '\n';
  }

  /// Of a method over all scenarios.
  nlohmann::json summary_of(const std::string& method) {
    if (page_.is_null()) {
      ResultsDirectory results;
      results.write(kRunsFile, text_);
      page_ = as_read(results.page());
      EXPECT_EQ(schema_errors(page_), "");
    }
    for (const nlohmann::json& summary : page_["summary"]) {
      const auto index = summary["method"].get<std::size_t>();
      if (summary["family"].is_null() && page_["methods"][index]["name"] == method) return summary;
    }
    throw std::runtime_error("no summary of " + method);
  }

  /// "a" and "b" succeed, "a" with less error and in less time, "c" fails; all twice.
  /// @param against_last_time  what speaks against the time of the last run of "b"
  void add_pairs(int scenarios, const std::string& against_last_time = "") {
    for (int k = 0; k < scenarios; ++k) {
      for (int i = 1; i <= 2; ++i) {
        const bool last = k == scenarios - 1 && i == 2;
        add({.method = "a", .scenario = k, .repetition = i});
        add({.method = "b", .scenario = k, .repetition = i, .tip_error_m = 2e-5, .step_s = 2e-6},
            last ? against_last_time : "");
        add({.method = "c", .scenario = k, .success = false, .repetition = i});
      }
    }
  }

  nlohmann::json mark(const std::string& method, const char* which) {
    return summary_of(method)[which];
  }

 private:
  nlohmann::json success_, failure_, page_;
  std::string text_;
};

/// Two that always succeed are tied by success; of their tip errors one is smaller every time.
TEST_F(PageSummary, CallsTiesTies) {
  for (int k = 0; k < 12; ++k) {
    const bool even = k % 2 == 0;  // times differ to either side
    add({.method = "a",
         .scenario = k,
         .tip_error_m = 1e-5 + 1e-7 * k,
         .step_s = even ? 1e-6 : 2e-6});
    add({.method = "b",
         .scenario = k,
         .tip_error_m = 2e-5 + 1e-7 * k,
         .step_s = even ? 2e-6 : 1e-6});
    add({.method = "c", .scenario = k, .success = false});
  }
  for (const std::string method : {"a", "b"}) {
    const nlohmann::json summary = summary_of(method);
    EXPECT_EQ(summary["runs"], 12);
    EXPECT_EQ(summary["best_rate"], true) << method;
    EXPECT_EQ(summary["best_tip_error"], method == "a") << method;
    EXPECT_EQ(summary["best_step"], true) << method;
    const double least = method == "a" ? 1e-5 : 2e-5;
    EXPECT_NEAR(summary["tip_error_median_m"].get<double>(), least + 1e-7 * 5.5, 1e-15);
    EXPECT_LE(summary["tip_error_median_lower_m"], summary["tip_error_median_m"]);
    EXPECT_GE(summary["tip_error_median_upper_m"], summary["tip_error_median_m"]);
    EXPECT_NEAR(summary["tip_error_max_m"].get<double>(), least + 1e-7 * 11, 1e-15);
  }
  EXPECT_EQ(mark("c", "best_rate"), false);
  EXPECT_TRUE(mark("c", "best_tip_error").is_null());
  EXPECT_TRUE(mark("c", "best_step").is_null());
}

/// 8 of 8 against 16 of 24: more successes, but also more runs.
TEST_F(PageSummary, LeadsByRateWhenCountsDiffer) {
  for (int k = 0; k < 8; ++k) {
    add({.method = "once", .scenario = k});
    for (int seed = 1; seed <= 3; ++seed) {
      add({.method = "thrice", .scenario = k, .success = seed != 2, .seed = seed});
    }
  }
  EXPECT_EQ(summary_of("thrice")["successes"], 16);
  EXPECT_EQ(summary_of("thrice")["runs"], 24);
  EXPECT_EQ(mark("once", "best_rate"), true);
  EXPECT_EQ(mark("thrice", "best_rate"), false);
}

/// The last seed of "c" succeeds, but not each; the last of "a" has the largest error, but not its median.
TEST_F(PageSummary, AveragesSeeds) {
  for (int k = 0; k < 8; ++k) {
    for (int seed = 1; seed <= 3; ++seed) {
      const double error_m = seed == 3 ? 9e-5 : 1e-5;
      add({.method = "a", .scenario = k, .seed = seed, .tip_error_m = error_m});
      add({.method = "b", .scenario = k, .seed = seed, .tip_error_m = 5e-5});
      add({.method = "c", .scenario = k, .success = seed != 2, .seed = seed});
    }
  }
  EXPECT_EQ(mark("a", "best_rate"), true);
  EXPECT_EQ(mark("b", "best_rate"), true);
  EXPECT_EQ(mark("c", "best_rate"), false);
  EXPECT_EQ(mark("a", "best_tip_error"), true);
  EXPECT_EQ(mark("b", "best_tip_error"), false);
}

TEST_F(PageSummary, MarksNobodyWithoutASuccess) {
  for (int k = 0; k < 8; ++k) {
    add({.method = "a", .scenario = k, .success = false});
    add({.method = "b", .scenario = k, .success = false});
  }
  EXPECT_TRUE(mark("a", "best_rate").is_null());
  EXPECT_TRUE(mark("b", "best_rate").is_null());
}

/// One success in 8 is no more than a tie with none, which is no merit of either.
TEST_F(PageSummary, MarksNoTieWithoutASuccess) {
  for (int k = 0; k < 8; ++k) {
    add({.method = "a", .scenario = k, .success = k == 0});
    add({.method = "b", .scenario = k, .success = false});
  }
  EXPECT_TRUE(mark("a", "best_rate").is_null());
  EXPECT_TRUE(mark("b", "best_rate").is_null());
}

/// Better in each of five pairs; repetitions are no further ones. The sixth scenario decides.
TEST_F(PageSummary, DecidesNothingOnFivePairs) {
  add_pairs(5);
  for (const char* which : kMarks) {
    EXPECT_TRUE(mark("a", which).is_null()) << which;
    EXPECT_TRUE(mark("b", which).is_null()) << which;
  }
  EXPECT_TRUE(mark("c", "best_rate").is_null());
}

TEST_F(PageSummary, DecidesOnSixPairs) {
  add_pairs(6);
  for (const char* which : kMarks) EXPECT_EQ(mark("a", which), true) << which;
  EXPECT_EQ(mark("b", "best_rate"), true);
  EXPECT_EQ(mark("b", "best_tip_error"), false);
  EXPECT_EQ(mark("b", "best_step"), false);
  EXPECT_EQ(mark("c", "best_rate"), false);
}

/// "d" ran elsewhere, so that nobody is known to be best, but "c" is worse than the leader all the same.
TEST_F(PageSummary, LeavesALeaderUndecidedIfAnyOtherIs) {
  add_pairs(6);
  for (int k = 0; k < 8; ++k) add({.method = "d", .scenario = 100 + k, .success = k > 0});
  EXPECT_TRUE(mark("a", "best_rate").is_null());
  EXPECT_TRUE(mark("b", "best_rate").is_null());
  EXPECT_EQ(mark("c", "best_rate"), false);
  EXPECT_TRUE(mark("d", "best_rate").is_null());
}

/// "a" has the higher rate for its easy runs alone; where both ran, "b" is better.
TEST_F(PageSummary, DoesNotCallWorseWhatIsBetterInPairs) {
  for (int k = 0; k < 40; ++k) add({.method = "a", .scenario = k, .success = k >= 8});
  for (int k = 0; k < 8; ++k) add({.method = "b", .scenario = k});
  for (int k = 100; k < 108; ++k) add({.method = "b", .scenario = k, .success = false});
  ASSERT_GT(summary_of("a")["rate"], summary_of("b")["rate"]);
  EXPECT_TRUE(mark("a", "best_rate").is_null());
  EXPECT_TRUE(mark("b", "best_rate").is_null());
}

/// One indicative time among those compared is enough.
TEST_F(PageSummary, DoesNotMarkIndicativeTimes) {
  add_pairs(6, "build type Debug");
  EXPECT_EQ(mark("a", "best_tip_error"), true);
  EXPECT_TRUE(mark("a", "best_step").is_null());
  EXPECT_TRUE(mark("b", "best_step").is_null());
}

TEST_F(PageSummary, MarksNobodyWhoIsAlone) {
  for (int k = 0; k < 8; ++k) add({.method = "a", .scenario = k});
  for (const char* which : kMarks) EXPECT_TRUE(mark("a", which).is_null()) << which;
}

}  // namespace
}  // namespace bqsa::harness::report
