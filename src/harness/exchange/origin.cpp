#include "harness/exchange/origin.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <nlohmann/json.hpp>

namespace bqsa::harness {
namespace {

struct OriginColumn {
  const char* name;  ///< no keyword of SQL
  const char* key;   ///< below `provenance`
};

constexpr std::array kOriginColumns{
    OriginColumn{"version", "version"},
    OriginColumn{"source_commit", "commit"},
    OriginColumn{"modified", "dirty"},
    OriginColumn{"compiler", "compiler"},
    OriginColumn{"build_type", "build_type"},
    OriginColumn{"compiler_flags", "flags"},
    OriginColumn{"assertions", "assertions"},
    OriginColumn{"sanitizers", "sanitizers"},
    OriginColumn{"libraries", "libraries"},
    OriginColumn{"processor", "processor"},
    OriginColumn{"cores", "cores"},
    OriginColumn{"governor", "governor"},
    OriginColumn{"os", "os"},
    OriginColumn{"host", "host"},
    OriginColumn{"jobs", "jobs"},
    OriginColumn{"isolated", "isolated"},
    OriginColumn{"wall_limit_s", "wall_limit_s"},
    OriginColumn{"memory_limit_bytes", "memory_limit_bytes"},
    OriginColumn{"plan_budget_s", "plan_budget_s"},
    OriginColumn{"command_line", "command_line"},
    OriginColumn{"out_of_tree", "out_of_tree"},
    OriginColumn{"external_command", "external"},
};

constexpr auto kOriginNames = [] {
  std::array<const char*, kOriginColumns.size()> names{};
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kOriginColumns[i].name;
  return names;
}();

/// `Eigen 3.4.0, FCL 0.7.0` of an object, `a, b` of a list.
Cell origin_cell(const nlohmann::json& json) {
  if (!json.is_structured()) return scalar_cell(json);
  std::string text;
  for (const auto& [key, value] : json.items()) {
    const std::string entry =
        value.is_string() ? printable(value.get_ref<const std::string&>()) : value.dump();
    text += text.empty() ? "" : ", ";
    text += json.is_object() ? printable(key) + " " + entry : entry;
  }
  return text;
}

}  // namespace

Origin read_origin(const nlohmann::json& provenance) {
  Origin origin;
  for (const OriginColumn& column : kOriginColumns) {
    const auto found = provenance.find(column.key);
    origin.values.push_back(found == provenance.end() ? Cell() : origin_cell(*found));
  }
  return origin;
}

std::span<const char* const> Origin::columns() { return kOriginNames; }

const Cell& Origin::operator[](std::string_view column) const {
  const auto found = std::find(kOriginNames.begin(), kOriginNames.end(), column);
  assert(found != kOriginNames.end());
  return values[static_cast<std::size_t>(found - kOriginNames.begin())];
}

std::string Origin::text(std::string_view column) const {
  const auto* text = std::get_if<std::string>(&(*this)[column]);
  return text != nullptr ? *text : "unknown";
}

double Origin::number(std::string_view column) const {
  const Cell& cell = (*this)[column];
  if (const auto* real = std::get_if<double>(&cell)) return *real;
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*whole);
  return 0;
}

}  // namespace bqsa::harness
