/// @file
/// Refuses text that is not harmless YAML, before anything is built from it.
#pragma once

#include <string>

#include "harness/input_error.hpp"

namespace bqsa::harness {

/// Checks that the text is one YAML document in UTF-8 without control characters (tab and line
/// breaks apart), anchors, aliases, tags, and more than 8 levels of nesting. No scenario needs any
/// of these, and they are what makes YAML grow without bound.
/// @param file  its name in messages
/// @throws InputError `file:line: expected ..., got ...`
void check_yaml(const std::string& file, const std::string& text);

}  // namespace bqsa::harness
