#include "harness/exchange/planner_arena.hpp"

#include <fmt/format.h>

#include <map>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include "harness/exchange/arena_experiment.hpp"
#include "harness/exchange/own_tables.hpp"
#include "harness/exchange/sqlite_database.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

/// Tables, to which columns are added, and views as OMPL 1.5's ompl_benchmark_statistics makes them.
constexpr const char* kArenaTables = R"(
  CREATE TABLE experiments
  (id INTEGER PRIMARY KEY AUTOINCREMENT, name VARCHAR(512),
  totaltime REAL, timelimit REAL, memorylimit REAL, runcount INTEGER,
  version VARCHAR(128), hostname VARCHAR(1024), cpuinfo TEXT,
  date DATETIME, seed VARCHAR(24), setup TEXT);
  CREATE TABLE plannerConfigs
  (id INTEGER PRIMARY KEY AUTOINCREMENT,
  name VARCHAR(512) NOT NULL, settings TEXT);
  CREATE TABLE enums
  (name VARCHAR(512), value INTEGER, description TEXT,
  PRIMARY KEY (name, value));
  CREATE TABLE runs
  (id INTEGER PRIMARY KEY AUTOINCREMENT, experimentid INTEGER, plannerid INTEGER,
  FOREIGN KEY (experimentid) REFERENCES experiments(id) ON DELETE CASCADE,
  FOREIGN KEY (plannerid) REFERENCES plannerConfigs(id) ON DELETE CASCADE);
  CREATE TABLE progress
  (runid INTEGER, time REAL, PRIMARY KEY (runid, time),
  FOREIGN KEY (runid) REFERENCES runs(id) ON DELETE CASCADE);)";

constexpr const char* kArenaViews = R"(
  CREATE VIEW bestPlannerConfigsPerExperiment AS
  SELECT plannerid, experimentid, MIN(avg_solved) AS avg_solved, avg_total_time
  FROM (SELECT plannerid, plannerName, experimentid, AVG(solved) AS avg_solved,
        AVG(total_time) AS avg_total_time
        FROM (SELECT plannerid, plannerConfigs.name AS plannerName, experimentid,
              solved, time AS total_time
              FROM plannerConfigs INNER JOIN experiments INNER JOIN runs
              ON plannerConfigs.id=runs.plannerid AND experiments.id=runs.experimentid)
        GROUP BY plannerid, experimentid)
  GROUP BY plannerName, experimentid ORDER BY avg_solved DESC, avg_total_time ASC;
  CREATE VIEW bestPlannerConfigs AS
  SELECT plannerid, MIN(avg_solved) AS avg_solved, avg_total_time
  FROM (SELECT plannerid, plannerName, AVG(solved) AS avg_solved,
        AVG(total_time) AS avg_total_time
        FROM (SELECT plannerid, plannerConfigs.name AS plannerName, experimentid,
              solved, time AS total_time
              FROM plannerConfigs INNER JOIN experiments INNER JOIN runs
              ON plannerConfigs.id=runs.plannerid AND experiments.id=runs.experimentid)
        GROUP BY plannerid)
  GROUP BY plannerName ORDER BY avg_solved DESC, avg_total_time ASC;)";

void refuse_journal_of(const std::filesystem::path& file) {
  for (const char* end : {"-journal", "-wal"}) {
    std::filesystem::path journal = file;
    journal += end;
    std::error_code ignored;
    if (std::filesystem::exists(journal, ignored)) {
      throw InputError(
          fmt::format("{}: expected a database that nobody writes to, got one with the journal {}",
                      file.string(), journal.string()));
    }
  }
}

class ArenaWriter {
 public:
  explicit ArenaWriter(SqliteDatabase& database) : database_(database) {}

  void write(const ExportedRuns& runs) {
    database_.execute("PRAGMA foreign_keys = ON; BEGIN");
    database_.execute(kArenaTables);
    add_run_columns();
    add_enumerations();
    OwnTables own(database_);
    for (std::size_t i = 0; i < runs.origins.size(); ++i) own.add_origin(i, runs.origins[i]);
    SqliteStatement insert_run(database_, insert_statement("runs", 3 + run_columns().size()));
    for (const ExportedExperiment& experiment : runs.experiments) {
      const Cell experiment_id = add_experiment(arena_experiment(experiment, runs.origins));
      for (const ExportedConfiguration& configuration : experiment.configurations) {
        const Cell planner_id = planner_of(configuration.method, own);
        for (const ExportedRun& run : configuration.runs) {
          std::vector<Cell> cells{Cell(), experiment_id, planner_id};
          for (const Figure& figure : run.figures) cells.push_back(cell_of(figure));
          insert_run.run(cells);
          own.add_run(database_.last_row_id(), run);
        }
      }
    }
    database_.execute(kArenaViews);
    database_.execute("COMMIT");
  }

 private:
  void add_run_columns() {
    for (const RunColumn& column : run_columns()) {
      database_.execute(fmt::format("ALTER TABLE runs ADD {} {}", column.name, column.sql_type()));
    }
  }

  void add_enumerations() {
    SqliteStatement insert(database_, insert_statement("enums", 3));
    for (const Enumeration& enumeration : enumerations()) {
      for (std::size_t i = 0; i < enumeration.values.size(); ++i) {
        insert.run({enumeration.name, static_cast<std::int64_t>(i), enumeration.values[i]});
      }
    }
  }

  /// Those that no experiment before had, as the reader of logs does.
  void add_property_columns(const ArenaExperiment& arena) {
    for (const ExperimentProperty& property : arena.properties) {
      if (!property_columns_.insert(property.name).second) continue;
      database_.execute(
          fmt::format("ALTER TABLE experiments ADD {} {}", property.name, property.sql_type));
    }
  }

  Cell add_experiment(const ArenaExperiment& arena) {
    add_property_columns(arena);
    std::string columns =
        "name, totaltime, timelimit, memorylimit, runcount, version, hostname, cpuinfo, "
        "date, seed, setup";
    std::vector<Cell> cells{arena.name,
                            arena.total_s,
                            arena.time_limit_s,
                            arena.memory_limit_mb,
                            static_cast<std::int64_t>(arena.runs_per_planner),
                            std::string(kLibrary) + " " + arena.version,
                            arena.host,
                            arena.processor,
                            arena.date,
                            arena.seed,
                            arena.setup};
    for (const ExperimentProperty& property : arena.properties) {
      columns += fmt::format(", {}", property.name);
      cells.push_back(property.value);
    }
    SqliteStatement(database_,
                    insert_statement(fmt::format("experiments ({})", columns), cells.size()))
        .run(cells);
    return database_.last_row_id();
  }

  /// One for each pair of name and settings, whatever the experiment.
  Cell planner_of(const ExportedMethod& method, OwnTables& own) {
    const auto [place, is_new] = planners_.try_emplace({method.variant, arena_settings(method)}, 0);
    if (is_new) {
      SqliteStatement(database_, insert_statement("plannerConfigs", 3))
          .run({Cell(), place->first.first, place->first.second});
      place->second = database_.last_row_id();
      own.add_parameters(place->second, method);
    }
    return place->second;
  }

  SqliteDatabase& database_;
  std::set<std::string> property_columns_;
  std::map<std::pair<std::string, std::string>, std::int64_t> planners_;
};

}  // namespace

void write_planner_arena(const ExportedRuns& runs, const std::filesystem::path& file) {
  refuse_journal_of(file);
  SqliteDatabase database;
  ArenaWriter(database).write(runs);
  write_text_file(file, database.file_content());
}

}  // namespace bqsa::harness
