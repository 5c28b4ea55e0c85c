#include "harness/campaign/generated_scenarios.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <system_error>

#include "harness/generator/generator.hpp"
#include "harness/pipe.hpp"
#include "harness/sha256.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMaxScenarioBytes = std::size_t{1} << 20;
constexpr std::size_t kMaxListBytes = std::size_t{1} << 25;
constexpr std::size_t kHashDigits = 64;

/// So many scenarios have every arm of a family once: of those of two kinds of arms, every other is planar.
int count_of_all_arms(const Family& family, const std::vector<Arm>& arms) {
  const int spatial = std::max(static_cast<int>(arms.size()), 1);
  return family.planar ? 2 * spatial : spatial;
}

/// Hashes by file name, from lines as `sha256sum` prints them; empty if there is no list.
std::map<std::string, std::string> read_hashes(const fs::path& list) {
  std::map<std::string, std::string> hashes;
  std::error_code unknown;
  if (!fs::exists(list, unknown)) return hashes;
  std::istringstream lines(read_text_file(list, kMaxListBytes));
  for (std::string line; std::getline(lines, line);) {
    if (line.size() <= kHashDigits + 2) continue;
    hashes[line.substr(kHashDigits + 2)] = line.substr(0, kHashDigits);
  }
  return hashes;
}

std::string list_text(const std::vector<PlannedScenario>& scenarios) {
  std::string text;
  for (const PlannedScenario& scenario : scenarios) {
    text += fmt::format("{}  {}\n", scenario.sha256, scenario.file.filename().string());
  }
  return text;
}

/// Whether the file is there and was made before.
bool was_made(const fs::path& file, const std::map<std::string, std::string>& hashes) {
  std::error_code unknown;
  const auto hash = hashes.find(file.filename().string());
  if (hash == hashes.end() || !fs::exists(file, unknown)) return false;
  const std::string found = sha256_of(read_text_file(file, kMaxScenarioBytes));
  if (found == hash->second) return true;
  throw InputError(fmt::format("{}: expected the scenario that was generated, sha256 {}, got {}",
                               file.string(), hash->second, found));
}

/// What was written there outlasts the machine's end before something is made of it.
void sync_files_of(const fs::path& directory) {
  const Descriptor opened(open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  syncfs(opened.number());
}

}  // namespace

std::vector<PlannedScenario> generate_scenarios(const GeneratedScenarios& wanted,
                                                const fs::path& directory,
                                                const std::function<void()>& made) {
  const Family& family = *find_family(wanted.family);
  const std::vector<Arm> arms = arms_of(family, wanted.robots);
  std::error_code error;
  fs::create_directories(directory, error);
  if (!fs::is_directory(directory)) {
    throw InputError(
        fmt::format("{}: expected a directory that can be made, got one that cannot ({})",
                    directory.string(), error.message()));
  }
  const fs::path list = directory / fmt::format("{}_s{}.sha256", family.name, wanted.seed);
  const std::map<std::string, std::string> hashes = read_hashes(list);
  const int made_again = count_of_all_arms(family, arms);
  std::vector<PlannedScenario> scenarios;
  Rejections rejections;
  for (int index = 0; index < wanted.count; ++index) {
    const std::string name = generated_name(family, wanted.seed, index);
    const fs::path file = directory / (name + ".yaml");
    if (index >= made_again && was_made(file, hashes)) {
      scenarios.push_back({file, name, hashes.at(file.filename().string())});
    } else {
      const std::string text = generate(family, wanted.seed, index, arms, rejections).yaml;
      write_new_text_file(file, text);
      scenarios.push_back({file, name, sha256_of(text)});
    }
    made();
  }
  if (scenarios.size() > hashes.size()) {
    sync_files_of(directory);
    write_text_file(list, list_text(scenarios));
  }
  return scenarios;
}

}  // namespace bqsa::harness
