#include "harness/results/record_files.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "harness/results/result_store.hpp"

namespace bqsa::harness {
namespace {

std::optional<int> number_in(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || number < 1) return std::nullopt;
  return number;
}

/// N and k of `<k>-of-<N>.jsonl`, nothing for another name.
std::optional<std::pair<int, int>> shard_of(const std::string& name) {
  constexpr std::string_view kOf = "-of-";
  constexpr std::string_view kEnd = ".jsonl";
  const std::size_t middle = name.find(kOf);
  if (middle == std::string::npos || !name.ends_with(kEnd)) return std::nullopt;
  const std::size_t after = middle + kOf.size();
  const auto number = number_in(std::string_view(name).substr(0, middle));
  const auto count =
      number_in(std::string_view(name).substr(after, name.size() - kEnd.size() - after));
  if (!number || !count || *number > *count) return std::nullopt;
  return std::pair(*count, *number);
}

}  // namespace

std::vector<std::filesystem::path> record_files(const std::filesystem::path& directory) {
  std::vector<std::pair<std::pair<int, int>, std::filesystem::path>> shards;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(directory / "shards", none)) {
    const auto shard = shard_of(entry.path().filename().string());
    if (shard && entry.is_regular_file(none)) shards.emplace_back(*shard, entry.path());
  }
  std::sort(shards.begin(), shards.end());
  std::vector<std::filesystem::path> files;
  files.reserve(shards.size() + 1);
  for (const auto& [shard, file] : shards) files.push_back(file);
  const std::filesystem::path runs = runs_file(directory);
  if (files.empty() || std::filesystem::exists(runs, none)) files.push_back(runs);
  return files;
}

}  // namespace bqsa::harness
