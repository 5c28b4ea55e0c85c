/// @file
/// The data of a page against their published schema, by a validator that is not ours.
#pragma once

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace bqsa::harness::report {

const nlohmann::json& report_schema();

/// What the data of a page break of the schema, a line each; empty if nothing.
std::string schema_errors(const nlohmann::json& json);

/// The data of a page, as a browser finds them.
inline nlohmann::json data_in(const std::string& page) {
  const std::string begin = R"(<script type="application/json" id="report-data">)";
  const std::size_t from = page.find(begin);
  if (from == std::string::npos) throw std::runtime_error("no data in the page");
  const std::size_t start = from + begin.size();
  return nlohmann::json::parse(page.substr(start, page.find("</script", start) - start));
}

}  // namespace bqsa::harness::report
