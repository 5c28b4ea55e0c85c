/// @file
/// The JSON of a report: keys stay in the order in which they are set, as in report/bqsa-report-1.schema.json.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace bqsa::harness::report {

using Json = nlohmann::ordered_json;

/// The number, or null if it is not finite.
Json number_or_null(double number);

/// On one line. Bytes that are not UTF-8 are replaced by U+FFFD, numbers that are not finite by null.
std::string text_of(const Json& json);

}  // namespace bqsa::harness::report
