/// @file
/// Everything that a page shows of a results directory, as JSON of report/bqsa-report-1.schema.json.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bqsa/method.hpp"
#include "harness/report/json.hpp"
#include "harness/report/scenes_and_replays.hpp"

namespace bqsa::harness::report {

struct PageSources {
  std::filesystem::path directory;  ///< the results
  std::filesystem::path page;       ///< the file that is made of them

  /// Files of `measure` and `claims`, directory of `figures`; empty: those in the results directory, where
  /// reproduce.sh puts them, if they are there.
  std::filesystem::path measurements = {};
  std::filesystem::path claims = {};
  std::filesystem::path figures = {};

  std::vector<std::filesystem::path> scenarios = {};  ///< further directories to look for them in
  LoadOptions load = {};
  PageLimits limits = {};
};

// NOLINTNEXTLINE(bugprone-exception-escape): moving JSON throws nothing, though it may fail an assertion
struct PageData {
  Json json;

  /// What of the results could not be used and is not on the page: lines that are not records, and files
  /// beside them that were not named and cannot be read.
  std::vector<std::string> problems;
};

/// @param known  the program's methods
/// @throws InputError if there are no records, or for a file that was named and cannot be read
PageData page_data(const PageSources& sources, const std::vector<MethodEntry>& known);

}  // namespace bqsa::harness::report
