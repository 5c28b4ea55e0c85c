/// @file
/// What of a run's provenance many runs share.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/exchange/run_columns.hpp"

namespace bqsa::harness {

/// Build, machine, limits, call.
struct Origin {
  static std::span<const char* const> columns();

  std::vector<Cell> values;  ///< one for each column

  /// @param column  of columns()
  const Cell& operator[](std::string_view column) const;
  std::string text(std::string_view column) const;  ///< `unknown` if it has none
  double number(std::string_view column) const;     ///< 0 if it has none

  bool operator==(const Origin&) const = default;
};

/// @param provenance  of a record
Origin read_origin(const nlohmann::json& provenance);

}  // namespace bqsa::harness
