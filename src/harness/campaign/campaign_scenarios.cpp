#include "harness/campaign/campaign_scenarios.hpp"

#include <fmt/format.h>
#include <glob.h>

#include <algorithm>
#include <limits>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include "harness/generator/generator.hpp"
#include "harness/scenario_files.hpp"

namespace bqsa::harness {
namespace fs = std::filesystem;
namespace {

constexpr const char* kWildcards = "*?[";
constexpr int kMostGenerated = 100'000;  // the index in a name has five digits

/// The text with a backslash before what glob(3) takes for more than itself.
std::string taken_literally(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\' || std::string_view(kWildcards).find(c) != std::string_view::npos) {
      escaped += '\\';
    }
    escaped += c;
  }
  return escaped;
}

/// `..` after a wildcard matches the same files over and over: with a few of them, more than memory
/// holds.
void refuse_ways_back(const YamlValue& value, const std::string& pattern) {
  const std::size_t wildcard = pattern.find_first_of(kWildcards);
  if (wildcard == std::string::npos) return;
  for (const fs::path& part : fs::path(pattern.substr(wildcard))) {
    if (part == "..") value.fail("a pattern with .. only before the first wildcard");
  }
}

/// Files and directories that match, by name.
std::vector<fs::path> matches_of(const YamlValue& value, const fs::path& directory) {
  const std::string pattern = value.text();
  if (pattern.empty()) value.fail("a scenario file, a directory, or a pattern", "an empty text");
  refuse_ways_back(value, pattern);
  const std::string whole = (fs::path(taken_literally(directory.string())) / pattern).string();
  glob_t found{};
  const int status = glob(whole.c_str(), GLOB_ERR | GLOB_NOSORT, nullptr, &found);
  std::vector<fs::path> matches;
  for (std::size_t i = 0; status == 0 && i < found.gl_pathc; ++i) {
    matches.emplace_back(found.gl_pathv[i]);
  }
  globfree(&found);
  if (status == GLOB_NOMATCH) value.fail("a pattern that matches a file", "one that matches none");
  if (status != 0) value.fail("a pattern of directories that can be read");
  std::sort(matches.begin(), matches.end());
  return matches;
}

std::vector<fs::path> files_of(const YamlValue& value, const fs::path& directory) {
  std::vector<fs::path> files;
  for (const fs::path& match : matches_of(value, directory)) {
    std::error_code unknown;
    if (!fs::is_directory(match, unknown)) {
      files.push_back(match);
      continue;
    }
    const std::vector<fs::path> inside = yaml_files(match);
    files.insert(files.end(), inside.begin(), inside.end());
  }
  if (files.empty()) {
    value.fail("a pattern that matches a file", "directories without files *.yaml");
  }
  return files;
}

GeneratedScenarios read_generate(const YamlValue& value, const fs::path& directory) {
  value.expect_keys({"family", "seed", "count", "robots"});
  const YamlValue family = value.get("family", "one of " + family_names());
  GeneratedScenarios generated;
  generated.family = family.text();
  if (find_family(generated.family) == nullptr) family.fail("one of " + family_names());
  generated.seed = static_cast<std::uint64_t>(
      value.get("seed", "a seed").whole_number(0, std::numeric_limits<int>::max()));
  generated.count = value.get("count", "a number of scenarios").whole_number(1, kMostGenerated);
  if (const auto robots = value.find("robots")) generated.robots = directory / robots->text();
  return generated;
}

bool same_names(const GeneratedScenarios& a, const GeneratedScenarios& b) {
  return a.family == b.family && a.seed == b.seed;
}

}  // namespace

NamedScenarios read_scenarios(const YamlValue& value, const fs::path& directory) {
  const char* const expected = "a list of patterns of scenario files, and {generate: ...}";
  NamedScenarios scenarios;
  std::set<fs::path> seen;
  for (const YamlValue& entry : value.list(expected)) {
    if (!entry.is_mapping()) {
      for (const fs::path& file : files_of(entry, directory)) {
        std::error_code unknown;
        if (seen.insert(fs::weakly_canonical(file, unknown)).second) {
          scenarios.files.push_back(file);
        }
      }
      continue;
    }
    entry.expect_keys({"generate"});
    const YamlValue generate = entry.get("generate", "a mapping of family, seed, count");
    const GeneratedScenarios generated = read_generate(generate, directory);
    const bool again = std::any_of(
        scenarios.generated.begin(), scenarios.generated.end(),
        [&generated](const GeneratedScenarios& other) { return same_names(generated, other); });
    if (again) {
      generate.fail("each family and seed once",
                    fmt::format("{} with seed {} again", generated.family, generated.seed));
    }
    scenarios.generated.push_back(generated);
  }
  if (scenarios.files.empty() && scenarios.generated.empty()) value.fail(expected);
  return scenarios;
}

}  // namespace bqsa::harness
