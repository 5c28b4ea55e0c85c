/// @file
/// SQLite, as far as exports need it.
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "harness/exchange/run_columns.hpp"

namespace bqsa::harness {

/// A database in memory. What SQLite refuses throws std::runtime_error with its message: our mistake, or
/// no memory.
class SqliteDatabase {
 public:
  SqliteDatabase();

  /// Executes statements without parameters.
  void execute(const std::string& sql);

  std::int64_t last_row_id() const;

  /// The bytes of a file that holds the database.
  std::string file_content() const;

 private:
  friend class SqliteStatement;
  struct Close {
    void operator()(sqlite3* database) const { sqlite3_close_v2(database); }
  };
  std::unique_ptr<sqlite3, Close> database_;
};

/// A statement whose parameters are given anew at each call.
class SqliteStatement {
 public:
  SqliteStatement(SqliteDatabase& database, const std::string& sql);

  /// @param cells  as many as it has parameters
  void run(const std::vector<Cell>& cells);

  /// The number in the first column of the one row that it yields.
  double number(const std::vector<Cell>& cells);

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };
  void bind(const std::vector<Cell>& cells);
  void check(int code) const;

  SqliteDatabase& database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

/// `INSERT INTO table VALUES (?,...)`.
std::string insert_statement(std::string_view table, std::size_t columns);

}  // namespace bqsa::harness
