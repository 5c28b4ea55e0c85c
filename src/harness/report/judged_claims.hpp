/// @file
/// An evaluation of claims as a page has it.
#pragma once

#include <filesystem>

#include "harness/input_error.hpp"
#include "harness/report/json.hpp"

namespace bqsa::harness::report {

/// `Claims` of the schema.
/// @param file  claims.json
/// @throws InputError naming the file, and the key if it is not as `claims` writes it
Json claims_json(const std::filesystem::path& file);

}  // namespace bqsa::harness::report
