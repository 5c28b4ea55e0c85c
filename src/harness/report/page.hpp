/// @file
/// The page: a template that is part of the program, filled with data.
#pragma once

#include <string>
#include <string_view>

#include "harness/report/json.hpp"

namespace bqsa::harness::report {

/// report/dist/template.html, as it was when the program was built.
std::string_view page_template();

/// Stands where the data go.
inline constexpr std::string_view kDataMark = "@BQSA_REPORT_DATA@";

/// JSON that can stand in a `<script>` of an HTML page: nothing in it ends the script, begins a comment or
/// ends a line of JavaScript.
std::string script_text(const Json& json);

/// @throws std::runtime_error unless the template has the mark exactly once
std::string filled_page(std::string_view page_template, const Json& json);

}  // namespace bqsa::harness::report
