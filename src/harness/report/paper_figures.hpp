/// @file
/// The figures that `figures` drew, for a page to link to.
#pragma once

#include <filesystem>

#include "harness/input_error.hpp"
#include "harness/report/json.hpp"

namespace bqsa::harness::report {

/// Of a directory of figures, what is in it.
inline constexpr const char* kFiguresIndex = "index.md";

/// A list of `PaperFigure` of the schema, by the index that FigureWriter writes. Files that are not there
/// are left out, and figures without any.
/// @param directory  with that index
/// @param page       the file that will link to them
/// @throws InputError if there is no index that can be read
Json figures_json(const std::filesystem::path& directory, const std::filesystem::path& page);

/// A path as an address: every byte but letters, digits and `-._~/` as `%7E`.
std::string address_of(const std::filesystem::path& path);

}  // namespace bqsa::harness::report
