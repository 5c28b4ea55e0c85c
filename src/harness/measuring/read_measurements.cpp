#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "harness/measuring/benchmark_file.hpp"
#include "harness/measuring/measurements.hpp"
#include "harness/measuring/measurements_schema.hpp"
#include "harness/results/record_value.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

MeasurementOrigin read_origin(const RecordValue& context) {
  if (!context.has("bqsa")) {
    context.refuse("expected what bqsa-bench measure writes, got the times of another program");
  }
  const RecordValue bqsa = context["bqsa"];
  if (const std::string schema = bqsa["schema"].text(); schema != kMeasurementsSchema) {
    bqsa["schema"].refuse(fmt::format("expected {}, got {}", kMeasurementsSchema, excerpt(schema)));
  }
  MeasurementOrigin origin{.build = {.version = bqsa["version"].text(),
                                     .commit = bqsa["commit"].text(),
                                     .dirty = bqsa["dirty"].boolean(),
                                     .compiler = bqsa["compiler"].text(),
                                     .build_type = bqsa["build_type"].text(),
                                     .flags = bqsa["flags"].text(),
                                     .assertions = bqsa["assertions"].boolean(),
                                     .sanitizers = bqsa["sanitizers"].boolean(),
                                     .libraries = {}},
                           .before = {.processor = bqsa["processor"].text(),
                                      .cores = context["num_cpus"].integer(),
                                      .governor = bqsa["governor"].text(),
                                      .mhz = context["mhz_per_cpu"].number(),
                                      .load = std::numeric_limits<double>::quiet_NaN(),
                                      .os = bqsa["os"].text(),
                                      .date = context["date"].text()},
                           .other_cores = bqsa["other_cores"].number(),
                           .instruction_set = bqsa.has("instruction_set")
                                                  ? bqsa["instruction_set"].text()
                                                  : kUnknownInstructionSet,
                           .effort = bqsa["effort"].text(),
                           .command_line = bqsa["command_line"].text(),
                           .against = {}};
  for (const RecordValue& load : context["load_avg"].list()) origin.before.load = load.number();
  for (const auto& [name, version] : bqsa["libraries"].members()) {
    origin.build.libraries.emplace_back(name, version.text());
  }
  for (const RecordValue& reason : bqsa["against"].list()) origin.against.push_back(reason.text());
  return origin;
}

/// The place of a thing among others, at the end if it is new.
template <typename Thing, typename Same>
Thing& found_or_added(std::vector<Thing>& things, Same same, Thing added) {
  const auto found = std::find_if(things.begin(), things.end(), same);
  return found != things.end() ? *found : things.emplace_back(std::move(added));
}

void read_entry(const RecordValue& entry, std::vector<Sweep>& sweeps) {
  if (entry["run_type"].text() != "iteration") return;
  std::string name = entry["name"].text();
  const bool paper = name.ends_with(kPaperEnd);
  const std::size_t slash = name.find('/');
  const std::size_t next = slash == std::string::npos ? slash : name.find('/', slash + 1);
  if (next == std::string::npos) entry["name"].refuse("expected SWEEP/SERIES/...");
  const std::string sweep_name = name.substr(0, slash);
  const std::string series_name = name.substr(slash + 1, next - slash - 1);
  Sweep& sweep =
      found_or_added(sweeps, [&](const Sweep& one) { return one.name == sweep_name; },
                     {.name = sweep_name, .axis = axis_of(sweep_name), .sizes = {}, .series = {}});
  const WorkloadSize size{
      .dimension = entry["dimension"].integer(),
      .links = entry["n"].integer(),
      .obstacles = entry["k"].integer(),
      .test_points = {.link = entry["N"].integer(), .obstacle = entry["M"].integer()}};
  const WorkloadSize& known = found_or_added(
      sweep.sizes, [&](const WorkloadSize& one) { return one == size; }, WorkloadSize(size));
  const auto s = static_cast<std::size_t>(&known - sweep.sizes.data());
  Series& series =
      found_or_added(sweep.series, [&](const Series& one) { return one.name == series_name; },
                     {.name = series_name, .seconds = {}, .paper_seconds = {}});
  const double seconds = entry["cpu_time"].number() * kNanosecond;
  if (!(seconds > 0) || entry["time_unit"].text() != "ns") {
    entry["cpu_time"].refuse("expected a positive number of ns");
  }
  if (series.seconds.size() <= s) series.seconds.resize(s + 1);
  if (!paper) {
    series.seconds[s].push_back(seconds);
    return;
  }
  if (series.paper_seconds.size() <= s) {
    series.paper_seconds.resize(s + 1, std::numeric_limits<double>::quiet_NaN());
    series.paper_passes.resize(s + 1, 0);
  }
  series.paper_seconds[s] = seconds;
  series.paper_passes[s] = entry["iterations"].integer();
}

/// Sizes in ascending order, and every series with a place for each of them.
void put_in_order(Sweep& sweep) {
  std::vector<std::size_t> order(sweep.sizes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return sweep.at(a) < sweep.at(b); });
  const auto reordered = [&order](const auto& values) {
    std::remove_cvref_t<decltype(values)> sorted;
    for (const std::size_t s : order) sorted.push_back(values[s]);
    return sorted;
  };
  for (Series& series : sweep.series) {
    series.seconds.resize(order.size());
    series.seconds = reordered(series.seconds);
    if (series.paper_seconds.empty()) continue;
    series.paper_seconds.resize(order.size(), std::numeric_limits<double>::quiet_NaN());
    series.paper_passes.resize(order.size(), 0);
    series.paper_seconds = reordered(series.paper_seconds);
    series.paper_passes = reordered(series.paper_passes);
  }
  sweep.sizes = reordered(sweep.sizes);
}

/// Ratios are taken within processes: what was measured has to come from all of them.
void require_all_processes(const Sweep& sweep, std::size_t processes, const RecordValue& entries) {
  for (const Series& series : sweep.series) {
    for (const std::vector<double>& times : series.seconds) {
      if (times.empty() || times.size() == processes) continue;
      entries.refuse(fmt::format("expected times of {} processes at every size of {}/{}, got {}",
                                 processes, sweep.name, series.name, times.size()));
    }
  }
}

}  // namespace

Measurements read_measurements(const std::filesystem::path& file) {
  const nlohmann::json json = read_json(file);
  try {
    const RecordValue record(json, "", "measurements");
    Measurements measurements{.origin = read_origin(record["context"]), .sweeps = {}};
    const RecordValue entries = record["benchmarks"];
    for (const RecordValue& entry : entries.list()) read_entry(entry, measurements.sweeps);
    if (measurements.sweeps.empty()) entries.refuse("expected a benchmark with times");
    const auto processes =
        static_cast<std::size_t>(record["context"]["bqsa"]["processes"].integer());
    for (Sweep& sweep : measurements.sweeps) {
      put_in_order(sweep);
      require_all_processes(sweep, processes, entries);
    }
    return measurements;
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace bqsa::harness
