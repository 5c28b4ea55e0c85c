#include "harness/program/run_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "harness/campaign/plan_file.hpp"
#include "harness/exchange/exported_runs.hpp"
#include "harness/report/replay.hpp"
#include "harness/report/scenario_finder.hpp"
#include "harness/report/sparkline.hpp"
#include "harness/results/table.hpp"
#include "harness/results/text_table.hpp"
#include "harness/trajectory_csv.hpp"

namespace bqsa::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kColumns = 60;
constexpr double kMillimetre = 1e-3;

/// What tells the runs of a table apart.
using RunName = std::tuple<std::string, std::string, std::string, std::string, int>;

RunName name_of(const TableRow& row) {
  return {row.scenario, row.sha256, row.variant, row.seed, row.repetition};
}

/// The value that a curve has at its worst, and where.
struct Worst {
  double value;
  std::size_t tick;
};

/// @return nothing if no value is a number
std::optional<Worst> worst_of(std::span<const float> values, report::Shown shown) {
  std::optional<Worst> worst;
  for (std::size_t tick = 0; tick < values.size(); ++tick) {
    if (!std::isfinite(values[tick])) continue;
    const bool is_worse =
        !worst || (shown == report::Shown::kLargest ? values[tick] > worst->value
                                                    : values[tick] < worst->value);
    if (is_worse) worst = Worst{values[tick], tick};
  }
  return worst;
}

/// A line of a curve, from 0 up to its largest value.
std::string curve(const char* what, std::span<const float> values, report::Shown shown, bool is_bad,
                  bool colour) {
  const std::optional<Worst> worst = worst_of(values, shown);
  if (!worst) return "";
  const std::optional<Worst> top = worst_of(values, report::Shown::kLargest);
  const std::string blocks =
      report::sparkline(values, 0, static_cast<float>(top->value), shown, kColumns);
  return fmt::format("      {:<10}{} {} {} mm at tick {}\n", what,
                     rendered(blocks, is_bad ? kRed : kGreen, colour),
                     shown == report::Shown::kLargest ? "max" : "min",
                     figure(worst->value / kMillimetre), worst->tick);
}

class Curves {
 public:
  Curves(const fs::path& directory, bool colour)
      : directory_(directory), colour_(colour), finder_({directory}, {}) {
    for (const ExportedExperiment& experiment :
         read_exported_runs(directory, planned_keys(directory)).experiments) {
      for (const ExportedConfiguration& configuration : experiment.configurations) {
        for (const ExportedRun& run : configuration.runs) {
          trajectories_[name_of(run.row)] = {run.trajectory, experiment.scenario};
        }
      }
    }
  }

  std::string of(const TableRow& row) {
    const auto found = trajectories_.find(name_of(row));
    if (found == trajectories_.end() || found->second.first.empty()) return "";
    const auto& [trajectory, recorded] = found->second;
    const report::FoundScenario& file = scenario(recorded);
    if (!file.scenario) return "";
    try {
      return lines(row, *file.scenario,
                   read_trajectory(directory_ / trajectory,
                                   static_cast<int>(file.scenario->problem.start.size())));
    } catch (const InputError&) {
      return "";
    }
  }

 private:
  const report::FoundScenario& scenario(const ExportedScenario& recorded) {
    const auto [place, is_new] =
        scenarios_.try_emplace({recorded.name, recorded.sha256}, report::FoundScenario{});
    if (is_new) place->second = finder_.find(recorded);
    return place->second;
  }

  /// The start counts for the clearance, not for the tip error.
  std::string lines(const TableRow& row, const Scenario& scenario,
                    const Trajectory& trajectory) const {
    const report::ReplaySeries series =
        report::replay_series(scenario.problem, scenario.truth, trajectory);
    if (series.rows < 2) return "";
    std::vector<float> errors = series.tip_error;
    errors.front() = 0;
    return curve("tip error", errors, report::Shown::kLargest,
                 row.tip_error_at_ticks_m > scenario.problem.tolerance, colour_) +
           curve("clearance", series.clearance, report::Shown::kSmallest, !row.collided.empty(),
                 colour_);
  }

  fs::path directory_;
  bool colour_;
  report::ScenarioFinder finder_;
  std::map<RunName, std::pair<std::string, ExportedScenario>> trajectories_;
  std::map<std::pair<std::string, std::string>, report::FoundScenario> scenarios_;
};

}  // namespace

std::function<std::string(const TableRow&)> curves_of_runs(const fs::path& directory, bool colour) {
  if (!report::locale_is_utf8()) return {};
  // The records are read again when the first run is asked for, which a summary never does.
  const auto curves = std::make_shared<std::optional<Curves>>();
  return [curves, directory, colour](const TableRow& row) {
    if (!*curves) curves->emplace(directory, colour);
    return (*curves)->of(row);
  };
}

}  // namespace bqsa::harness
