/// @file
/// Where the records of a results directory are.
#pragma once

#include <filesystem>
#include <vector>

#include "harness/input_error.hpp"

namespace bqsa::harness {

/// The files of a directory that hold records and are there: `runs.jsonl`, then the shards of a campaign by N
/// and k, complete ones `shards/<k>-of-<N>.jsonl` before others `shards/<k>-of-<N>.part.jsonl`.
std::vector<std::filesystem::path> record_files(const std::filesystem::path& directory);

/// The same.
/// @throws InputError if there are none
std::vector<std::filesystem::path> required_record_files(const std::filesystem::path& directory);

}  // namespace bqsa::harness
