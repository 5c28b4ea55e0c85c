// Columns, words and numbers of the exchange formats, against what SQLite and Python say of them. Whole files are
// tested in Python, next to this.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <limits>
#include <set>

#include "harness/exchange/arena_experiment.hpp"
#include "harness/exchange/exported_runs.hpp"
#include "harness/exchange/ompl_log.hpp"
#include "harness/exchange/run_columns.hpp"
#include "harness/exchange/sqlite_database.hpp"
#include "harness/results/record_files.hpp"
#include "harness/results/result_store.hpp"
#include "harness/temporary_directory.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A scenario that has every property.
ExportedExperiment full_experiment() {
  ExportedScenario scenario;
  scenario.link_radii_m = {0.25, 0.125};
  scenario.robot = "PUMA 560";
  scenario.orientation = "axis";
  scenario.orientation_tolerance_rad = 0.5;
  scenario.reference_clearance_m = 0;
  return {.scenario = scenario, .configurations = {}};
}

/// All names that become columns of a database.
std::vector<std::string> column_names() {
  std::vector<std::string> names;
  for (const RunColumn& column : run_columns()) names.emplace_back(column.name);
  for (const char* name : Origin::columns()) names.emplace_back(name);
  for (const ExperimentProperty& property : arena_experiment(full_experiment(), {}).properties) {
    names.emplace_back(property.name);
  }
  return names;
}

TEST(Columns, AreWordsThatSqlDoesNotKnow) {
  const std::vector<std::string> names = column_names();
  EXPECT_GT(names.size(), 90U);
  for (const std::string& name : names) {
    EXPECT_TRUE(std::all_of(name.begin(), name.end(), [](char c) {
      return std::islower(c) || std::isdigit(c) || c == '_';
    })) << name;
    EXPECT_EQ(sqlite3_keyword_check(name.c_str(), static_cast<int>(name.size())), 0) << name;
  }
}

TEST(Columns, AreDistinctInEachTable) {
  std::set<std::string> names{"id", "experimentid", "plannerid"};
  for (const RunColumn& column : run_columns()) {
    EXPECT_TRUE(names.insert(column.name).second) << column.name;
  }
}

/// Columns are added to a table, and read from logs, in this order.
TEST(Columns, OfExperimentsAreInTheOrderOfTheirNames) {
  const auto properties = arena_experiment(full_experiment(), {}).properties;
  EXPECT_EQ(properties.size(), 20U);
  EXPECT_TRUE(std::is_sorted(properties.begin(), properties.end(), [](auto& a, auto& b) {
    return std::string(a.name) < std::string(b.name);
  }));
}

/// OMPL's script cannot read a log with a property without a value.
TEST(Columns, OfExperimentsAreThoseThatTheScenarioHas) {
  std::set<std::string> all, has;
  for (const auto& property : arena_experiment(full_experiment(), {}).properties) {
    all.insert(property.name);
  }
  for (const auto& property :
       arena_experiment({.scenario = {}, .configurations = {}}, {}).properties) {
    EXPECT_FALSE(std::holds_alternative<std::monostate>(property.value)) << property.name;
    has.insert(property.name);
  }
  std::set<std::string> missing;
  std::ranges::set_difference(all, has, std::inserter(missing, missing.end()));
  EXPECT_THAT(missing, ElementsAre("link_radii_m", "orientation", "orientation_tolerance_rad",
                                   "reference_clearance_m", "robot"));
}

TEST(Columns, OfTimesAreThoseOfSuccesses) {
  for (const RunColumn& column : run_columns()) {
    const std::string key = column.key;
    const bool is_time = key.starts_with("times.") && key.ends_with("_s");
    EXPECT_TRUE(!is_time || column.of_successes) << key;
  }
}

TEST(Enumerations, BeginWithSuccessAndNameEveryFailure) {
  const std::vector<std::string>& status = enumerations().front().values;
  EXPECT_THAT(status, ElementsAre("success", "disagreement", "inputs_changed", "work_hidden",
                                  "timed_out", "out_of_memory", "crashed", "not_finite",
                                  "incomplete", "wrong_start", "collision", "self_collision",
                                  "undecided", "jump", "joint_limit", "drift", "orientation"));
  std::vector<std::string> names;
  for (const Enumeration& enumeration : enumerations()) {
    names.push_back(enumeration.name);
    for (const std::string& value : enumeration.values)
      EXPECT_THAT(value, testing::Not(HasSubstr("|")));
  }
  EXPECT_THAT(names, ElementsAre("status", "claim", "gave_up_because", "gave_up_class"));
}

TEST(OneWord, HasNoSpaceOfAnyKind) {
  EXPECT_EQ(one_word("planar_7r"), "planar_7r");
  EXPECT_EQ(one_word("two words"), "two_words");
  EXPECT_EQ(one_word(" a  b "), "_a__b_");
  EXPECT_EQ(one_word("a\u00a0b\u2003c\u3000d\u2028"), "a_b_c_d_");
  EXPECT_EQ(one_word("ком ната"), "ком_ната");
  EXPECT_EQ(one_word(""), "unnamed");
}

TEST(CellText, ReadsBackAsTheSameNumber) {
  EXPECT_EQ(cell_text(Cell()), "");
  EXPECT_EQ(cell_text(true), "1");
  EXPECT_EQ(cell_text(false), "0");
  EXPECT_EQ(cell_text(std::numeric_limits<std::int64_t>::min()), "-9223372036854775808");
  EXPECT_EQ(cell_text(std::string("a; b")), "a; b");
  for (const double number : {0.1, 1.0 / 3, 5e-324, 1.7976931348623157e308, -2.5e-7}) {
    EXPECT_EQ(std::strtod(cell_text(number).c_str(), nullptr), number);
  }
}

TEST(SqliteDatabaseTest, GivesTheBytesOfAFile) {
  SqliteDatabase database;
  database.execute("CREATE TABLE t (a, b)");
  SqliteStatement insert(database, insert_statement("t", 2));
  insert.run({std::string("x'\"\xc3\xbc"), 0.1});
  insert.run({Cell(), true});
  EXPECT_EQ(database.last_row_id(), 2);
  EXPECT_THAT(database.file_content(), testing::StartsWith("SQLite format 3"));
  SqliteStatement sum(database, "SELECT SUM(b) FROM t WHERE a IS NOT ?");
  EXPECT_EQ(sum.number({std::string("y")}), 1.1);
  EXPECT_EQ(sum.number({Cell()}), 0.1);
}

TEST(SqliteDatabaseTest, SaysWhatItRefuses) {
  SqliteDatabase database;
  try {
    database.execute("CREATE TABLE order (a)");
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("near \"order\": syntax error"));
  }
  database.execute("CREATE TABLE t (a NOT NULL)");
  SqliteStatement insert(database, insert_statement("t", 1));
  EXPECT_THROW(insert.run({Cell()}), std::runtime_error);
  insert.run({false});  // and goes on
  EXPECT_EQ(database.last_row_id(), 1);
}

TEST(RecordFiles, AreTheRunsAndThenTheShards) {
  const TemporaryDirectory directory;
  const std::filesystem::path& place = directory.path();
  EXPECT_THAT(record_files(place), ElementsAre());
  EXPECT_THROW(required_record_files(place), InputError);
  std::filesystem::create_directories(place / "shards" / "4-of-12.jsonl");  // not a file
  for (const char* name :
       {"2-of-12.jsonl", "10-of-12.jsonl", "1-of-8.jsonl", "3-of-12.part.jsonl", "13-of-12.jsonl",
        "0-of-12.jsonl", "-1-of-12.jsonl", "5-of-.jsonl", "5-of-part.jsonl", "6-of-12.json",
        "7-of-12x.jsonl", "8-of-12.lock", "99999999999-of-99999999999.jsonl"}) {
    write_text_file(place / "shards" / name, "");
  }
  EXPECT_THAT(record_files(place),
              ElementsAre(place / "shards/1-of-8.jsonl", place / "shards/2-of-12.jsonl",
                          place / "shards/10-of-12.jsonl", place / "shards/3-of-12.part.jsonl"));
  write_text_file(runs_file(place), "");
  EXPECT_THAT(
      record_files(place),
      ElementsAre(runs_file(place), place / "shards/1-of-8.jsonl", place / "shards/2-of-12.jsonl",
                  place / "shards/10-of-12.jsonl", place / "shards/3-of-12.part.jsonl"));
}

TEST(ReadExportedRuns, KeepsEveryRunOfTheReferenceResults) {
  const ExportedRuns runs =
      read_exported_runs(BQSA_SOURCE_DIR "/results/paper_scenarios", std::nullopt);
  EXPECT_EQ(runs.runs, 51);
  EXPECT_EQ(runs.not_applicable, 3);
  EXPECT_EQ(runs.experiments.size(), 3U);
  EXPECT_TRUE(runs.bad_lines.empty());
  int successes = 0;
  for (const ExportedExperiment& experiment : runs.experiments) {
    for (const ExportedConfiguration& configuration : experiment.configurations) {
      for (const ExportedRun& run : configuration.runs) {
        const bool solved = std::get<bool>(run.figure("solved"));
        successes += solved;
        EXPECT_EQ(std::holds_alternative<double>(run.figure("time")), solved);
      }
    }
  }
  EXPECT_EQ(successes, 38);
}

TEST(WriteOmplLogs, WithoutAPlaceIsRefused) {
  const ExportedRuns runs =
      read_exported_runs(BQSA_SOURCE_DIR "/results/paper_scenarios", std::nullopt);
  const TemporaryDirectory directory;
  write_text_file(directory.path() / "file", "");
  EXPECT_THROW(write_ompl_logs(runs, directory.path() / "file"), InputError);
  EXPECT_THROW(write_ompl_logs(runs, directory.path() / "three.log"), InputError);
  EXPECT_EQ(write_ompl_logs(runs, directory.path() / "logs").size(), 3U);
}

}  // namespace
}  // namespace bqsa::harness
