#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "harness/measuring/measurements.hpp"
#include "harness/measuring/measurements_schema.hpp"
#include "harness/measuring/run_sweep.hpp"
#include "harness/results/provenance_json.hpp"

namespace bqsa::harness {
namespace {

using Json = nlohmann::ordered_json;

std::string host_name() {
  constexpr std::size_t kLongest = 256;
  std::string name(kLongest, '\0');
  if (gethostname(name.data(), name.size() - 1) != 0) return "unknown";
  return name.c_str();
}

Json context_json(const MeasurementOrigin& origin, std::size_t processes) {
  const BuildInfo& build = origin.build;
  const MachineState& machine = origin.before;
  Json ours = {{"schema", kMeasurementsSchema},
               {"publishable", origin.against.empty()},
               {"against", origin.against},
               {"effort", origin.effort},
               {"processes", processes},
               {"other_cores", origin.other_cores},
               {"instruction_set", origin.instruction_set},
               {"command_line", origin.command_line}};
  ours.update(build_json(build));
  ours.update(machine_json(machine));
  return {
      {"date", machine.date},
      {"host_name", host_name()},
      {"executable", "bqsa-bench"},
      {"num_cpus", machine.cores},
      {"mhz_per_cpu", machine.mhz},
      {"cpu_scaling_enabled", machine.governor != "performance" && machine.governor != "unknown"},
      {"caches", Json::array()},
      {"load_avg", Json::array({machine.load})},
      {"library_build_type", build.assertions ? "debug" : "release"},
      {"bqsa", ours}};
}

/// `plane_nm/test_points/NM:600/nk:27`; steps have no test points in common.
std::string benchmark_name(const Sweep& sweep, const Series& series, std::size_t size) {
  const WorkloadSize& at = sweep.sizes[size];
  const std::string points = is_of_steps(sweep.name) ? "" : fmt::format("NM:{}/", at.point_pairs());
  return fmt::format("{}/{}/{}nk:{}", sweep.name, series.name, points, at.pairs());
}

/// What all entries of a contestant at a size have in common.
Json entry_head(const std::string& name, const std::string& run_name, const char* run_type,
                std::size_t repetitions) {
  return {{"name", name},         {"family_index", 0},    {"per_family_instance_index", 0},
          {"run_name", run_name}, {"run_type", run_type}, {"repetitions", repetitions},
          {"threads", 1}};
}

void add_times(Json& entry, std::int64_t iterations, double seconds, const WorkloadSize& size) {
  entry["iterations"] = iterations;
  entry["real_time"] = seconds / kNanosecond;
  entry["cpu_time"] = seconds / kNanosecond;
  entry["time_unit"] = "ns";
  entry["dimension"] = size.dimension;
  entry["n"] = size.links;
  entry["k"] = size.obstacles;
  entry["N"] = size.test_points.link;
  entry["M"] = size.test_points.obstacle;
}

struct Aggregate {
  const char* name;
  double seconds;
};

std::vector<Aggregate> aggregates(const Series& series, std::size_t size) {
  const std::vector<double>& times = series.seconds[size];
  const auto n = static_cast<double>(times.size());
  const double mean = std::accumulate(times.begin(), times.end(), 0.0) / n;
  double squares = 0;
  for (const double time : times) squares += (time - mean) * (time - mean);
  const double deviation = times.size() < 2 ? 0 : std::sqrt(squares / (n - 1));
  return {{"mean", mean}, {"median", series.median(size)}, {"stddev", deviation}};
}

void add_entries(const Sweep& sweep, const Series& series, std::size_t size,
                 std::vector<Json>& entries) {
  const std::string name = benchmark_name(sweep, series, size);
  const std::vector<double>& times = series.seconds[size];
  for (std::size_t process = 0; process < times.size(); ++process) {
    Json entry = entry_head(name, name, "iteration", times.size());
    entry["repetition_index"] = process;
    add_times(entry, 1, times[process], sweep.sizes[size]);
    entries.push_back(std::move(entry));
  }
  for (const auto& [aggregate, seconds] : aggregates(series, size)) {
    Json entry = entry_head(name + "_" + aggregate, name, "aggregate", times.size());
    entry["aggregate_name"] = aggregate;
    entry["aggregate_unit"] = "time";
    add_times(entry, static_cast<std::int64_t>(times.size()), seconds, sweep.sizes[size]);
    entries.push_back(std::move(entry));
  }
}

void add_paper_entry(const Sweep& sweep, const Series& series, std::size_t size,
                     std::vector<Json>& entries) {
  if (series.paper_seconds.empty() || std::isnan(series.paper_seconds[size])) return;
  const std::string name = benchmark_name(sweep, series, size) + kPaperEnd;
  Json entry = entry_head(name, name, "iteration", 1);
  entry["repetition_index"] = 0;
  add_times(entry, series.paper_passes[size], series.paper_seconds[size], sweep.sizes[size]);
  entries.push_back(std::move(entry));
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
  std::vector<Json> entries;
  for (const Sweep& sweep : measurements.sweeps) {
    for (const Series& series : sweep.series) {
      for (std::size_t s = 0; s < sweep.sizes.size(); ++s) {
        if (!series.measured(s)) continue;
        add_entries(sweep, series, s, entries);
        add_paper_entry(sweep, series, s, entries);
      }
    }
  }
  const Json context = context_json(measurements.origin, processes_in(measurements.sweeps));
  std::string text = "{\n\"context\": " + context.dump(2) + ",\n\"benchmarks\": [\n";
  for (std::size_t i = 0; i < entries.size(); ++i) {
    text += entries[i].dump() + (i + 1 < entries.size() ? ",\n" : "\n");
  }
  return text + "]\n}\n";
}

}  // namespace bqsa::harness
