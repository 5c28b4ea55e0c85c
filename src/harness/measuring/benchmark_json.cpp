#include "harness/measuring/benchmark_json.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "harness/measuring/measurements_schema.hpp"
#include "harness/statistics/estimates.hpp"

namespace bqsa::harness {
namespace {

using Json = BenchmarkJson::Json;

/// What all entries of a benchmark have in common.
Json entry_head(const std::string& name, const std::string& run_name, const char* run_type,
                std::size_t repetitions) {
  return {{"name", name},         {"family_index", 0},    {"per_family_instance_index", 0},
          {"run_name", run_name}, {"run_type", run_type}, {"repetitions", repetitions},
          {"threads", 1}};
}

void add_times(Json& entry, std::int64_t iterations, double seconds, const Json& further) {
  entry["iterations"] = iterations;
  entry["real_time"] = seconds / kNanosecond;
  entry["cpu_time"] = seconds / kNanosecond;
  entry["time_unit"] = "ns";
  entry.update(further);
}

struct Aggregate {
  const char* name;
  double seconds;
};

std::vector<Aggregate> aggregates(std::span<const double> times) {
  const auto n = static_cast<double>(times.size());
  const double mean = std::accumulate(times.begin(), times.end(), 0.0) / n;
  double squares = 0;
  for (const double time : times) squares += (time - mean) * (time - mean);
  const double deviation = times.size() < 2 ? 0 : std::sqrt(squares / (n - 1));
  std::vector<double> sorted(times.begin(), times.end());
  std::sort(sorted.begin(), sorted.end());
  return {{"mean", mean}, {"median", median_of(sorted)}, {"stddev", deviation}};
}

}  // namespace

BenchmarkJson::BenchmarkJson(const MachineState& machine, const std::string& host, bool assertions,
                             const Json& ours)
    : context_({{"date", machine.date},
                {"host_name", host},
                {"executable", "bqsa-bench"},
                {"num_cpus", machine.cores},
                {"mhz_per_cpu", machine.mhz},
                {"cpu_scaling_enabled",
                 machine.governor != "performance" && machine.governor != "unknown"},
                {"caches", Json::array()},
                {"load_avg", Json::array({machine.load})},
                {"library_build_type", assertions ? "debug" : "release"},
                {"bqsa", ours}}) {}

void BenchmarkJson::add_repetition(const std::string& name, std::size_t index,
                                   std::size_t repetitions, std::int64_t iterations, double seconds,
                                   const Json& further) {
  Json entry = entry_head(name, name, "iteration", repetitions);
  entry["repetition_index"] = index;
  add_times(entry, iterations, seconds, further);
  entries_.push_back(std::move(entry));
}

void BenchmarkJson::add_aggregates(const std::string& name, std::span<const double> seconds,
                                   const Json& further) {
  assert(!seconds.empty());
  for (const Aggregate& aggregate : aggregates(seconds)) {
    Json entry = entry_head(name + "_" + aggregate.name, name, "aggregate", seconds.size());
    entry["aggregate_name"] = aggregate.name;
    entry["aggregate_unit"] = "time";
    add_times(entry, static_cast<std::int64_t>(seconds.size()), aggregate.seconds, further);
    entries_.push_back(std::move(entry));
  }
}

std::string BenchmarkJson::text() const {
  std::string text = "{\n\"context\": " + context_.dump(2) + ",\n\"benchmarks\": [\n";
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    text += entries_[i].dump() + (i + 1 < entries_.size() ? ",\n" : "\n");
  }
  return text + "]\n}\n";
}

}  // namespace bqsa::harness
