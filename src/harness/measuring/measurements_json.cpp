#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "harness/measuring/benchmark_json.hpp"
#include "harness/measuring/measurements.hpp"
#include "harness/measuring/measurements_schema.hpp"
#include "harness/measuring/run_sweep.hpp"
#include "harness/results/provenance_json.hpp"

namespace bqsa::harness {
namespace {

using Json = nlohmann::ordered_json;

Json ours_json(const MeasurementOrigin& origin, std::size_t processes) {
  Json ours = {{"schema", kMeasurementsSchema},
               {"publishable", origin.against.empty()},
               {"against", origin.against},
               {"effort", origin.effort},
               {"processes", processes},
               {"other_cores", origin.other_cores},
               {"instruction_set", origin.instruction_set},
               {"command_line", origin.command_line}};
  ours.update(build_json(origin.build));
  ours.update(machine_json(origin.before));
  return ours;
}

/// `plane_nm/test_points/NM:600/nk:27`; steps have no test points in common.
std::string benchmark_name(const Sweep& sweep, const Series& series, std::size_t size) {
  const WorkloadSize& at = sweep.sizes[size];
  const std::string points = is_of_steps(sweep.name) ? "" : fmt::format("NM:{}/", at.point_pairs());
  return fmt::format("{}/{}/{}nk:{}", sweep.name, series.name, points, at.pairs());
}

Json size_json(const WorkloadSize& size) {
  return {{"dimension", size.dimension},
          {"n", size.links},
          {"k", size.obstacles},
          {"N", size.test_points.link},
          {"M", size.test_points.obstacle}};
}

void add_entries(const Sweep& sweep, const Series& series, std::size_t size, BenchmarkJson& json) {
  const std::string name = benchmark_name(sweep, series, size);
  const Json further = size_json(sweep.sizes[size]);
  const std::vector<double>& times = series.seconds[size];
  for (std::size_t process = 0; process < times.size(); ++process) {
    json.add_repetition(name, process, times.size(), 1, times[process], further);
  }
  json.add_aggregates(name, times, further);
}

void add_paper_entry(const Sweep& sweep, const Series& series, std::size_t size,
                     BenchmarkJson& json) {
  if (series.paper_seconds.empty() || std::isnan(series.paper_seconds[size])) return;
  json.add_repetition(benchmark_name(sweep, series, size) + kPaperEnd, 0, 1,
                      series.paper_passes[size], series.paper_seconds[size],
                      size_json(sweep.sizes[size]));
}

std::size_t processes_in(const std::vector<Sweep>& sweeps) {
  std::size_t most = 0;
  for (const Sweep& sweep : sweeps) {
    for (const Series& series : sweep.series) {
      for (const auto& times : series.seconds) most = std::max(most, times.size());
    }
  }
  return most;
}

}  // namespace

std::string measurements_json(const Measurements& measurements) {
  const MeasurementOrigin& origin = measurements.origin;
  BenchmarkJson json(origin.before, host_name(), origin.build.assertions,
                     ours_json(origin, processes_in(measurements.sweeps)));
  for (const Sweep& sweep : measurements.sweeps) {
    for (const Series& series : sweep.series) {
      for (std::size_t s = 0; s < sweep.sizes.size(); ++s) {
        if (!series.measured(s)) continue;
        add_entries(sweep, series, s, json);
        add_paper_entry(sweep, series, s, json);
      }
    }
  }
  return json.text();
}

}  // namespace bqsa::harness
