#include "harness/results/record_files.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

#include "harness/results/result_store.hpp"

namespace bqsa::harness {
namespace {

/// Whether it is under way, N and k.
using Shard = std::tuple<bool, int, int>;

std::optional<int> number_in(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || number < 1) return std::nullopt;
  return number;
}

/// Of `<k>-of-<N>.jsonl` or `<k>-of-<N>.part.jsonl`, nothing for another name.
std::optional<Shard> shard_named(std::string_view name) {
  constexpr std::string_view kOf = "-of-";
  constexpr std::string_view kEnd = ".jsonl";
  constexpr std::string_view kPartialEnd = ".part.jsonl";
  const std::size_t middle = name.find(kOf);
  if (middle == std::string_view::npos || !name.ends_with(kEnd)) return std::nullopt;
  const bool partial = name.ends_with(kPartialEnd);
  const std::size_t after = middle + kOf.size();
  const std::size_t end = name.size() - (partial ? kPartialEnd : kEnd).size();
  if (end < after) return std::nullopt;
  const auto number = number_in(name.substr(0, middle));
  const auto count = number_in(name.substr(after, end - after));
  if (!number || !count || *number > *count) return std::nullopt;
  return Shard(partial, *count, *number);
}

}  // namespace

std::vector<std::filesystem::path> record_files(const std::filesystem::path& directory) {
  std::vector<std::pair<Shard, std::filesystem::path>> shards;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(directory / "shards", none)) {
    const auto shard = shard_named(entry.path().filename().string());
    if (shard && entry.is_regular_file(none)) shards.emplace_back(*shard, entry.path());
  }
  std::sort(shards.begin(), shards.end());
  std::vector<std::filesystem::path> files;
  if (std::filesystem::exists(runs_file(directory), none)) files.push_back(runs_file(directory));
  for (const auto& [shard, file] : shards) files.push_back(file);
  return files;
}

std::vector<std::filesystem::path> required_record_files(const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> files = record_files(directory);
  if (files.empty()) {
    throw InputError(fmt::format("{}: cannot read: not a file, or not a readable one",
                                 runs_file(directory).string()));
  }
  return files;
}

}  // namespace bqsa::harness
