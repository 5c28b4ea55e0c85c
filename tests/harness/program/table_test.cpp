#include "harness/results/table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <sstream>

#include "harness/judge/judge.hpp"

namespace bqsa::harness {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TableRow success(const std::string& scenario, const std::string& variant) {
  TableRow row;
  row.scenario = scenario;
  row.problem = "7 joints";
  row.variant = variant;
  row.build = "some build";
  row.ticks = 400;
  row.rows = 401;
  row.success = true;
  row.claim = "success";
  row.tip_error_at_ticks_m = 1.234e-6;
  row.tip_error_between_ticks_m = 2e-5;
  row.clearance_m = 0.0123;
  row.max_joint_step_rad = 0.02;
  row.step_median_s = 4.5e-6;
  row.step_p99_s = 6.5e-5;
  return row;
}

TableRow failure(const std::string& variant, std::vector<Failure> failures) {
  TableRow row = success("a", variant);
  row.success = false;
  row.claim_holds = false;
  for (const Failure failure : failures) row.failures.push_back(name_of(failure));
  row.step_median_s = row.step_p99_s = TableRow::kNone;
  return row;
}

/// The line of the table that shows the row of this variant.
std::string line_of(const std::string& table, const std::string& variant) {
  std::istringstream in(table);
  for (std::string line; std::getline(in, line);) {
    if (line.size() > 4 && line.compare(4, variant.size() + 1, variant + " ") == 0) return line;
  }
  return "no row of " + variant;
}

TEST(Table, ShowsHowFarATipIsTurnedAwayOfTasksWithAnOrientation) {
  TableRow row = success("a", "good");
  EXPECT_EQ(render_table({row}).find("turned away"), std::string::npos);
  row.orientation_at_ticks_rad = std::numbers::pi / 180;
  row.orientation_between_ticks_rad = std::numbers::pi / 90;
  EXPECT_NE(render_table({row}).find("tip turned away [deg]: 1 at ticks | 2 between\n"),
            std::string::npos);
  EXPECT_EQ(verdict_of("orientation"), "tilts");
}

TEST(Table, ShowsASuccessWithItsFiguresInMillimetresDegreesAndMicroseconds) {
  const std::string line = line_of(render_table({success("a", "good")}), "good");
  EXPECT_THAT(line,
              ::testing::MatchesRegex(
                  R"(\+   good +success +0\.00123 \| +0\.02 +12\.3 +1\.15 +4\.5 +65 +success)"));
}

TEST(Table, SaysWhatTheGeometryCostsOnceAScenario) {
  TableRow row = success("a", "good");
  EXPECT_THAT(render_table({row}), Not(HasSubstr("geometry")));
  row.geometry = "2 solids in 5 ellipsoids";
  TableRow other = row;
  other.variant = "better";
  const std::string table = render_table({row, other});
  EXPECT_THAT(table, HasSubstr("\n    geometry: 2 solids in 5 ellipsoids\n"));
  EXPECT_EQ(table.find("geometry:"), table.rfind("geometry:"));
}

TEST(Table, SaysThatAMethodLies) {
  const std::string table = render_table({failure("liar", {Failure::kCollision})});
  EXPECT_THAT(line_of(table, "liar"), ::testing::StartsWith("!   liar"));
  EXPECT_THAT(line_of(table, "liar"), HasSubstr("collides"));
  EXPECT_THAT(table, HasSubstr("CLAIMED SUCCESS, JUDGED A FAILURE"));
}

TEST(Table, NeverShowsTheTimeOfAFailure) {
  const std::string failing = line_of(render_table({failure("bad", {Failure::kDrift})}), "bad");
  EXPECT_THAT(failing, Not(HasSubstr("4.5")));
  EXPECT_THAT(failing, Not(HasSubstr("65")));
  EXPECT_THAT(failing, HasSubstr("drifts"));
}

TEST(Table, NamesEveryFailureTheWorstFirst) {
  const std::string table =
      render_table({failure("bad", {Failure::kCollision, Failure::kJump, Failure::kDrift})});
  EXPECT_THAT(line_of(table, "bad"), HasSubstr("collides"));
  EXPECT_THAT(table, HasSubstr("also: jumps, drifts"));
}

TEST(Table, SaysWhereAnHonestMethodGaveUp) {
  TableRow row = failure("honest", {Failure::kIncomplete});
  row.claim = "gave up at tick 23";
  row.claim_detail = "no free motion, link 6, obstacle";
  row.claim_holds = true;
  row.rows = 23;
  const std::string table = render_table({row});
  EXPECT_THAT(line_of(table, "honest"), ::testing::StartsWith("x   honest  incomplete "));
  EXPECT_THAT(table, HasSubstr("reason: no free motion, link 6, obstacle"));
  EXPECT_THAT(table, HasSubstr("figures cover the first 22 of 400 ticks"));
  EXPECT_THAT(table, Not(HasSubstr("JUDGED A FAILURE")));
}

TEST(Table, CountsAsManyTicksAsARecordCanHold) {
  TableRow row = failure("slow", {Failure::kIncomplete});
  row.ticks = std::numeric_limits<int>::max();
  EXPECT_THAT(render_table({row}), HasSubstr("figures cover the first 400 of 2147483647 ticks"));
}

TEST(Table, CallsARunIncompleteIfItsMethodClaimsItIsNot) {
  const std::string table = render_table({failure("short", {Failure::kIncomplete})});
  EXPECT_THAT(line_of(table, "short"), HasSubstr("incomplete"));
}

TEST(Table, ListsPairsBelowTheRow) {
  TableRow row = failure("bad", {Failure::kCollision});
  row.collided = {"(5, obstacle)", "(7, object)"};
  row.clamped = {"(6, obstacle) x 12"};
  row.guard_fired = 2;
  row.changed = "gain=3";
  const std::string table = render_table({row});
  EXPECT_THAT(table, HasSubstr("collided: (5, obstacle), (7, object)\n"));
  EXPECT_THAT(table, HasSubstr("moved away: (6, obstacle) x 12\n"));
  EXPECT_THAT(table, HasSubstr("guard fired in 2 of 400 ticks\n"));
  EXPECT_THAT(table, HasSubstr("with gain=3\n"));
}

TEST(Table, FlagsTouchingAndIndicativeTimes) {
  TableRow row = success("a", "good");
  row.touching = true;
  row.against_times = {"assertions on"};
  const std::string table = render_table({row});
  EXPECT_THAT(line_of(table, "good"), HasSubstr("12.3 T"));
  EXPECT_THAT(line_of(table, "good"), HasSubstr("~"));
  EXPECT_THAT(table, HasSubstr("~ times only indicative: assertions on"));
}

TEST(Table, CallsADisagreementOfTheJudgesNoVerdict) {
  TableRow row = failure("unlucky", {Failure::kDisagreement});
  row.disagreement = "tick 3";
  const std::string table = render_table({row});
  EXPECT_THAT(line_of(table, "unlucky"), ::testing::StartsWith("?   unlucky  no verdict"));
  EXPECT_THAT(table, HasSubstr("the judge's checkers disagree: tick 3"));
  EXPECT_THAT(table, Not(HasSubstr("CLAIMED SUCCESS")));
}

TEST(Table, PrintsAClearanceOfContactAsZero) {
  TableRow row = success("a", "good");
  row.touching = true;
  row.clearance_m = -4e-7;
  EXPECT_THAT(line_of(render_table({row}), "good"), HasSubstr(" 0 T "));
}

TEST(Table, LongLengthsAreInMetres) {
  EXPECT_EQ(length_text(9.5), "9500 mm");
  EXPECT_EQ(length_text(12.5), "12.5 m");
}

TEST(Table, TheLegendExplainsEveryVerdict) {
  const std::string table = render_table({success("a", "good")});
  for (int i = 0; i <= static_cast<int>(Failure::kOrientation); ++i) {
    EXPECT_THAT(table, HasSubstr(verdict_of(name_of(static_cast<Failure>(i)))));
  }
}

TEST(Table, ShowsNotApplicableWithItsReason) {
  TableRow row = success("a", "planar_only");
  row.applicable = false;
  row.success = false;
  row.claim = "not applicable";
  row.claim_detail = "spatial problems not supported yet";
  const std::string table = render_table({row});
  EXPECT_THAT(line_of(table, "planar_only"), ::testing::StartsWith("-   planar_only  n/a"));
  EXPECT_THAT(table, HasSubstr("spatial problems not supported yet"));
}

TEST(Table, TheLastRunCountsAtThePlaceOfTheFirst) {
  TableRow newer = success("a", "one");
  newer.tip_error_at_ticks_m = 0.5e-3;
  const std::string table =
      render_table({success("a", "one"), success("b", "one"), success("a", "two"), newer});
  EXPECT_THAT(line_of(table, "one"), HasSubstr(" 0.5 "));
  EXPECT_LT(table.find("a: 7 joints"), table.find("b: 7 joints"));
  EXPECT_EQ(table.find("a: 7 joints"), table.rfind("a: 7 joints"));
  EXPECT_LT(table.find(" one "), table.find(" two "));
}

TEST(Table, RepetitionsHaveRowsOfTheirOwn) {
  TableRow first = success("a", "one");
  first.repetition = 1;
  TableRow second = failure("one", {Failure::kDrift});
  second.repetition = 2;
  const std::string table = render_table({first, second});
  EXPECT_THAT(table, HasSubstr("+   one"));
  EXPECT_THAT(table, HasSubstr("!   one"));
  EXPECT_THAT(table, HasSubstr("repetition 2\n"));
  EXPECT_THAT(table, Not(HasSubstr("repetition 1\n")));
}

TEST(Table, RunsOfAChangedScenarioFileStandApart) {
  TableRow old = success("a", "one");
  old.sha256 = "0123456789abcdef";
  TableRow changed = success("a", "one");
  changed.sha256 = "fedcba9876543210";
  changed.problem = "6 joints";
  const std::string table = render_table({old, changed, success("b", "one")});
  EXPECT_THAT(table, HasSubstr("a (one of several files of this name, sha256 01234567): 7 joints"));
  EXPECT_THAT(table, HasSubstr("a (one of several files of this name, sha256 fedcba98): 6 joints"));
  EXPECT_THAT(table, HasSubstr("\nb: 7 joints"));
}

TEST(Table, FitsItsWidthWithManyPairs) {
  TableRow row = failure("test_point@1a2b3c4d", {Failure::kCollision});
  for (int i = 1; i <= 60; ++i) row.collided.push_back(std::to_string(i) + " obstacle");
  row.claim = "gave up at tick 100000";
  std::istringstream in(render_table({row}));
  int lines = 0;
  for (std::string line; std::getline(in, line); ++lines) EXPECT_LE(line.size(), 120u) << line;
  EXPECT_GT(lines, 20);
}

TEST(Table, FitsItsWidthWithLongVariants) {
  const std::string variant = "test_point@1a2b3c4d+noise=0.0001+seed=18446744073709551615+latency";
  TableRow row = failure(variant, {Failure::kJointLimit});
  row.claim = "gave up at tick 100000";
  std::istringstream in(render_table({row, success("a", "good")}));
  bool found = false;
  for (std::string line; std::getline(in, line);) {
    EXPECT_LE(line.size(), 120u) << line;
    if (line != "!   " + variant) continue;
    found = true;
    ASSERT_TRUE(std::getline(in, line));
    EXPECT_THAT(line, ::testing::MatchesRegex(" +breaks joint limits .*gave up at tick 100000"));
  }
  EXPECT_TRUE(found);
}

TEST(Table, SaysWhatDisturbedARunAndThatItsClaimFails) {
  TableRow row = failure("misled", {Failure::kCollision});
  row.disturbance = "joint angles read 1 tick late";
  const std::string table = render_table({row});
  EXPECT_THAT(line_of(table, "misled"), ::testing::StartsWith("!   misled"));
  EXPECT_THAT(line_of(table, "misled"), ::testing::EndsWith(" success"));
  EXPECT_THAT(table, HasSubstr("CLAIMED SUCCESS, JUDGED A FAILURE\n"));
  EXPECT_THAT(table, HasSubstr("(of what the disturbed sensors told it)\n"));
  EXPECT_THAT(table, HasSubstr("disturbed: joint angles read 1 tick late\n"));
}

TEST(Table, TimesOfFailuresNeedNoExcuse) {
  TableRow row = failure("bad", {Failure::kDrift});
  row.against_times = {"assertions on"};
  EXPECT_THAT(render_table({row}), Not(HasSubstr("only indicative")));
}

TEST(Table, SaysWhatSuccessMeansAndWhatMadeIt) {
  const std::string table = render_table({success("a", "good")});
  EXPECT_THAT(table, HasSubstr("no link in an\nobstacle at or between ticks"));
  EXPECT_THAT(table, HasSubstr("made by some build"));
}

TEST(Table, OfNothingSaysSo) { EXPECT_EQ(render_table({}), "no runs\n"); }

}  // namespace
}  // namespace bqsa::harness
