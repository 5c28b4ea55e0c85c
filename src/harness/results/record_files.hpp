/// @file
/// Where the records of a results directory are.
#pragma once

#include <filesystem>
#include <vector>

namespace bqsa::harness {

/// The files of a directory that hold records: the shards of a campaign that are complete,
/// `shards/<k>-of-<N>.jsonl` by N and k, then `runs.jsonl`. Without any of them `runs.jsonl`, which is
/// then missing.
std::vector<std::filesystem::path> record_files(const std::filesystem::path& directory);

}  // namespace bqsa::harness
