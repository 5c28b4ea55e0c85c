#include "harness/report/scenario_finder.hpp"

#include <fmt/format.h>

#include <system_error>

#include "harness/results/record_value.hpp"

namespace bqsa::harness::report {
namespace fs = std::filesystem;
namespace {

/// A path without its first parts, one fewer each time; without any that leads upwards.
std::vector<fs::path> ends_of(const fs::path& file) {
  std::vector<fs::path> ends;
  fs::path end;
  const fs::path path = file.relative_path().lexically_normal();
  std::vector<fs::path> parts(path.begin(), path.end());
  for (std::size_t i = parts.size(); i-- > 0 && parts[i] != "..";) {
    end = end.empty() ? parts[i] : parts[i] / end;
    ends.insert(ends.begin(), end);
  }
  return ends;
}

bool is_file(const fs::path& file) {
  std::error_code none;
  return fs::is_regular_file(file, none);
}

}  // namespace

FoundScenario ScenarioFinder::find(const ExportedScenario& recorded) const {
  const fs::path file(recorded.file);
  std::vector<fs::path> places{file};
  for (const fs::path& root : roots_) {
    for (const fs::path& end : ends_of(file)) places.push_back(root / end);
  }
  std::string why;
  for (const fs::path& place : places) {
    if (!is_file(place)) continue;
    try {
      Scenario scenario = load_scenario(place, options_);
      if (scenario.sha256 == recorded.sha256) return {std::move(scenario), ""};
      if (why.empty()) {
        why = fmt::format("{} has changed since it was run (sha256 {}, then {})",
                          printable(place.string()), scenario.sha256.substr(0, 12),
                          recorded.sha256.substr(0, 12));
      }
    } catch (const InputError& error) {
      if (why.empty()) why = fmt::format("cannot be read: {}", printable(error.what()));
    }
  }
  if (why.empty()) why = fmt::format("{} is not there", printable(recorded.file));
  return {std::nullopt, why};
}

}  // namespace bqsa::harness::report
