#include "harness/results/pair_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>

#include "harness/methods.hpp"
#include "harness/results/table_row.hpp"
#include "harness/temporary_directory.hpp"
#include "harness/trajectory_csv.hpp"
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
  all.merge(with_prefix("scenario.", "name file sha256 reference_clearance_m"));
  all.merge(
      with_prefix("problem.",
                  "robot dimension joints links obstacles[] nk ticks dt_s tolerance_m margin_m "
                  "link_radius_m geometry"));
  all.merge(with_prefix("method.", "name variant changed seed parameters"));
  all.merge(with_prefix("claimed.", "status tick reason link obstacle class nearest_free_rad"));
  all.merge(with_prefix(
      "judged.",
      "success failures[] rows self_collision disagreement touching clearance_at_ticks_m "
      "clearance_m start_error_m max_joint_step_rad max_joint_step_tick"));
  all.merge(with_prefix("judged.contacts[].", "link obstacle first_tick at_tick ticks"));
  all.merge(with_prefix("judged.tip_error_at_ticks.", error));
  all.merge(with_prefix("judged.tip_error_between_ticks.", error));
  all.merge(with_prefix("ticks.",
                        "free clamped unclaimed clamp_starts increments_total increments_max "
                        "increments_tick_mean increments_tick_median increments_tick_p99 "
                        "increments_tick_max increments_tick_histogram[][] guard_fired"));
  all.merge(
      with_prefix("motion.",
                  "closed_path_drift_rad closed_path_drift_joint_rad manipulability_min "
                  "manipulability_mean singular_value_min_m null_space_share jerk_rms_rad_s3"));
  all.merge(with_prefix("disturbance.", "joint_noise_rad latency_ticks"));
  all.merge(with_prefix("ticks.clamped_pairs[].", "link obstacle ticks"));
  all.merge(with_prefix("counters.",
                        "quadratics bounds point_pairs distance_queries kinematics jacobians "
                        "linear_solves iterations"));
  all.merge(with_prefix(
      "times.",
      "valid publishable against[] includes_pipe construct_s prepare_s plan_s first_step_s "
      "warm_steps warm_median_s warm_p99_s warm_p999_s warm_max_s warm_max_tick "
      "warm_max_q_rad[] warm_histogram[][] run_s cpu_s hidden_cpu_s"));
  all.merge(with_prefix("provenance.",
                        "version commit dirty compiler build_type flags assertions sanitizers "
                        "libraries processor cores governor load_average os date seed "
                        "plan_budget_s isolated wall_limit_s memory_limit_bytes command_line "
                        "out_of_tree external host restarts jobs"));
  all.merge(with_prefix("campaign.", "name key repetition"));
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

/// Of a noisy run of a campaign, whose seed depends on the repetition.
Circumstances in_campaign(int repetition, char digit) {
  return {.settings = {.seed = 100u + static_cast<unsigned>(repetition),
                       .disturbance = {.joint_noise = 1e-3}},
          .command_line = "test",
          .jobs = 2,
          .place = CampaignPlace{"small", std::string(32, digit), repetition}};
}

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
  std::set<std::string> keys = documented_keys();
  for (const char* part : {"name", "key", "repetition"})
    keys.erase(std::string("campaign.") + part);
  keys.insert("campaign");
  EXPECT_EQ(keys_of(record), keys) << "of no campaign";
  EXPECT_TRUE(record["campaign"].is_null());

  Circumstances circumstances = in_campaign(1, 'a');
  ResultStore store(directory_.path());
  const StoredRun stored =
      run_pair(scenario_, judge_, scripted("sweep", sweep_and_give_up), circumstances, store);
  EXPECT_EQ(keys_of(Json::parse(stored.record)), documented_keys());
}

TEST_F(PairRun, TheOrientationIsRecordedOfTasksThatHaveOne) {
  const Scenario scenario = load_scenario(BQSA_SOURCE_DIR "/tests/harness/program/iiwa_pose.yaml");
  const Judge judge(scenario.problem);
  ResultStore store(directory_.path());
  const StoredRun stored = run_pair(scenario, judge, parse_method_spec("bqsa", methods()),
                                    {.settings = {}, .command_line = "test"}, store);
  const Json record = Json::parse(stored.record);
  EXPECT_EQ(record["problem"]["orientation"], "pose");
  EXPECT_EQ(record["problem"]["orientation_tolerance_rad"], 0.01);
  for (const char* where : {"orientation_at_ticks", "orientation_between_ticks"}) {
    const Json& error = record["judged"][where];
    EXPECT_LE(error["mean_rad"].get<double>(), error["max_rad"].get<double>()) << where;
    EXPECT_LT(error["max_rad"].get<double>(), 0.01) << where;
    EXPECT_GT(error["max_tick"].get<int>(), 0) << where;
  }
  const TableRow row = parse_run_record(stored.record);
  EXPECT_TRUE(row.success);
  EXPECT_EQ(row.orientation_at_ticks_rad,
            record["judged"]["orientation_at_ticks"]["max_rad"].get<double>());
  EXPECT_EQ(row.orientation_between_ticks_rad,
            record["judged"]["orientation_between_ticks"]["max_rad"].get<double>());
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

TEST_F(PairRun, OfSolidsRecordsWhatTheirEllipsoidsCost) {
  EXPECT_TRUE(run(scripted("sweep", sweep_and_give_up))["problem"]["geometry"].is_null());
  const Scenario shelf = load_scenario(BQSA_SOURCE_DIR "/scenarios/solids/ur5e_shelf.yaml");
  ResultStore store(directory_.path());
  const std::string text =
      run_pair(shelf, Judge(shelf.problem, shelf.truth), with_defaults(methods().at(0)), {}, store)
          .record;
  const Json record = Json::parse(text);
  const Json& geometry = record["problem"]["geometry"];
  ASSERT_EQ(geometry["solids"].size(), 6U);
  int ellipsoids = 0;
  double largest = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    const Json& solid = geometry["solids"][k];
    EXPECT_EQ(solid["name"], shelf.truth[k].name);
    EXPECT_EQ(solid["ellipsoids"], shelf.truth[k].count);
    EXPECT_EQ(solid["inflation_m"], shelf.geometry.solids[k].inflation);
    EXPECT_TRUE(solid["hull_over_mesh"].is_null());
    ellipsoids += solid["ellipsoids"].get<int>();
    largest = std::max(largest, solid["inflation_m"].get<double>());
  }
  EXPECT_EQ(geometry["gap_lost_m"], shelf.geometry.gap_lost);
  EXPECT_EQ(geometry["radius_excess_m"], shelf.geometry.radius_excess);
  EXPECT_EQ(static_cast<std::size_t>(ellipsoids), record["problem"]["obstacles"].size());
  EXPECT_EQ(parse_run_record(text).geometry,
            "6 solids in " + std::to_string(ellipsoids) + " ellipsoids, inflation up to " +
                length_text(largest) + ", gaps narrower by up to " +
                length_text(shelf.geometry.gap_lost) + ", link radius by up to " +
                length_text(shelf.geometry.radius_excess) + " more");
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

TEST_F(PairRun, FiguresOfTheMotionAreThoseOfTheRowsThatWereJudged) {
  const Json record = run(scripted("sweep", sweep_and_give_up));
  const Trajectory stored =
      read_trajectory(directory_.path() / record["trajectory"].get<std::string>(), 7);
  const MotionQuality motion = motion_quality(scenario_.problem, stored, 20);
  EXPECT_EQ(record["motion"]["jerk_rms_rad_s3"].get<double>(), motion.jerk_rms);
  EXPECT_TRUE(record["motion"]["closed_path_drift_rad"].is_null());
  const TableRow row = parse_run_record(record.dump());
  EXPECT_EQ(row.motion.jerk_rms, motion.jerk_rms);
  EXPECT_EQ(row.motion.manipulability_min, motion.manipulability_min);
  EXPECT_EQ(row.motion.manipulability_mean, motion.manipulability_mean);
  EXPECT_EQ(row.motion.singular_value_min, motion.singular_value_min);
  EXPECT_EQ(row.motion.null_space_share, motion.null_space_share);
  EXPECT_GT(row.clamp_starts, 0);
}

TEST_F(PairRun, ARecordTellsWhichLinksMeetEachOther) {
  EXPECT_TRUE(run(scripted("still", stand_still))["judged"]["self_collision"].is_null());
  Judgement judgement;
  judgement.failures = {Failure::kSelfCollision};
  judgement.rows = 20;
  judgement.self_contacts = {
      {.first = 2, .second = 5, .first_tick = 7, .at_tick = true, .ticks = 3}};
  judgement.self_clearance_at_ticks = -0.01;
  const Json record = Json::parse(run_record(scenario_, scripted("a", stand_still), {}, {},
                                             judgement, {}, machine_state(), {}, ""));
  EXPECT_EQ(record["judged"]["self_collision"].dump(),
            R"({"clearance_at_ticks_m":-0.01,"contacts":[{"at_tick":true,"first_tick":7,"link":2,)"
            R"("other_link":5,"ticks":3}]})");
  const TableRow row = parse_run_record(record.dump());
  EXPECT_THAT(row.collided, ::testing::ElementsAre("(2, link 5)"));
  EXPECT_EQ(row.failure_tick, 7);
  EXPECT_EQ(row.failure_link, 2);
  EXPECT_EQ(row.failure_obstacle, "link 5");
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
    const auto staged =
        stage_trajectory(directory_.path(), trajectory_file("planar_7r", "still"), {});
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
  record["claimed"]["status"] = "success";
  EXPECT_EQ(refusal_of(record), "");
  record["judged"]["success"] = false;
  EXPECT_EQ(refusal_of(record), "not a run record: judged.success: contradicts judged.failures");
}

TEST_F(PairRun, ARecordThatContradictsItselfAboutTheClaimIsRefused) {
  const char* contradiction =
      "not a run record: claim_holds: contradicts claimed.status and judged.success";
  Json lie = run(scripted("lying", stand_still));
  EXPECT_EQ(refusal_of(lie), "");
  lie["claim_holds"] = true;
  EXPECT_EQ(refusal_of(lie), contradiction);
  Json honest = run(scripted("sweep", sweep_and_give_up));
  EXPECT_EQ(refusal_of(honest), "");
  honest["claim_holds"] = false;
  EXPECT_EQ(refusal_of(honest), contradiction);
  honest["claim_holds"] = true;
  honest["claimed"]["status"] = "success";
  EXPECT_EQ(refusal_of(honest), contradiction);
  honest["claimed"]["status"] = "mostly";
  EXPECT_EQ(refusal_of(honest), "not a run record: claimed.status: expected a claim, got mostly");
}

TEST_F(PairRun, ADisturbedRunIsAVariantOfItsOwn) {
  ResultStore store(directory_.path());
  const MethodSpec spec = scripted("lying", stand_still);
  const Circumstances noisy{.settings = {.seed = 7, .disturbance = {.joint_noise = 1e-3}},
                            .command_line = "test"};
  const Json record = Json::parse(run_pair(scenario_, judge_, spec, noisy, store).record);
  EXPECT_EQ(record["method"]["variant"], "lying+noise=0.001+seed=7");
  EXPECT_EQ(record["trajectory"], "trajectories/planar_7r/lying+noise=0.001+seed=7.csv");
  EXPECT_EQ(record["disturbance"]["joint_noise_rad"], 1e-3);
  EXPECT_EQ(record["disturbance"]["latency_ticks"], 0);
  EXPECT_EQ(record["provenance"]["seed"], 7);
  const TableRow row = parse_run_record(record.dump());
  EXPECT_EQ(row.disturbance, "joint angles read with normal noise of 0.001 rad, seed 7");
  EXPECT_FALSE(row.claim_holds) << "a claim is a claim, whatever the method was told";

  const Circumstances late{.settings = {.disturbance = {.latency_ticks = 1}},
                           .command_line = "test"};
  const TableRow late_row = parse_run_record(run_pair(scenario_, judge_, spec, late, store).record);
  EXPECT_EQ(late_row.variant, "lying+latency");
  EXPECT_EQ(late_row.disturbance, "joint angles read 1 tick late");
  const TableRow plain = parse_run_record(run_pair(scenario_, judge_, spec, {}, store).record);
  EXPECT_EQ(plain.disturbance, "");
  EXPECT_EQ(last_runs({row, late_row, plain}).size(), 3u);
}

TEST_F(PairRun, OfACampaignRepetitionsStandApartAndSeedsAreNotNamed) {
  ResultStore store(directory_.path());
  const MethodSpec spec = scripted("lying", stand_still);
  const auto record_of = [&](int repetition, char digit) {
    return Json::parse(
        run_pair(scenario_, judge_, spec, in_campaign(repetition, digit), store).record);
  };
  const Json first = record_of(1, 'a');
  EXPECT_EQ(first["method"]["variant"], "lying+noise=0.001");
  EXPECT_EQ(first["trajectory"], "trajectories/planar_7r/lying+noise=0.001+aaaaaaaaaaaaaaaa.csv");
  EXPECT_EQ(first["campaign"]["name"], "small");
  EXPECT_EQ(first["campaign"]["key"], std::string(32, 'a'));
  EXPECT_EQ(first["campaign"]["repetition"], 1);
  EXPECT_EQ(first["provenance"]["seed"], 101);
  EXPECT_EQ(first["provenance"]["jobs"], 2);
  const TableRow row = parse_run_record(first.dump());
  EXPECT_EQ(row.key, std::string(32, 'a'));
  EXPECT_EQ(row.repetition, 1);
  EXPECT_EQ(row.disturbance,
            "joint angles read with normal noise of 0.001 rad, seed of scenario and repetition");

  const TableRow second = parse_run_record(record_of(2, 'b').dump());
  EXPECT_EQ(last_runs({row, second}).size(), 2u);
  const TableRow again = parse_run_record(record_of(2, 'c').dump());
  const std::vector<TableRow> last = last_runs({row, second, again});
  ASSERT_EQ(last.size(), 2u) << "of another program";
  EXPECT_EQ(last[1].key, std::string(32, 'c'));
}

TEST_F(PairRun, APlannerOfACampaignIsNamedByItsKeyNotItsSeed) {
  MethodSpec spec = planned("planner", {});
  Circumstances circumstances = in_campaign(3, 'd');
  circumstances.settings.disturbance = {};
  EXPECT_EQ(run_name(spec, circumstances), "planner+dddddddddddddddd");
  circumstances.place.reset();
  EXPECT_EQ(run_name(spec, circumstances), "planner+seed=103");
}

TEST_F(PairRun, ARecordSaysOnWhichHostAndHowOftenSlurmRestartedIt) {
  const auto restarts = [this] {
    return run(scripted("lying", stand_still))["provenance"]["restarts"];
  };
  EXPECT_EQ(restarts(), 0);
  setenv("SLURM_RESTART_COUNT", "3", 1);
  EXPECT_EQ(restarts(), 3);
  setenv("SLURM_RESTART_COUNT", "many", 1);
  EXPECT_EQ(restarts(), 0);
  unsetenv("SLURM_RESTART_COUNT");
  std::string host;
  std::ifstream("/proc/sys/kernel/hostname") >> host;
  EXPECT_EQ(run(scripted("lying", stand_still))["provenance"]["host"], host);
}

TEST_F(PairRun, APlannerIsNotRunWithDisturbances) {
  ResultStore store(directory_.path());
  const Circumstances late{.settings = {.disturbance = {.latency_ticks = 1}},
                           .command_line = "test"};
  const MethodSpec planner = planned("planner", {.solved = true, .trajectory = {}});
  const Json record = Json::parse(run_pair(scenario_, judge_, planner, late, store).record);
  EXPECT_EQ(record["claimed"]["status"], "not applicable");
  EXPECT_THAT(record["claimed"]["message"].get<std::string>(), ::testing::HasSubstr("plans"));
  EXPECT_EQ(run(planner)["claimed"]["status"], "success");
}

TEST_F(PairRun, WithoutTrajectoriesOlderOnesStay) {
  run(scripted("still", stand_still));
  const std::filesystem::path file = directory_.path() / "trajectories/planar_7r/still.csv";
  const auto written = std::filesystem::last_write_time(file);
  ResultStore store(directory_.path());
  const Circumstances bare{
      .settings = {}, .command_line = "test", .trajectories = KeptTrajectories::kNone};
  for (const char* name : {"still", "other"}) {
    const StoredRun stored = run_pair(scenario_, judge_, scripted(name, stand_still), bare, store);
    EXPECT_TRUE(Json::parse(stored.record)["trajectory"].is_null());
    EXPECT_EQ(stored.trajectory_error, "");
  }
  EXPECT_EQ(std::filesystem::last_write_time(file), written);
  EXPECT_FALSE(std::filesystem::exists(file.parent_path() / "other.csv"));
}

TEST_F(PairRun, ATrajectoryIsNotReplacedWhenItsRecordCannotBeWritten) {
  const auto sweep_for = [](int ticks) {
    return scripted("sweep", [ticks](const StepInput& input, StepOutput& output) {
      stand_still(input, output);
      if (input.tick > ticks) output.state = TickState::kInfeasible;
    });
  };
  run(sweep_for(5));
  const std::filesystem::path file = directory_.path() / "trajectories/planar_7r/sweep.csv";
  ASSERT_EQ(read_trajectory(file, 7).q.size(), 6u);
  ResultStore store(directory_.path());

  // Files may not grow beyond what the records have already: the short trajectory still fits.
  rlimit unlimited{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &unlimited), 0);
  const auto size = std::filesystem::file_size(runs_file(directory_.path()));
  ASSERT_LT(2 * std::filesystem::file_size(file), size);
  const rlimit limited{size, unlimited.rlim_max};
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limited), 0);
  EXPECT_THROW(run_pair(scenario_, judge_, sweep_for(2), {}, store), InputError);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &unlimited), 0);
  std::signal(SIGXFSZ, old_handler);

  EXPECT_EQ(read_lines(runs_file(directory_.path())).size(), 1u);
  EXPECT_EQ(read_trajectory(file, 7).q.size(), 6u) << "replaced without a record";
}

TEST_F(PairRun, ARecordTellsTheSlowestTickAndTheFailure) {
  const Json record = run(scripted("sweep", sweep_and_give_up));
  const TableRow row = parse_run_record(record.dump());
  EXPECT_EQ(row.slowest_tick, record["times"]["warm_max_tick"].get<int>());
  EXPECT_EQ(row.slowest_q, record["times"]["warm_max_q_rad"].get<std::vector<double>>());
  EXPECT_EQ(row.slowest_q.size(), 7u);
  EXPECT_GT(row.slowest_s, 0);
  EXPECT_EQ(row.step_times.total(), 0) << "times of a failure";
  const Json contact = record["judged"]["contacts"][0];
  EXPECT_EQ(row.failure_tick, contact["first_tick"].get<int>());
  EXPECT_EQ(row.failure_link, contact["link"].get<int>());
  EXPECT_EQ(row.failure_obstacle, contact["obstacle"].get<std::string>());
}

TEST_F(PairRun, GivingUpIsDiagnosedWhereTheArmWas) {
  constexpr int kTick = 20;  // of sweep_and_give_up
  const Json record = run(scripted("sweep", sweep_and_give_up));
  const Trajectory trajectory =
      read_trajectory(directory_.path() / record["trajectory"].get<std::string>(), 7);
  ASSERT_EQ(trajectory.q.size(), static_cast<std::size_t>(kTick));
  const Diagnosis expected =
      diagnose(scenario_.problem, kTick, Infeasible::kNot, trajectory.q.back());
  ASSERT_NE(expected.failure,
            diagnose(scenario_.problem, kTick, Infeasible::kNot, trajectory.q.front()).failure);
  EXPECT_EQ(record["claimed"]["class"], name_of(expected.failure));
  EXPECT_EQ(parse_run_record(record.dump()).claim_class, name_of(expected.failure));

  // Standing still is missed at once, and later too far from the path.
  const auto class_when_idle_until = [this](int tick) {
    return run(scripted("idle", [tick](const StepInput& input, StepOutput& output) {
      stand_still(input, output);
      if (input.tick == tick) output.state = TickState::kInfeasible;
    }))["claimed"]["class"];
  };
  EXPECT_EQ(class_when_idle_until(1), "missed");
  EXPECT_NE(class_when_idle_until(200), "missed");

  const Json diverged = run(scripted("diverged", [](const StepInput&, StepOutput& output) {
    output.state = TickState::kInfeasible;
    output.reason = Infeasible::kDiverged;
  }));
  EXPECT_EQ(diverged["claimed"]["class"], "singular");
  EXPECT_TRUE(diverged["claimed"]["nearest_free_rad"].is_null());
  EXPECT_FALSE(run(scripted("lying", stand_still))["claimed"].contains("class"));
}

TEST_F(PairRun, OfTheWrongBranchTheNearestFreePostureIsRecorded) {
  const Scenario& scenario = scenario_;
  const RunOutcome outcome = [] {
    RunOutcome gave_up;
    gave_up.claim = Claim::kInfeasible;
    gave_up.tick = 1;
    return gave_up;
  }();
  const Judgement judgement = judge_.judge({{0}, {scenario.problem.start}});
  const auto recorded = [&](const std::optional<Diagnosis>& diagnosis) {
    return Json::parse(run_record(scenario, scripted("m", stand_still), outcome, diagnosis,
                                  judgement, {}, machine_state(), {}, ""))["claimed"];
  };
  EXPECT_EQ(recorded(Diagnosis{FailureClass::kBranch, 0.75})["class"], "branch");
  EXPECT_EQ(recorded(Diagnosis{FailureClass::kBranch, 0.75})["nearest_free_rad"], 0.75);
  EXPECT_TRUE(recorded(Diagnosis{FailureClass::kLate})["nearest_free_rad"].is_null());
}

TEST_F(PairRun, ASuccessHasHistogramsOfItsTicks) {
  const TableRow row = parse_run_record(run(with_defaults(methods().at(1))).dump());
  ASSERT_TRUE(row.success);
  EXPECT_EQ(row.step_times.total(), scenario_.problem.ticks - 1);
  const double median = row.step_times.quantile(0.5) * RunTimes::kHistogramUnit;
  EXPECT_NEAR(median / row.step_median_s, 1, 0.023);
  EXPECT_GT(row.increments.total(), 0);
  EXPECT_GT(row.increments_max, 0);
}

TEST_F(PairRun, ARecordSaysWhichRobotItIs) {
  const MethodSpec none = with_defaults(methods().front());
  const Json nameless = run(none);
  EXPECT_TRUE(nameless["problem"]["robot"].is_null());
  const TableRow without = parse_run_record(nameless.dump());
  EXPECT_EQ(without.robot, "");
  EXPECT_TRUE(without.problem.starts_with("7 joints, ")) << without.problem;

  Scenario named = planar_scenario();
  named.robot_name = "Müller's arm";
  ResultStore store(directory_.path());
  const Json record = Json::parse(
      run_pair(named, judge_, none, {.settings = {}, .command_line = "test"}, store).record);
  EXPECT_EQ(record["problem"]["robot"], "Müller's arm");
  const TableRow row = parse_run_record(record.dump());
  EXPECT_EQ(row.robot, "Müller's arm");
  EXPECT_TRUE(row.problem.starts_with("Müller's arm, 7 joints, ")) << row.problem;
}

TEST(RunRecord, OldRecordsCanStillBeRead) {
  int read = 0;
  for (const StoredLine& line :
       read_lines(BQSA_SOURCE_DIR "/tests/harness/program/old_runs.jsonl")) {
    const TableRow row = parse_run_record(line.text);
    EXPECT_EQ(row.disturbance, "");
    EXPECT_EQ(row.robot, "");
    EXPECT_TRUE(row.slowest_q.empty());
    EXPECT_EQ(row.key, "");
    EXPECT_EQ(row.repetition, 0);
    ++read;
  }
  EXPECT_EQ(read, 2);
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
  EXPECT_EQ(with("/problem/robot", 7), start + "problem.robot: expected a text");
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
