/// @file
/// The rows of a results directory, of a campaign or not.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "harness/campaign/campaign_log.hpp"
#include "harness/results/table_row.hpp"

namespace bqsa::harness {

struct StoredRows {
  std::vector<TableRow> rows;
  std::vector<BadLine> bad_lines;
  std::size_t stale =
      0;  ///< records of runs that are not in the campaign's plan, and not in `rows`
};

/// Reads all files of records, the shards of a campaign included, in the order of record_files().
/// @throws InputError if there is none, or the plan of a campaign cannot be read
StoredRows stored_rows(const std::filesystem::path& directory);

}  // namespace bqsa::harness
