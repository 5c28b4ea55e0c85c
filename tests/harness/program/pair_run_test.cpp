#include "harness/results/pair_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>

#include "harness/methods.hpp"
#include "harness/results/table_row.hpp"
#include "harness/trajectory_csv.hpp"
#include "temporary_directory.hpp"
#include "test_methods.hpp"

namespace bqsa::harness {
namespace {

using Json = nlohmann::json;

/// Keys of every level, `judged.contacts[].link`; parameters and libraries, which vary, left out.
void collect_keys(const Json& value, const std::string& path, std::set<std::string>& keys) {
  if (value.is_array() && !value.empty()) {
    collect_keys(value.front(), path + "[]", keys);
  } else if (value.is_object() && path != "method.parameters" && path != "provenance.libraries") {
    for (const auto& [key, child] : value.items()) {
      collect_keys(child, path.empty() ? key : path + "." + key, keys);
    }
  } else {
    keys.insert(path);
  }
}

std::set<std::string> keys_of(const Json& record) {
  std::set<std::string> keys;
  collect_keys(record, "", keys);
  return keys;
}

std::set<std::string> with_prefix(const std::string& prefix, const std::string& names) {
  std::set<std::string> keys;
  std::istringstream in(names);
  for (std::string name; in >> name;) keys.insert(prefix + name);
  return keys;
}

/// All keys of a run in which a method cleared a pair and gave up, as documented.
std::set<std::string> documented_keys() {
  std::set<std::string> all = {"schema", "claim_holds", "trajectory"};
  const std::string error = "mean_m rms_m max_m max_x_m max_y_m max_z_m max_tick";
  all.merge(with_prefix("scenario.", "name file sha256"));
  all.merge(with_prefix("problem.",
                        "dimension joints links obstacles[] nk ticks dt_s tolerance_m margin_m "
                        "link_radius_m"));
  all.merge(with_prefix("method.", "name variant changed parameters"));
  all.merge(with_prefix("claimed.", "status tick reason link obstacle"));
  all.merge(with_prefix("judged.",
                        "success failures[] rows disagreement touching clearance_at_ticks_m "
                        "clearance_m start_error_m max_joint_step_rad max_joint_step_tick"));
  all.merge(with_prefix("judged.contacts[].", "link obstacle first_tick at_tick ticks"));
  all.merge(with_prefix("judged.tip_error_at_ticks.", error));
  all.merge(with_prefix("judged.tip_error_between_ticks.", error));
  all.merge(
      with_prefix("ticks.", "free clamped unclaimed increments_total increments_max guard_fired"));
  all.merge(with_prefix("ticks.clamped_pairs[].", "link obstacle ticks"));
  all.merge(with_prefix("counters.",
                        "quadratics point_pairs distance_queries kinematics jacobians "
                        "linear_solves iterations"));
  all.merge(with_prefix("times.",
                        "valid publishable against[] construct_s prepare_s plan_s first_step_s "
                        "warm_steps warm_median_s warm_p99_s warm_max_s warm_max_tick"));
  all.merge(with_prefix("provenance.",
                        "version commit dirty compiler build_type flags assertions sanitizers "
                        "libraries processor cores governor load_average os date seed "
                        "plan_budget_s command_line"));
  return all;
}

class PairRun : public ::testing::Test {
 protected:
  Json run(const MethodSpec& spec) {
    ResultStore store(directory_.path());
    return Json::parse(
        run_pair(scenario_, judge_, spec, {.settings = {}, .command_line = "test"}, store).record);
  }

  TemporaryDirectory directory_;
  const Scenario scenario_ = planar_scenario();
  const Judge judge_{scenario_.problem};
};

/// Turns joint 1 until link 7 is deep in an obstacle, then gives up.
void sweep_and_give_up(const StepInput& input, StepOutput& output) {
  constexpr double kStep = -0.05;  // towards the object [rad]
  output.q = input.q;
  output.q(0) += kStep;
  output.state = input.tick < 20 ? TickState::kClamped : TickState::kInfeasible;
  output.clamp_count = 1;
  output.clamps[0] = {.link = 7, .obstacle = 0, .increments = 3};
}

TEST_F(PairRun, RecordHasExactlyTheDocumentedKeys) {
  const Json record = run(scripted("sweep", sweep_and_give_up));
  EXPECT_FALSE(record["judged"]["contacts"].empty()) << "the sweep missed all obstacles";
  EXPECT_EQ(keys_of(record), documented_keys());
}

TEST_F(PairRun, EveryKeyOfARecordIsInTheDocument) {
  std::ifstream file(BQSA_SOURCE_DIR "/docs/results-format.md");
  std::stringstream document;
  document << file.rdbuf();
  ASSERT_FALSE(document.str().empty());
  for (const std::string& key : documented_keys()) {
    const std::string last = key.substr(key.find_last_of('.') + 1);
    const std::string name = last.substr(0, last.find('['));
    EXPECT_NE(document.str().find(name), std::string::npos) << key;
  }
}

TEST_F(PairRun, ALyingMethodIsShownAsClaimedSuccessAndJudgedFailure) {
  const Json record = run(scripted("lying", stand_still));
  EXPECT_EQ(record["claimed"]["status"], "success");
  EXPECT_EQ(record["judged"]["success"], false);
  EXPECT_EQ(record["claim_holds"], false);
}

TEST_F(PairRun, AMethodThatClaimsNothingIsNotCalledWrong) {
  const Json record = run(scripted("modest", [](const StepInput& input, StepOutput& output) {
    stand_still(input, output);
    output.state = TickState::kUnclaimed;
  }));
  EXPECT_EQ(record["claimed"]["status"], "nothing");
  EXPECT_EQ(record["judged"]["success"], false);
  EXPECT_EQ(record["claim_holds"], true);
}

TEST_F(PairRun, TimesOfAFailureAreNeitherValidNorShown) {
  const Json record = run(scripted("lying", stand_still));
  EXPECT_EQ(record["times"]["valid"], false);
  EXPECT_EQ(record["times"]["publishable"], false);
  EXPECT_GT(record["times"]["warm_median_s"], 0);
  const TableRow row = parse_run_record(record.dump());
  EXPECT_TRUE(std::isnan(row.step_median_s));
  EXPECT_TRUE(std::isnan(row.step_p99_s));
  EXPECT_TRUE(std::isnan(row.plan_s));
}

TEST_F(PairRun, ASuccessHasTimes) {
  const Json record = run(with_defaults(methods().at(1)));
  ASSERT_EQ(record["method"]["name"], "bqsa");
  ASSERT_EQ(record["judged"]["success"], true) << record["judged"]["failures"];
  EXPECT_EQ(record["claim_holds"], true);
  EXPECT_EQ(record["times"]["valid"], true);
  EXPECT_GT(parse_run_record(record.dump()).step_median_s, 0);
}

TEST_F(PairRun, AThrowingMethodIsRecordedAndTheNextRunGoesOn) {
  ResultStore store(directory_.path());
  const MethodSpec throwing =
      scripted("throwing", [](const auto&, auto&) { throw std::runtime_error("no \"way\"\nout"); });
  run_pair(scenario_, judge_, throwing, {}, store);
  run_pair(scenario_, judge_, scripted("lying", stand_still), {}, store);
  const std::vector<StoredLine> lines = read_lines(runs_file(directory_.path()));
  ASSERT_EQ(lines.size(), 2u);
  const Json first = Json::parse(lines[0].text);
  EXPECT_EQ(first["claimed"]["status"], "crashed");
  EXPECT_EQ(first["claimed"]["tick"], 1);
  EXPECT_EQ(first["claimed"]["message"], "no \"way\"\nout");
  EXPECT_EQ(first["judged"]["success"], false);
  EXPECT_EQ(parse_run_record(lines[0].text).claim_detail, "no \"way\" out");
  EXPECT_EQ(Json::parse(lines[1].text)["method"]["name"], "lying");
}

TEST_F(PairRun, AMethodThatAnswersNanIsJudgedNotFinite) {
  const Json record = run(scripted("nan", [](const StepInput& input, StepOutput& output) {
    stand_still(input, output);
    if (input.tick == 3) output.q.setConstant(std::numeric_limits<double>::quiet_NaN());
  }));
  EXPECT_EQ(record["claimed"]["status"], "crashed");
  EXPECT_THAT(record["judged"]["failures"].get<std::vector<std::string>>(),
              ::testing::Contains(name_of(Failure::kNotFinite)));
}

TEST_F(PairRun, APairThatDoesNotFitIsNotApplicableAndNotRun) {
  MethodSpec spatial = scripted("spatial", [](const auto&, auto&) { FAIL() << "was run"; });
  spatial.entry.capabilities.planar = false;
  const Json record = run(spatial);
  EXPECT_EQ(record["claimed"]["status"], "not applicable");
  EXPECT_FALSE(record["claimed"]["message"].get<std::string>().empty());
  EXPECT_TRUE(record["judged"].is_null());
  EXPECT_FALSE(parse_run_record(record.dump()).applicable);
}

TEST_F(PairRun, StoresTheTrajectoryThatWasJudged) {
  const Json record = run(scripted("sweep", sweep_and_give_up));
  EXPECT_EQ(record["trajectory"], "trajectories/planar_7r/sweep.csv");
  const Trajectory stored =
      read_trajectory(directory_.path() / record["trajectory"].get<std::string>(), 7);
  ASSERT_EQ(stored.q.size(), 20u);
  EXPECT_EQ(stored.q.front(), scenario_.problem.start);
  const Judgement again = judge_.judge(stored);
  EXPECT_EQ(again.contacts.size(), record["judged"]["contacts"].size());
  EXPECT_EQ(again.clearance, record["judged"]["clearance_m"].get<double>());
}

TEST_F(PairRun, AReplayedPlanIsJudgedLikeAnyOtherTrajectory) {
  const Json reactive = run(with_defaults(methods().at(1)));
  const Trajectory plan =
      read_trajectory(directory_.path() / reactive["trajectory"].get<std::string>(), 7);
  const Json replayed = run(planned("planner", {.solved = true, .trajectory = plan}));
  EXPECT_EQ(replayed["judged"], reactive["judged"]);
  EXPECT_GE(replayed["times"]["plan_s"], 0);
  EXPECT_TRUE(replayed["times"]["warm_median_s"].is_null());
}

TEST_F(PairRun, AResultIsNotLostWithItsTrajectory) {
  // A directory stands where the file should be.
  std::filesystem::create_directories(directory_.path() / "trajectories/planar_7r/still.csv");
  ResultStore store(directory_.path());
  const StoredRun stored = run_pair(scenario_, judge_, scripted("still", stand_still), {}, store);
  EXPECT_THAT(stored.trajectory_error, ::testing::HasSubstr("still.csv: expected a file"));
  const std::vector<StoredLine> lines = read_lines(runs_file(directory_.path()));
  ASSERT_EQ(lines.size(), 1u);
  const Json record = Json::parse(lines[0].text);
  EXPECT_TRUE(record["trajectory"].is_null());
  EXPECT_EQ(record["judged"]["success"], false);
}

TEST_F(PairRun, ATrajectoryWaitsForItsRecord) {
  run(scripted("still", stand_still));
  const std::filesystem::path file = directory_.path() / "trajectories/planar_7r/still.csv";
  ResultStore store(directory_.path());
  {
    const auto staged = store.stage_trajectory(store.trajectory_file("planar_7r", "still"), {});
    EXPECT_EQ(read_trajectory(file, 7).q.size(), 401u) << "replaced before the record";
  }
  const std::filesystem::directory_iterator files(file.parent_path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1) << "the temporary file is left over";
}

TEST_F(PairRun, ALineCutShortDoesNotSpoilTheNext) {
  run(scripted("one", stand_still));
  std::ofstream(runs_file(directory_.path()), std::ios::app) << R"({"schema":"bqsa-r)";
  run(scripted("two", stand_still));
  const std::vector<StoredLine> lines = read_lines(runs_file(directory_.path()));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(parse_run_record(lines[0].text).variant, "one");
  EXPECT_THROW(parse_run_record(lines[1].text), InputError);
  EXPECT_EQ(parse_run_record(lines[2].text).variant, "two");
  EXPECT_EQ(lines[2].number, 3);
}

/// What is said of a record that cannot be used; empty if it can.
std::string refusal_of(const Json& record) {
  try {
    parse_run_record(record.dump());
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST_F(PairRun, ARecordThatContradictsItselfAboutSuccessIsRefused) {
  const Json collided = run(scripted("sweep", sweep_and_give_up));
  EXPECT_EQ(refusal_of(collided), "");
  Json record = collided;
  record["judged"]["success"] = true;
  EXPECT_EQ(refusal_of(record), "not a run record: judged.success: contradicts judged.failures");
  record["judged"]["failures"] = Json::array();
  EXPECT_EQ(refusal_of(record), "not a run record: judged.contacts: contradict judged.success");
  record["judged"]["contacts"] = Json::array();
  EXPECT_EQ(refusal_of(record), "");
  record["judged"]["success"] = false;
  EXPECT_EQ(refusal_of(record), "not a run record: judged.success: contradicts judged.failures");
}

TEST_F(PairRun, ARecordIsRefusedWithTheKeyThatIsWrong) {
  const Json good = run(scripted("sweep", sweep_and_give_up));
  const auto with = [&good](const char* key, const Json& value) {
    Json record = good;
    record[Json::json_pointer(key)] = value;
    return refusal_of(record);
  };
  const std::string start = "not a run record: ";
  EXPECT_EQ(with("/schema", "other/1"), start + "schema: expected bqsa-run/1, got other/1");
  EXPECT_EQ(with("/problem", 7), start + "problem: expected an object");
  EXPECT_EQ(with("/problem/ticks", -1), start + "problem.ticks: expected a whole number");
  EXPECT_EQ(with("/problem/ticks", 1e300), start + "problem.ticks: expected a whole number");
  EXPECT_EQ(with("/judged/rows", 1L << 40), start + "judged.rows: expected a whole number");
  EXPECT_EQ(with("/judged/clearance_m", "near"), start + "judged.clearance_m: expected a number");
  EXPECT_EQ(with("/judged/failures/0", 1), start + "judged.failures[0]: expected a text");
  EXPECT_EQ(with("/judged/contacts", 1), start + "judged.contacts: expected a list");
  EXPECT_EQ(with("/claim_holds", 1), start + "claim_holds: expected true or false");
  Json without = good;
  without["method"].erase("variant");
  EXPECT_EQ(refusal_of(without), start + "method.variant: missing");
  EXPECT_EQ(refusal_of(Json::array()), start + "expected an object");
}

TEST_F(PairRun, TextsOfARecordCannotSteerATerminal) {
  Json record = run(scripted("sweep", sweep_and_give_up));
  record["method"]["variant"] =
      "a\033[2Jb\x7f"
      "c\u009bd\u00e9";
  EXPECT_EQ(parse_run_record(record.dump()).variant, "a [2Jb c d\u00e9");
}

TEST(ReasonsAgainstTimes, AreTheBuildAndTheLoad) {
  BuildInfo build;
  build.build_type = "Release";
  MachineState machine;
  machine.cores = 2;
  machine.load = 1.5;
  EXPECT_TRUE(reasons_against_times(build, machine).empty());
  machine.load = 2.5;
  EXPECT_EQ(reasons_against_times(build, machine).size(), 1u);
  build.build_type = "Debug";
  build.assertions = true;
  build.sanitizers = true;
  EXPECT_EQ(reasons_against_times(build, machine).size(), 4u);
}

}  // namespace
}  // namespace bqsa::harness
