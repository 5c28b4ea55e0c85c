#include "harness/exchange/runs_benchmark.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "harness/measuring/benchmark_json.hpp"

namespace bqsa::harness {
namespace {

using Json = BenchmarkJson::Json;

constexpr const char* kSchema = "bqsa-runs-benchmark/1";

struct TimedColumn {
  const char* column;
  const char* end;  ///< of the benchmark's name
};
constexpr std::array kTimedColumns{TimedColumn{"warm_median_s", "step_median"},
                                   TimedColumn{"warm_p99_s", "step_p99"},
                                   TimedColumn{"plan_s", "plan"}};

/// All texts that there are of a column, `a, b`.
std::string all_texts(const std::vector<Origin>& origins, const char* column) {
  std::vector<std::string> texts;
  for (const Origin& origin : origins) {
    const std::string text = origin.text(column);
    if (std::find(texts.begin(), texts.end(), text) == texts.end()) texts.push_back(text);
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

bool is_true(const Cell& cell) {
  const auto* truth = std::get_if<bool>(&cell);
  return truth != nullptr && *truth;
}

/// Why the times of the successes are only indicative.
std::vector<std::string> reasons_against(const ExportedRuns& runs) {
  std::set<std::string> reasons;
  for (const ExportedExperiment& experiment : runs.experiments) {
    for (const ExportedConfiguration& configuration : experiment.configurations) {
      for (const ExportedRun& run : configuration.runs) {
        if (run.failures.empty()) reasons.insert(run.against.begin(), run.against.end());
      }
    }
  }
  const std::string processors = all_texts(runs.origins, "processor");
  if (processors != runs.origins.front().text("processor")) {
    reasons.insert(fmt::format("processors: {}", processors));
  }
  return {reasons.begin(), reasons.end()};
}

BenchmarkJson benchmark_json(const ExportedRuns& runs) {
  const Origin& origin = runs.origins.front();
  const ExportedRun& first = runs.experiments.front().configurations.front().runs.front();
  const MachineState machine{.processor = origin.text("processor"),
                             .cores = static_cast<int>(origin.number("cores")),
                             .governor = origin.text("governor"),
                             .mhz = 0,
                             .load = first.load_average,
                             .os = origin.text("os"),
                             .date = first.date};
  const std::vector<std::string> against = reasons_against(runs);
  const Json ours = {{"schema", kSchema},
                     {"publishable", against.empty()},
                     {"against", against},
                     {"version", all_texts(runs.origins, "version")},
                     {"commit", all_texts(runs.origins, "source_commit")},
                     {"compiler", all_texts(runs.origins, "compiler")},
                     {"processor", all_texts(runs.origins, "processor")},
                     {"os", all_texts(runs.origins, "os")}};
  const bool assertions = std::any_of(runs.origins.begin(), runs.origins.end(),
                                      [](const Origin& o) { return is_true(o["assertions"]); });
  return {machine, all_texts(runs.origins, "host"), assertions, ours};
}

void add_benchmarks(const std::string& scenario, const ExportedScenario& sizes,
                    const ExportedConfiguration& configuration, BenchmarkJson& json) {
  const auto successes = std::count_if(configuration.runs.begin(), configuration.runs.end(),
                                       [](const ExportedRun& run) { return run.failures.empty(); });
  const Json further = {{"label", fmt::format("{} of {} runs judged a success", successes,
                                              configuration.runs.size())},
                        {"runs", configuration.runs.size()},
                        {"successes", successes},
                        {"dimension", sizes.dimension},
                        {"n", sizes.links},
                        {"k", sizes.obstacles.size()}};
  for (const TimedColumn& timed : kTimedColumns) {
    std::vector<double> times;
    for (const ExportedRun& run : configuration.runs) {
      const auto* time = std::get_if<double>(&run.figure(timed.column));
      if (time != nullptr) times.push_back(*time);
    }
    if (times.empty()) continue;
    const std::string name =
        fmt::format("{}/{}/{}", scenario, configuration.method.variant, timed.end);
    for (std::size_t i = 0; i < times.size(); ++i) {
      json.add_repetition(name, i, times.size(), 1, times[i], further);
    }
    json.add_aggregates(name, times, further);
  }
}

}  // namespace

std::string runs_benchmark_json(const ExportedRuns& runs) {
  std::map<std::string, int> files_of_name;
  for (const ExportedExperiment& experiment : runs.experiments) {
    ++files_of_name[experiment.scenario.name];
  }
  BenchmarkJson json = benchmark_json(runs);
  for (const ExportedExperiment& experiment : runs.experiments) {
    constexpr std::size_t kDigits = 8;
    std::string name = experiment.scenario.name;
    if (files_of_name[name] > 1) {
      name += fmt::format("@{}", experiment.scenario.sha256.substr(0, kDigits));
    }
    for (const ExportedConfiguration& configuration : experiment.configurations) {
      add_benchmarks(name, experiment.scenario, configuration, json);
    }
  }
  return json.text();
}

}  // namespace bqsa::harness
