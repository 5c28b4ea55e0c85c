/// @file
/// The tables that a database has beside those of Planner Arena.
#pragma once

#include <cstdint>

#include "harness/exchange/exported_runs.hpp"
#include "harness/exchange/sqlite_database.hpp"

namespace bqsa::harness {

/// Fills our own tables, row by row, of a database that has those of Planner Arena.
class OwnTables {
 public:
  /// Makes the tables.
  explicit OwnTables(SqliteDatabase& database);

  void add_origin(std::size_t index, const Origin& origin);
  void add_parameters(std::int64_t planner, const ExportedMethod& method);
  void add_run(std::int64_t run_id, const ExportedRun& run);

 private:
  SqliteStatement origins_;
  SqliteStatement parameters_;
  SqliteStatement provenance_;
  SqliteStatement counters_;
  SqliteStatement claims_;
  SqliteStatement failures_;
  SqliteStatement contacts_;
  SqliteStatement trajectories_;
};

}  // namespace bqsa::harness
