#include "harness/results/summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <random>
#include <sstream>

#include "bqsa/method.hpp"
#include "harness/judge/judge.hpp"
#include "harness/results/text_table.hpp"
#include "harness/runner.hpp"

namespace bqsa::harness {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

TableRow success(const std::string& scenario, const std::string& variant) {
  TableRow row;
  row.scenario = scenario;
  row.variant = variant;
  row.build = "some build";
  row.success = true;
  row.claim = name_of(Claim::kSuccess);
  row.tip_error_at_ticks_m = 1e-6;
  row.tip_error_between_ticks_m = 2e-6;
  row.clearance_m = 0.01;
  row.max_joint_step_rad = 0.01;
  row.slowest_s = 1e-5;
  row.slowest_tick = 3;
  row.run_s = 0.5;
  return row;
}

TableRow failed(const std::string& scenario, const std::string& variant, Failure failure) {
  TableRow row = success(scenario, variant);
  row.success = false;
  row.claim = name_of(Claim::kNothing);
  row.failures = {name_of(failure)};
  return row;
}

TableRow gave_up(const std::string& scenario, const std::string& variant, Infeasible reason) {
  TableRow row = failed(scenario, variant, Failure::kIncomplete);
  row.claim = "gave up at tick 7";
  row.gave_up = name_of(reason);
  return row;
}

/// The words of the `which`-th line that begins with this name, the name left out.
std::vector<std::string> words_of(const std::string& text, const std::string& name, int which = 0) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string line; std::getline(in, line);) {
    std::istringstream cells(line);
    std::string word;
    if (!(cells >> word) || word != name || which-- > 0) continue;
    while (cells >> word) words.push_back(word);
    return words;
  }
  return {"no such line"};
}

TEST(Family, IsTheNameWithoutSeedAndNumber) {
  EXPECT_EQ(family_of("planar_s1_00042"), "planar");
  EXPECT_EQ(family_of("near_singular_s12_3"), "near_singular");
  EXPECT_EQ(family_of("planar_7r"), "planar_7r");
  EXPECT_EQ(family_of("scene_12"), "scene");
  EXPECT_EQ(family_of("scene12"), "scene");
  EXPECT_EQ(family_of("scene_x1_2"), "scene_x1");
  EXPECT_EQ(family_of("a_s1_b"), "a_s1_b");
  EXPECT_EQ(family_of("a_s_3"), "a_s");
  EXPECT_EQ(family_of("_s1_2"), "_s1");
  EXPECT_EQ(family_of("2016"), "2016");
  EXPECT_EQ(family_of("scene_"), "scene_");
  EXPECT_EQ(family_of(""), "");
}

TEST(FailureClass, IsTheVerdictOrElseTheReasonOfGivingUp) {
  EXPECT_EQ(failure_class(failed("a", "m", Failure::kCollision)), "collides");
  EXPECT_EQ(failure_class(gave_up("a", "m", Infeasible::kNoFreeMotion)), "no free motion");
  TableRow both = gave_up("a", "m", Infeasible::kNoFreeMotion);
  both.failures = {name_of(Failure::kDrift), name_of(Failure::kIncomplete)};
  EXPECT_EQ(failure_class(both), "drifts");
  TableRow crashed = failed("a", "m", Failure::kIncomplete);
  crashed.claim = "crashed at tick 3";
  EXPECT_EQ(failure_class(crashed), "crashed");
  crashed.claim = name_of(Claim::kUnsolved);
  EXPECT_EQ(failure_class(crashed), "no plan");
  crashed.claim = name_of(Claim::kSuccess);
  EXPECT_EQ(failure_class(crashed), "incomplete");
}

TEST(Summary, CountsByFamilyAndMethod) {
  TableRow none = success("planar_s1_1", "spatial_only");
  none.applicable = none.success = false;
  const std::string text = render_summary({
      success("planar_s1_1", "good"),
      success("planar_s1_2", "good"),
      gave_up("planar_s1_3", "good", Infeasible::kDiverged),
      failed("planar_s1_1", "bad", Failure::kCollision),
      success("planar_s1_2", "bad"),
      success("narrow_s1_1", "good"),
      none,
      gave_up("planar_s1_4", "good", Infeasible::kJointLimit),
  });
  EXPECT_THAT(text, HasSubstr("8 runs on 5 scenarios of 2 families"));
  // runs, n/a, successes, %, interval (3 words), failed, claims wrong
  EXPECT_THAT(words_of(text, "good"),
              ElementsAre("4", "0", "2", "50.0", "15.0", "to", "85.0", "2", "0"));
  EXPECT_THAT(words_of(text, "bad"),
              ElementsAre("2", "0", "1", "50.0", "9.5", "to", "90.5", "1", "0"));
  EXPECT_THAT(words_of(text, "spatial_only"), ElementsAre("0", "1", "0", "-", "-", "0", "0"));
  EXPECT_THAT(words_of(text, "good", 1),
              ElementsAre("1", "0", "1", "100.0", "20.7", "to", "100.0", "0", "0"));
  // failed; joint limit, diverged, collides; columns without any are left out
  EXPECT_THAT(words_of(text, "good", 2), ElementsAre("2", "1", "1", "0"));
  EXPECT_THAT(words_of(text, "bad", 1), ElementsAre("1", "0", "0", "1"));
  EXPECT_EQ(words_of(text, "spatial_only", 1).front(), "no such line");
  EXPECT_THAT(text, Not(HasSubstr("! ")));
}

/// The block of the summary that begins with this head, to its empty line; empty if there is none.
std::string block_of(const std::string& summary, const std::string& head) {
  const std::string blocks = summary.substr(0, summary.find("Success, decided"));
  const std::size_t begin = blocks.find('\n' + head);
  return begin == std::string::npos
             ? ""
             : blocks.substr(begin + 1, blocks.find("\n\n", begin + 1) - begin);
}

TableRow on_robot(TableRow row, const std::string& robot) {
  row.robot = robot;
  return row;
}

/// 300 random runs, counted again by plain loops over them.
TEST(Summary, TellsSuccessByRobot) {
  std::mt19937 random(3);
  const std::vector<std::string> robots = {"UR5e", "Franka", "iiwa"};
  std::vector<TableRow> rows;
  for (int i = 0; i < 300; ++i) {
    const std::string scenario =
        (random() % 2 == 0 ? "shelf_s1_" : "clutter_s1_") + std::to_string(i);
    const std::string method = random() % 3 == 0 ? "bqsa" : "qp";
    TableRow row = random() % 4 == 0 ? failed(scenario, method, Failure::kCollision)
                                     : success(scenario, method);
    row.applicable = random() % 10 != 0;
    rows.push_back(on_robot(row, robots[random() % 3]));
  }
  const std::string block = block_of(render_summary(rows), "by robot ");
  std::istringstream head(block);
  std::vector<std::string> shown;
  for (std::string word; shown.size() < 5 && head >> word;) shown.push_back(word);
  ASSERT_EQ(shown.size(), 5U) << block;
  shown.erase(shown.begin(), shown.begin() + 2);  // by, robot
  EXPECT_THAT(shown, testing::UnorderedElementsAreArray(robots));

  int cells = 0;
  for (const std::string family : {"shelf", "clutter"}) {
    const std::string of_family = block.substr(block.find('\n' + family + ' '));
    std::vector<std::string> counts = words_of(of_family, family);
    for (std::size_t r = 0; r < 3; ++r) {
      int least = 1000, most = 0;
      for (const std::string method : {"bqsa", "qp"}) {
        int runs = 0, successes = 0;
        for (const TableRow& row : rows) {
          const bool counts_here = row.applicable && row.scenario.starts_with(family + "_") &&
                                   row.variant == method && row.robot == shown[r];
          runs += counts_here ? 1 : 0;
          successes += counts_here && row.success ? 1 : 0;
        }
        least = std::min(least, runs);
        most = std::max(most, runs);
        char percent[16];
        std::snprintf(percent, sizeof percent, "%.1f", 100.0 * successes / runs);
        EXPECT_EQ(words_of(of_family, method).at(r), percent) << family << method << shown[r];
        ++cells;
      }
      EXPECT_THAT(counts, testing::IsSupersetOf({std::to_string(least), std::to_string(most)}));
    }
  }
  EXPECT_EQ(cells, 12);
}

TEST(Summary, ByRobotLeavesOutWhatHasNothingToCompare) {
  const auto block = [](const std::vector<TableRow>& rows) {
    return block_of(render_summary(rows), "by robot ");
  };
  const TableRow a = on_robot(success("shelf_s1_1", "bqsa"), "A");
  const TableRow b = on_robot(failed("shelf_s1_2", "bqsa", Failure::kDrift), "B");
  EXPECT_EQ(block({a, success("shelf_s1_2", "bqsa")}), "");  // one of them has no name
  EXPECT_EQ(block({a, on_robot(b, "A")}), "");               // one robot
  TableRow other = b;
  other.scenario = "clutter_s1_2";
  EXPECT_EQ(block({a, other}), "");  // one a family
  TableRow misfit = b;
  misfit.applicable = false;
  EXPECT_EQ(block({a, misfit}), "");
  EXPECT_EQ(block({a, b, on_robot(other, "C"), success("shelf_s1_3", "bqsa"),
                   on_robot(success("shelf_s1_3", "qp"), "B")}),
            "by robot      A      B\n"
            "[%]\n"
            "shelf     1 run  1 run\n"
            "  bqsa    100.0    0.0\n"
            "  qp          -  100.0\n");
}

TEST(Summary, ByRobotShortensNamesAndFitsItsWidth) {
  std::vector<TableRow> rows;
  const std::vector<std::string> robots = {"KUKA LBR iiwa 14",
                                           "Universal Robots UR10e",
                                           std::string(100, 'm'),
                                           "München-Schwabing-Freimann-Ärztehaus-Löwe",
                                           "Unimation PUMA 560, refitted for the laboratory",
                                           "Sixth",
                                           "Seventh"};
  for (std::size_t i = 0; i < 7 * 12345; i += 1 + i / 7) {
    const std::string method = i % 2 == 0 ? "bqsa" : "test_point@9735da8b+noise=0.001+seed=12345";
    rows.push_back(on_robot(success("a_family_s1_" + std::to_string(i), method), robots[i % 7]));
  }
  const std::string text = render_summary(rows);
  const std::string block = block_of(text, "by robot ");
  EXPECT_THAT(block, HasSubstr("  KUKA LBR iiwa 14  Universal Robots  "));
  EXPECT_THAT(block, HasSubstr("  mmmmmmm..mmmmmmm  "));
  EXPECT_THAT(block, HasSubstr("  Münche..s-Löwe  "));
  const std::string below = text.substr(text.find(block) + block.size());
  EXPECT_THAT(block_of(below, "by robot "), testing::ContainsRegex("  Sixth +Seventh\n"));
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    const auto columns = std::ranges::count_if(line, [](char c) { return (c & 0xc0) != 0x80; });
    EXPECT_LE(columns, 120) << line;
  }
}

TEST(Summary, EveryFailureHasAColumn) {
  std::vector<TableRow> rows;
  const auto named = [&rows] { return "a_" + std::to_string(rows.size()); };
  for (int i = 0; i <= static_cast<int>(Failure::kOrientation); ++i) {
    rows.push_back(failed(named(), "m", static_cast<Failure>(i)));
  }
  for (int i = 0; i <= static_cast<int>(Infeasible::kDiverged); ++i) {
    rows.push_back(gave_up(named(), "m", static_cast<Infeasible>(i)));
  }
  const std::vector<std::string> words = words_of(render_summary(rows), "m", 1);
  int sum = 0;
  for (std::size_t i = 1; i < words.size(); ++i) sum += std::stoi(words[i]);
  EXPECT_EQ(words.at(0), std::to_string(rows.size()));
  EXPECT_EQ(sum, static_cast<int>(rows.size()));
}

TEST(Summary, CountsWhyMethodsGaveUp) {
  std::vector<TableRow> rows;
  const auto add = [&rows](const std::string& family, const std::string& why, int count) {
    for (int i = 0; i < count; ++i) {
      rows.push_back(gave_up(family + "_s1_" + std::to_string(rows.size()), "m",
                             Infeasible::kNoFreeConfiguration));
      rows.back().claim_class = why;
    }
  };
  add("a", "no_room", 1);
  add("a", "late", 2);
  add("a", "singular", 3);
  add("a", "branch", 4);
  add("a", "missed", 5);
  add("b", "late", 1);
  rows.push_back(success("a_s1_100", "m"));
  rows.push_back(failed("a_s1_101", "m", Failure::kDrift));
  rows.push_back(gave_up("a_s1_102", "m", Infeasible::kNoFreeMotion));
  rows.back().claim_class = "branch";  // and drifted before
  rows.back().failures.insert(rows.back().failures.begin(), name_of(Failure::kDrift));
  // Of m on a: judged, failures, why; on b likewise.
  EXPECT_THAT(words_of(render_summary(rows), "m", 4), ElementsAre("16", "1", "2", "3", "5", "5"));
  EXPECT_THAT(words_of(render_summary(rows), "m", 5), ElementsAre("1", "0", "1", "0", "0", "0"));

  add("a", "", 1);
  add("a", "of a later version", 1);
  EXPECT_EQ(words_of(render_summary(rows), "m", 4).back(), "2") << "unknown";
  EXPECT_THAT(render_summary({gave_up("a_1", "m", Infeasible::kNoFreeMotion)}),
              Not(HasSubstr("no room")));
}

TEST(Summary, AWrongClaimIsLoud) {
  TableRow lie = failed("planar_1", "liar", Failure::kCollision);
  lie.claim_holds = false;
  const std::string text = render_summary({lie, success("planar_2", "liar")});
  EXPECT_THAT(text, HasSubstr("! CLAIM AND VERDICT DIFFER in 1 of 2 runs: liar on planar"));
  EXPECT_EQ(words_of(text, "liar").back(), "1");

  lie.disturbance = "joint angles read 1 tick late";
  const std::string misled = render_summary({lie});
  EXPECT_THAT(misled, Not(HasSubstr("DIFFER")));
  EXPECT_THAT(misled,
              HasSubstr("! claim and verdict differ in 1 of 1 runs: liar on planar, of what"));
  EXPECT_EQ(words_of(misled, "liar").back(), "1");

  lie.failures = {name_of(Failure::kDisagreement)};
  EXPECT_THAT(render_summary({lie}), Not(HasSubstr("! "))) << "no verdict to differ from";
}

TEST(Summary, FiguresAreTheWorstOfTheSuccessesAndTheirMedianError) {
  TableRow one = success("a_1", "m");
  TableRow two = success("a_2", "m");
  one.tip_error_at_ticks_m = 1e-4;
  two.tip_error_at_ticks_m = 3e-4;
  one.tip_error_between_ticks_m = 4e-4;
  two.clearance_m = 0.002;
  one.max_joint_step_rad = 0.1;
  for (int i = 0; i < 98; ++i) one.increments.add(4);
  for (int i = 0; i < 2; ++i) two.increments.add(20);
  one.increments_max = 4;
  two.increments_max = 20;
  TableRow worse = failed("a_3", "m", Failure::kDrift);
  worse.tip_error_at_ticks_m = worse.tip_error_between_ticks_m = worse.max_joint_step_rad = 1;
  worse.clearance_m = -1;
  EXPECT_THAT(words_of(render_summary({one, two, worse}), "m", 2),
              ElementsAre("0.2", "0.3", "0.4", "2", "5.73", "100", "4", "20", "20"));
}

/// A success and figures of its motion.
TableRow moving(const std::string& scenario, double size) {
  TableRow row = success(scenario, "m");
  row.motion = {.closed_path_drift = size,
                .closed_path_drift_joint = size / 2,
                .manipulability_min = 2 * size,
                .manipulability_mean = 3 * size,
                .singular_value_min = 4 * size,
                .null_space_share = size / 10,
                .jerk_rms = 100 * size};
  row.clamp_starts = 3;
  return row;
}

TEST(Summary, FiguresOfTheMotionAreMediansOfTheSuccessesThatHaveThem) {
  TableRow open = moving("a_4", 9);
  open.motion.closed_path_drift = TableRow::kNone;
  TableRow bad = moving("a_6", 1000);
  bad.success = false;
  bad.failures = {name_of(Failure::kDrift)};
  const std::string text = render_summary(
      {moving("a_1", 1), moving("a_2", 2), moving("a_3", 3), open, success("a_5", "m"), bad});
  const std::string block = text.substr(text.find("\nmotion "));
  EXPECT_THAT(words_of(block, "m"), ElementsAre("115", "5", "7.5", "10", "25", "250"));
}

TEST(Summary, OldRecordsHaveNoFiguresOfTheMotion) {
  const std::string text = render_summary({success("a_1", "m")});
  EXPECT_EQ(text.find("\nmotion     "), text.rfind("\nmotion ")) << "but for the legend";
}

TEST(Motions, AreListedByRun) {
  TableRow bad = moving("a_2", 3);
  bad.success = false;
  bad.failures = {name_of(Failure::kCollision)};
  TableRow none = success("a_3", "m");
  none.applicable = none.success = false;
  const std::string text = render_motions({moving("a_1", 2), bad, none, success("a_4", "m")});
  EXPECT_THAT(words_of(text, "a_1"),
              ElementsAre("m", "success", "115", "57.3", "4", "6", "8", "20", "200", "3"));
  EXPECT_THAT(words_of(text, "a_2"),
              ElementsAre("m", "collides", "172", "85.9", "6", "9", "12", "30", "300", "3"));
  EXPECT_EQ(words_of(text, "a_3").front(), "no such line");
  EXPECT_THAT(words_of(text, "a_4"),
              ElementsAre("m", "success", "-", "-", "-", "-", "-", "-", "-", "-"));
}

TEST(Summary, EachSeedOfAPlannerIsARunAndTimesOfPlansAreOfSuccesses) {
  std::vector<TableRow> rows;
  for (int seed = 1; seed <= 5; ++seed) {
    TableRow row = success("a_1", "planner");
    row.seed = std::to_string(seed);
    row.plan_s = 1e-3 * seed;
    rows.push_back(row);
  }
  rows.back().success = false;
  rows.back().failures = {name_of(Failure::kDrift)};
  rows.push_back(rows.front());  // a seed again counts once
  const std::string text = render_summary(rows);
  EXPECT_THAT(text, HasSubstr("5 runs on 1 scenarios"));
  const std::string plans = text.substr(text.find("\nplans "));
  EXPECT_THAT(words_of(plans, "planner"), ElementsAre("4", "2.5", "4", "4"));
}

TEST(Summary, QuantilesAreThoseOfAllTicksTogether) {
  // One run of many fast ticks and one of few slow ones: the median of the medians would be wrong.
  TableRow fast = success("a_1", "m");
  for (int i = 0; i < 990; ++i) fast.step_times.add(2000);  // [ns]
  TableRow slow = success("a_2", "m");
  for (int i = 0; i < 10; ++i) slow.step_times.add(800'000);
  slow.slowest_s = 9e-4;
  slow.slowest_tick = 44;
  TableRow slower = gave_up("a_3", "m", Infeasible::kNoFreeMotion);
  slower.slowest_s = 5e-3;
  slower.slowest_tick = 55;
  slower.against_times = {"assertions on"};
  const std::string text = render_summary({fast, slow, slower});
  const std::vector<std::string> words = words_of(text, "m", 3);
  ASSERT_EQ(words.size(), 9u) << text;
  EXPECT_EQ(words[0], "1000");
  EXPECT_NEAR(std::stod(words[1]), 2, 0.05);
  EXPECT_NEAR(std::stod(words[2]), 2, 0.05);
  EXPECT_NEAR(std::stod(words[3]), 800, 20);
  EXPECT_EQ(words[4], "900");
  EXPECT_THAT(std::vector<std::string>(words.begin() + 5, words.end()),
              ElementsAre("~5000", "a_3", "55", "1.5"));
  EXPECT_THAT(text, HasSubstr("~ times only indicative: assertions on"));
}

TEST(Summary, ComparesMethodsOnTheScenariosOfBoth) {
  std::vector<TableRow> rows;
  const auto add = [&rows](int number, bool a, bool b) {
    const std::string name = "p_s1_" + std::to_string(number);
    rows.push_back(a ? success(name, "A") : failed(name, "A", Failure::kDrift));
    rows.push_back(b ? success(name, "B") : failed(name, "B", Failure::kDrift));
  };
  int number = 0;
  for (int i = 0; i < 4; ++i) add(++number, true, true);
  for (int i = 0; i < 3; ++i) add(++number, true, false);
  for (int i = 0; i < 2; ++i) add(++number, false, true);
  add(++number, false, false);
  rows.push_back(success("p_s1_99", "A"));
  TableRow not_b = success("p_s1_99", "B");
  not_b.applicable = not_b.success = false;
  rows.push_back(not_b);
  EXPECT_THAT(words_of(render_summary(rows), "A,"), ElementsAre("B", "10", "4", "3", "2", "1"));
}

/// Two methods on three scenarios, three times each: A fails in the second repetition, B in all of the third
/// scenario.
std::vector<TableRow> repeated_runs() {
  std::vector<TableRow> rows;
  for (int scenario = 1; scenario <= 3; ++scenario) {
    for (int repetition = 1; repetition <= 3; ++repetition) {
      const std::string name = "p_s1_" + std::to_string(scenario);
      for (const char* method : {"A", "B"}) {
        const bool good = *method == 'A' ? repetition != 2 : scenario != 3;
        TableRow row = good ? success(name, method) : failed(name, method, Failure::kDrift);
        row.repetition = repetition;
        row.slowest_s = 1e-5 * (scenario == 2 && repetition == 3 ? 9 : repetition);
        rows.push_back(row);
      }
    }
  }
  return rows;
}

TEST(Summary, RepetitionsCountAndArePaired) {
  const std::string text = render_summary(repeated_runs());
  EXPECT_THAT(text, HasSubstr("18 runs on 3 scenarios"));
  // The interval is that of 2 successes in 3, from (p - 2/3)^2 = z^2 p (1 - p) / 3: three times as many
  // runs do not make it narrower.
  EXPECT_THAT(words_of(text, "A"), ElementsAre("9", "6", "66.7", "20.8", "to", "93.9", "3", "0"));
  EXPECT_THAT(words_of(text, "A,"), ElementsAre("B", "9", "4", "2", "2", "1"));
}

TEST(Summary, TheSlowestTickIsNamedWithItsRepetition) {
  const std::string text = render_summary(repeated_runs());
  const std::string times = text.substr(text.find("\ntime "));
  const std::vector<std::string> words = words_of(times, "A");
  ASSERT_GE(words.size(), 5u) << times;
  EXPECT_THAT(std::vector<std::string>(words.end() - 5, words.end()),
              ElementsAre("90", "p_s1_2", "3", "3", "4.5"));
  EXPECT_THAT(render_summary({success("a_1", "m")}), Not(HasSubstr("repe-")));
}

TEST(Summary, TheLastRunOfAFileAndVariantCounts) {
  TableRow old = failed("p_1", "m", Failure::kDrift);
  old.sha256 = "1";
  TableRow newer = success("p_1", "m");
  newer.sha256 = "1";
  EXPECT_THAT(words_of(render_summary({old, newer}), "m").at(1), "1");
  newer.sha256 = "2";
  const std::string text = render_summary({old, newer});
  EXPECT_EQ(words_of(text, "m").at(0), "2");
  EXPECT_THAT(text, HasSubstr("2 scenario files share 1 names"));
}

TEST(Summary, FitsItsWidth) {
  std::vector<TableRow> rows;
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    const std::string name =
        "near_singular_s" + std::to_string(random() % 3) + "_" + std::to_string(10000 + i);
    const std::string method = i % 2 == 0 ? "bqsa" : "test_point@9735da8b+noise=0.001+seed=12345";
    const int kind = static_cast<int>(random() % 20);
    if (kind < 9) {
      rows.push_back(failed(name, method, static_cast<Failure>(kind)));
    } else if (kind < 15) {
      rows.push_back(gave_up(name, method, static_cast<Infeasible>(kind - 9)));
      rows.back().claim_class = "singular";
    } else {
      rows.push_back(success(name, method));
      rows.back().slowest_s = 1.23;
      rows.back().step_times.add(1.23e9);
    }
  }
  int lines = 0;
  for (const std::string& text : {render_summary(rows), render_failures(rows)}) {
    std::istringstream in(text);
    for (std::string line; std::getline(in, line); ++lines) EXPECT_LE(line.size(), 120u) << line;
  }
  EXPECT_GT(lines, 1000);
}

TEST(Failures, AreListedWithTheirPlaces) {
  TableRow row = gave_up("p_1", "m", Infeasible::kJointLimit);
  row.failure_tick = 7;
  row.failure_link = 5;
  row.failure_obstacle = "post";
  TableRow drifted = failed("p_2", "m", Failure::kDrift);
  drifted.failure_tick = 9;
  const std::string text = render_failures({row, drifted, success("p_3", "m")});
  EXPECT_THAT(words_of(text, "p_1"), ElementsAre("m", "joint", "limit", "7", "5", "post"));
  EXPECT_THAT(words_of(text, "p_2"), ElementsAre("m", "drifts", "9", "-", "-"));
  EXPECT_THAT(text, Not(HasSubstr("p_3")));
  EXPECT_THAT(text, Not(HasSubstr("because")));
  row.claim_class = "singular";
  EXPECT_EQ(words_of(render_failures({row}), "p_1").back(), "singular");
  EXPECT_EQ(render_failures({success("p_3", "m")}), "no run failed\n");
  drifted.repetition = 12;
  EXPECT_THAT(words_of(render_failures({drifted}), "p_2"),
              ElementsAre("m", "12", "drifts", "9", "-", "-"));
}

TEST(TextTable, AlignsAndKeepsLongNamesApart) {
  TextTable table({{"name", "", true}, {"count", "[-]"}, {"none", "", false, true}});
  table.add_row({"a", "1", "0"});
  table.add_heading("group");
  table.add_row({std::string(119, 'x'), "1234567", ""});
  const auto spaces = [](std::size_t count) { return std::string(count, ' '); };
  EXPECT_EQ(table.text(), "name" + spaces(107) + "    count\n" +   //
                              spaces(111) + "      [-]\n" +        //
                              "a" + spaces(110) + "        1\n" +  //
                              "group\n" +                          //
                              std::string(119, 'x') + "\n" + spaces(111) + "  1234567\n");
}

TEST(Summary, OfNothingSaysSo) { EXPECT_EQ(render_summary({}), "no runs\n"); }

}  // namespace
}  // namespace bqsa::harness
