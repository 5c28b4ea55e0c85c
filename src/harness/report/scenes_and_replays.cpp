#include "harness/report/scenes_and_replays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/report/replay.hpp"
#include "harness/report/replay_choice.hpp"
#include "harness/report/scene.hpp"
#include "harness/results/record_value.hpp"
#include "harness/trajectory_csv.hpp"

namespace bqsa::harness::report {
namespace fs = std::filesystem;
namespace {

/// Scenarios without a replay are drawn as long as there are no more than these.
constexpr std::size_t kMostScenes = 200;

constexpr const char* kTooLarge = "left out, for the page would be too large";

bool leads_outside(const fs::path& file) {
  const fs::path normal = file.lexically_normal();
  return normal.is_absolute() || normal.begin() == normal.end() || *normal.begin() == "..";
}

/// Whether the series has the tip error that was judged; a program that was killed between the two may have
/// left an older trajectory beside a record.
bool is_of(const TableRow& row, const ReplaySeries& series) {
  constexpr double kRounding = 1e-5;  // of positions as floats [m]
  if (!std::isfinite(row.tip_error_at_ticks_m)) return true;
  float largest = 0;
  for (std::size_t tick = 1; tick < series.rows; ++tick) {
    largest = std::max(largest, series.tip_error[tick]);
  }
  return std::abs(largest - row.tip_error_at_ticks_m) <= kRounding * (1 + row.tip_error_at_ticks_m);
}

class Collector {
 public:
  Collector(const RunIndex& index, const fs::path& directory, const ScenarioFinder& finder,
            const PageLimits& limits)
      : index_(index), directory_(directory), finder_(finder), limits_(limits) {
    result_.scenes.resize(index.scenarios.size());
    result_.places.resize(index.runs.size());
    found_.resize(index.scenarios.size());
  }

  ScenesAndReplays collect() {
    say_what_is_not_wanted();
    for (const std::size_t run : wanted_replays(index_.runs)) {
      try {
        result_.places[run] = add_replay(run);
      } catch (const InputError& error) {
        result_.places[run].missing = printable(error.what());
      }
    }
    for (std::size_t scenario = 0; scenario < index_.scenarios.size(); ++scenario) {
      if (!found_[scenario] && (scenes_ >= kMostScenes || bytes_ >= limits_.bytes)) {
        result_.scenes[scenario].missing = kTooLarge;
      } else if (found(scenario).scenario) {
        add_scene(scenario, kMostScenes);
      }
    }
    return std::move(result_);
  }

 private:
  void say_what_is_not_wanted() {
    for (std::size_t i = 0; i < index_.runs.size(); ++i) {
      const ExportedRun* const run = index_.runs[i].run;
      if (run == nullptr) continue;
      result_.places[i].missing = run->trajectory.empty()
                                      ? "its trajectory is not stored, or was that of a later run"
                                      : "another run of this scenario and variant is shown";
    }
  }

  /// Of a scenario, looked for once.
  const FoundScenario& found(std::size_t scenario) {
    std::optional<FoundScenario>& place = found_[scenario];
    if (!place) {
      place = finder_.find(index_.scenarios[scenario]);
      PageScene& scene = result_.scenes[scenario];
      scene.missing = place->missing;
      if (place->scenario) scene.description = printable(place->scenario->description);
    }
    return *place;
  }

  /// @return whether the scene is on the page
  bool add_scene(std::size_t scenario, std::size_t most) {
    PageScene& place = result_.scenes[scenario];
    if (!place.scene.is_null()) return true;
    const Scenario& file = *found(scenario).scenario;
    const std::size_t size = scene_size(file);
    if (scenes_ >= most || bytes_ + size > limits_.bytes) {
      place.missing = kTooLarge;
      return false;
    }
    place.scene = scene_json(file);
    place.missing.clear();
    bytes_ += size;
    ++scenes_;
    return true;
  }

  /// @throws InputError for a trajectory that cannot be read
  ReplayPlace add_replay(std::size_t run) {
    const IndexedRun& indexed = index_.runs[run];
    if (result_.replays.size() >= static_cast<std::size_t>(limits_.replays)) {
      return {.missing = fmt::format("left out: the page has its {} replays (--replays)",
                                     limits_.replays)};
    }
    if (bytes_ >= limits_.bytes) return {.missing = kTooLarge};
    const FoundScenario& file = found(indexed.scenario);
    if (!file.scenario) return {.missing = "no scenario: " + file.missing};
    const Problem& problem = file.scenario->problem;
    const std::size_t size = replay_size(problem);
    if (bytes_ + size > limits_.bytes) return {.missing = kTooLarge};
    if (leads_outside(indexed.run->trajectory)) {
      return {.missing = "its trajectory lies outside of the results directory"};
    }
    const Trajectory trajectory = read_trajectory(directory_ / indexed.run->trajectory,
                                                  static_cast<int>(problem.start.size()));
    const ReplaySeries series = replay_series(problem, file.scenario->truth, trajectory);
    if (!is_of(indexed.row(), series)) {
      return {.missing = "its trajectory is that of another run"};
    }
    if (!add_scene(indexed.scenario, index_.scenarios.size())) {
      return {.missing = "no scene: " + result_.scenes[indexed.scenario].missing};
    }
    result_.replays.push_back(replay_json(series, run));
    bytes_ += size;
    return {.index = result_.replays.size() - 1};
  }

  const RunIndex& index_;
  const fs::path& directory_;
  const ScenarioFinder& finder_;
  const PageLimits& limits_;
  std::vector<std::optional<FoundScenario>> found_;  // by scenario
  std::size_t scenes_ = 0;
  std::size_t bytes_ = 0;
  ScenesAndReplays result_;
};

}  // namespace

ScenesAndReplays scenes_and_replays(const RunIndex& index, const fs::path& directory,
                                    const ScenarioFinder& finder, const PageLimits& limits) {
  return Collector(index, directory, finder, limits).collect();
}

}  // namespace bqsa::harness::report
