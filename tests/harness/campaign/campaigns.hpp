/// @file
/// Methods and scenario files that the campaigns of tests name.
#pragma once

#include <string>
#include <vector>

#include "harness/campaign/campaign_file.hpp"
#include "harness/scenario/scenario_files.hpp"

namespace bqsa::harness {

/// Methods that cannot be made, only named.
inline std::vector<MethodEntry> known_methods() {
  MethodEntry plain;
  plain.name = "plain";
  MethodEntry tuned;
  tuned.name = "tuned";
  tuned.parameters = {{"gain", "1/s", 2, 0, 10, "gain"},
                      integer_parameter("points", "-", 8, 1, 64, "points"),
                      choice_parameter("search", {"fast", "slow"}, "search")};
  MethodEntry planner;
  planner.name = "planner";
  planner.parameters = {{"range", "rad", 0.5, 0, 1, "range"}};
  planner.capabilities.plans = true;
  return {plain, tuned, planner};
}

inline std::string scenario_text(const std::string& name) {
  return "schema: bqsa-scenario/1\nname: " + name +
         R"(
units: {length: m, angle: deg}
robot: {kind: planar, links: [1, 0.8]}
start: [0, 90]
task:
  path: {kind: line, start_point: [1, 0.8], end_point: [0.6, 0.9]}
  timing: {duration: 2, ticks: 20}
)";
}

/// `a.yaml`, `b.yaml`, and in `more` the scenarios `c.yaml` and `d.yaml` beside a file of another kind.
inline void write_scenarios(const TestDirectory& directory) {
  std::filesystem::create_directories(directory.path() / "more");
  std::filesystem::create_directories(directory.path() / "empty");
  for (const char* name : {"a", "b"}) {
    directory.write(std::string(name) + ".yaml", scenario_text(name));
  }
  for (const char* name : {"d", "c"}) {
    directory.write("more/" + std::string(name) + ".yaml", scenario_text(name));
  }
  directory.write("more/notes.txt", "");
}

inline Campaign load(const TestDirectory& directory, const std::string& text) {
  return load_campaign(directory.write("campaign", text), known_methods());
}

}  // namespace bqsa::harness
