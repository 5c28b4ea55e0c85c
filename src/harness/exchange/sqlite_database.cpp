#include "harness/exchange/sqlite_database.hpp"

#include <fmt/format.h>

#include <cassert>
#include <stdexcept>

namespace bqsa::harness {
namespace {

void check(sqlite3* database, int code) {
  if (code == SQLITE_OK || code == SQLITE_DONE || code == SQLITE_ROW) return;
  throw std::runtime_error(fmt::format("SQLite: {}", sqlite3_errmsg(database)));
}

struct Bind {
  sqlite3_stmt* statement;
  int place;

  int operator()(std::monostate) const { return sqlite3_bind_null(statement, place); }
  int operator()(bool truth) const { return sqlite3_bind_int(statement, place, truth ? 1 : 0); }
  int operator()(std::int64_t whole) const { return sqlite3_bind_int64(statement, place, whole); }
  int operator()(double number) const { return sqlite3_bind_double(statement, place, number); }
  int operator()(const std::string& text) const {
    return sqlite3_bind_text64(statement, place, text.data(), text.size(), SQLITE_STATIC,
                               SQLITE_UTF8);
  }
};

}  // namespace

SqliteDatabase::SqliteDatabase() {
  sqlite3* database = nullptr;
  const int code = sqlite3_open(":memory:", &database);
  database_.reset(database);
  check(database, code);
}

void SqliteDatabase::execute(const std::string& sql) {
  check(database_.get(), sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr));
}

std::int64_t SqliteDatabase::last_row_id() const {
  return sqlite3_last_insert_rowid(database_.get());
}

std::string SqliteDatabase::file_content() const {
  sqlite3_int64 size = 0;
  const std::unique_ptr<unsigned char, decltype(&sqlite3_free)> bytes(
      sqlite3_serialize(database_.get(), "main", &size, 0), &sqlite3_free);
  if (!bytes) throw std::runtime_error("SQLite: out of memory");
  return {reinterpret_cast<const char*>(bytes.get()), static_cast<std::size_t>(size)};
}

SqliteStatement::SqliteStatement(SqliteDatabase& database, const std::string& sql)
    : database_(database) {
  sqlite3_stmt* statement = nullptr;
  check(sqlite3_prepare_v2(database.database_.get(), sql.c_str(), -1, &statement, nullptr));
  statement_.reset(statement);
}

void SqliteStatement::run(const std::vector<Cell>& cells) {
  bind(cells);
  const int code = sqlite3_step(statement_.get());
  sqlite3_reset(statement_.get());
  check(code);
}

double SqliteStatement::number(const std::vector<Cell>& cells) {
  bind(cells);
  const int code = sqlite3_step(statement_.get());
  const double number = sqlite3_column_double(statement_.get(), 0);
  sqlite3_reset(statement_.get());
  check(code);
  return number;
}

void SqliteStatement::bind(const std::vector<Cell>& cells) {
  assert(static_cast<int>(cells.size()) == sqlite3_bind_parameter_count(statement_.get()));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    check(std::visit(Bind{statement_.get(), static_cast<int>(i) + 1}, cells[i]));
  }
}

void SqliteStatement::check(int code) const { harness::check(database_.database_.get(), code); }

std::string insert_statement(std::string_view table, std::size_t columns) {
  return fmt::format("INSERT INTO {} VALUES ({})", table,
                     fmt::join(std::vector<char>(columns, '?'), ","));
}

}  // namespace bqsa::harness
