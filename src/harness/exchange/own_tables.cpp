#include "harness/exchange/own_tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <limits>

namespace bqsa::harness {
namespace {

/// Without a type a column keeps what it is given: numbers, truths as 0 and 1, texts.
constexpr const char* kTables = R"(
  CREATE TABLE provenance
  (runid INTEGER PRIMARY KEY, originid INTEGER NOT NULL, campaign TEXT, campaign_key TEXT,
  seed TEXT, date TEXT, load_average REAL, restarts INTEGER, against TEXT, record TEXT NOT NULL,
  FOREIGN KEY (runid) REFERENCES runs(id) ON DELETE CASCADE,
  FOREIGN KEY (originid) REFERENCES origins(id));
  CREATE TABLE parameters
  (plannerid INTEGER, name TEXT, value, PRIMARY KEY (plannerid, name),
  FOREIGN KEY (plannerid) REFERENCES plannerConfigs(id) ON DELETE CASCADE);
  CREATE TABLE counters
  (runid INTEGER, name TEXT, value INTEGER NOT NULL, PRIMARY KEY (runid, name),
  FOREIGN KEY (runid) REFERENCES runs(id) ON DELETE CASCADE);
  CREATE TABLE claims
  (runid INTEGER PRIMARY KEY, status TEXT NOT NULL, holds BOOLEAN NOT NULL, tick INTEGER,
  link INTEGER, obstacle TEXT, message TEXT, disagreement TEXT,
  FOREIGN KEY (runid) REFERENCES runs(id) ON DELETE CASCADE);
  CREATE TABLE failures
  (runid INTEGER, place INTEGER, name TEXT NOT NULL, PRIMARY KEY (runid, place),
  FOREIGN KEY (runid) REFERENCES runs(id) ON DELETE CASCADE);
  CREATE TABLE contacts
  (runid INTEGER, link INTEGER NOT NULL, obstacle TEXT, first_tick INTEGER NOT NULL,
  at_tick BOOLEAN NOT NULL, ticks INTEGER NOT NULL,
  FOREIGN KEY (runid) REFERENCES runs(id) ON DELETE CASCADE);
  CREATE INDEX contacts_of_run ON contacts(runid);
  CREATE TABLE trajectories
  (runid INTEGER PRIMARY KEY, file TEXT NOT NULL,
  FOREIGN KEY (runid) REFERENCES runs(id) ON DELETE CASCADE))";

std::string origins_table() {
  std::string columns;
  for (const char* name : Origin::columns()) columns += fmt::format(", {}", name);
  return fmt::format("CREATE TABLE origins (id INTEGER PRIMARY KEY{});", columns);
}

/// Makes the tables before the first statement on them is.
SqliteDatabase& with_tables(SqliteDatabase& database) {
  database.execute(origins_table() + kTables);
  return database;
}

Cell text_cell(const std::string& text) { return text.empty() ? Cell() : Cell(text); }

Cell whole_cell(std::int64_t number) { return number; }

/// Real beyond what SQL has a place for.
Cell count_cell(std::uint64_t count) {
  constexpr std::uint64_t kLargest = std::numeric_limits<std::int64_t>::max();
  return count <= kLargest ? Cell(static_cast<std::int64_t>(count))
                           : Cell(static_cast<double>(count));
}

Cell claim_cell(const ExportedRun& run) {
  for (const RunColumn& column : run_columns()) {
    if (std::string_view(column.name) != "claim") continue;
    const auto index = std::get<std::int64_t>(run.figure(column.name));
    return values_of(column)[static_cast<std::size_t>(index)];
  }
  return {};
}

}  // namespace

OwnTables::OwnTables(SqliteDatabase& database)
    : origins_(with_tables(database), insert_statement("origins", 1 + Origin::columns().size())),
      parameters_(database, insert_statement("parameters", 3)),
      provenance_(database, insert_statement("provenance", 10)),
      counters_(database, insert_statement("counters", 3)),
      claims_(database, insert_statement("claims", 8)),
      failures_(database, insert_statement("failures", 3)),
      contacts_(database, insert_statement("contacts", 6)),
      trajectories_(database, insert_statement("trajectories", 2)) {}

void OwnTables::add_origin(std::size_t index, const Origin& origin) {
  std::vector<Cell> cells = origin.values;
  cells.insert(cells.begin(), static_cast<std::int64_t>(index));
  origins_.run(cells);
}

void OwnTables::add_parameters(std::int64_t planner, const ExportedMethod& method) {
  for (const ExportedParameter& parameter : method.parameters) {
    parameters_.run({planner, parameter.name, parameter.value});
  }
}

void OwnTables::add_run(std::int64_t run_id, const ExportedRun& run) {
  provenance_.run({run_id, static_cast<std::int64_t>(run.origin), text_cell(run.campaign),
                   text_cell(run.key), text_cell(run.seed), text_cell(run.date),
                   std::isfinite(run.load_average) ? Cell(run.load_average) : Cell(),
                   run.restarts ? whole_cell(*run.restarts) : Cell(),
                   text_cell(fmt::format("{}", fmt::join(run.against, ", "))), run.record});
  for (const auto& [name, value] : run.counters) counters_.run({run_id, name, count_cell(value)});
  claims_.run({run_id, claim_cell(run), cell_of(run.figure("claim_holds")),
               cell_of(run.figure("claim_tick")), cell_of(run.figure("claim_link")),
               text_cell(run.claim_obstacle), text_cell(run.claim_message),
               text_cell(run.disagreement)});
  for (std::size_t i = 0; i < run.failures.size(); ++i) {
    failures_.run({run_id, static_cast<std::int64_t>(i + 1), run.failures[i]});
  }
  for (const ExportedContact& contact : run.contacts) {
    contacts_.run({run_id, whole_cell(contact.link), text_cell(contact.obstacle),
                   whole_cell(contact.first_tick), contact.at_tick, whole_cell(contact.ticks)});
  }
  if (!run.trajectory.empty()) trajectories_.run({run_id, run.trajectory});
}

}  // namespace bqsa::harness
