/// @file
/// The figures of a run that all formats have in common, a column each.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "harness/results/record_value.hpp"
#include "harness/results/table_row.hpp"

namespace bqsa::harness {

/// Nothing if the record has none.
using Figure = std::variant<std::monostate, bool, std::int64_t, double>;

/// A figure or a text.
using Cell = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

Cell cell_of(const Figure& figure);

/// Of a truth, number or text: whole numbers that SQL has no place for become real ones. Nothing of anything
/// else.
Cell scalar_cell(const nlohmann::json& json);

/// Numbers with the fewest digits that read back as the same, 0 and 1 for false and true, nothing for
/// nothing.
std::string cell_text(const Cell& cell);

/// What a column is made of.
enum class FigureSource {
  kBoolean,
  kInteger,
  kReal,
  kCount,   ///< number of entries of a list
  kEnum,    ///< index of a text in the enumeration of the column's name
  kStatus,  ///< likewise, of what the judge says: success, or the most telling failure
};

struct RunColumn {
  const char* name;  ///< a word that SQL does not know, its unit at the end
  FigureSource source;
  const char* key;            ///< of the record; older ones may lack it
  bool of_successes = false;  ///< a time: an invalid run is never fast

  const char* sql_type() const;
};

/// The first is `time`, the wall time of the whole run [s], as OMPL calls it.
std::span<const RunColumn> run_columns();

struct Enumeration {
  std::string name;  ///< of a column
  std::vector<std::string> values;
};

/// Of the columns that are one, in their order.
const std::vector<Enumeration>& enumerations();

/// @param column  of an enumeration
const std::vector<std::string>& values_of(const RunColumn& column);

/// One for each column.
/// @param row  parse_run_record() of the record, which is applicable
/// @throws InputError if the record is not as documented
std::vector<Figure> read_figures(const RecordValue& record, const TableRow& row);

}  // namespace bqsa::harness
