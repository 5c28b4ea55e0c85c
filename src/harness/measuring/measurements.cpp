#include "harness/measuring/measurements.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>

#include "harness/measuring/benchmark_file.hpp"
#include "harness/measuring/run_sweep.hpp"
#include "harness/results/record_value.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "bqsa-measurements/1";
constexpr const char* kPaperEnd = "/paper";
constexpr double kNanosecond = 1e-9;

std::string host_name() {
  constexpr std::size_t kLongest = 256;
  std::string name(kLongest, '\0');
  if (gethostname(name.data(), name.size() - 1) != 0) return "unknown";
  return name.c_str();
}

Json context_json(const MeasurementOrigin& origin, std::size_t processes) {
  const BuildInfo& build = origin.build;
  const MachineState& machine = origin.before;
  Json libraries = Json::object();
  for (const auto& [name, version] : build.libraries) libraries[name] = version;
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
      {"bqsa",
       {{"schema", kSchema},
        {"publishable", origin.against.empty()},
        {"against", origin.against},
        {"effort", origin.effort},
        {"processes", processes},
        {"load_after", origin.load_after},
        {"version", build.version},
        {"commit", build.commit},
        {"dirty", build.dirty},
        {"compiler", build.compiler},
        {"build_type", build.build_type},
        {"flags", build.flags},
        {"assertions", build.assertions},
        {"sanitizers", build.sanitizers},
        {"libraries", libraries},
        {"processor", machine.processor},
        {"governor", machine.governor},
        {"os", machine.os},
        {"command_line", origin.command_line}}}};
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

MeasurementOrigin read_origin(const RecordValue& context) {
  if (!context.has("bqsa")) {
    context.refuse("expected what bqsa-bench measure writes, got the times of another program");
  }
  const RecordValue bqsa = context["bqsa"];
  if (const std::string schema = bqsa["schema"].text(); schema != kSchema) {
    bqsa["schema"].refuse(fmt::format("expected {}, got {}", kSchema, excerpt(schema)));
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
                           .load_after = bqsa["load_after"].number(),
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

}  // namespace

std::vector<std::string> reasons_against_measuring(const BuildInfo& build,
                                                   const MachineState& before,
                                                   const MachineState& after) {
  MachineState idle = before;
  idle.load = 0;  // judged more strictly below
  std::vector<std::string> reasons = reasons_against_times(build, idle);
  constexpr double kOurOwn = 1;
  if (before.load > kMostLoadPerCore * before.cores) {
    reasons.push_back(
        fmt::format("load average {:.2g} on {} cores before measuring", before.load, before.cores));
  }
  if (after.load > kMostLoadPerCore * after.cores + kOurOwn) {
    reasons.push_back(
        fmt::format("load average {:.2g} on {} cores after measuring", after.load, after.cores));
  }
  return reasons;
}

const Sweep* Measurements::find(std::string_view name) const {
  const auto found = std::find_if(sweeps.begin(), sweeps.end(),
                                  [&](const Sweep& sweep) { return sweep.name == name; });
  return found == sweeps.end() ? nullptr : &*found;
}

std::vector<Sweep> pool(const std::vector<std::vector<Sweep>>& processes) {
  std::vector<Sweep> pooled = processes.front();
  for (std::size_t p = 1; p < processes.size(); ++p) {
    const auto refuse = [p](const std::string& what) {
      throw std::runtime_error(
          fmt::format("process {} measured other {} than the first", p + 1, what));
    };
    if (processes[p].size() != pooled.size()) refuse("sweeps");
    for (std::size_t i = 0; i < pooled.size(); ++i) {
      const Sweep& added = processes[p][i];
      if (added.name != pooled[i].name) refuse("sweeps");
      if (added.sizes != pooled[i].sizes) refuse("sizes of " + added.name);
      if (added.series.size() != pooled[i].series.size()) refuse("series of " + added.name);
      for (std::size_t c = 0; c < added.series.size(); ++c) {
        Series& series = pooled[i].series[c];
        if (added.series[c].name != series.name) refuse("series of " + added.name);
        for (std::size_t s = 0; s < added.sizes.size(); ++s) {
          const std::vector<double>& more = added.series[c].seconds[s];
          series.seconds[s].insert(series.seconds[s].end(), more.begin(), more.end());
        }
      }
    }
  }
  return pooled;
}

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

Measurements read_measurements(const std::filesystem::path& file) {
  const nlohmann::json json = read_json(file);
  try {
    const RecordValue record(json, "", "measurements");
    Measurements measurements{.origin = read_origin(record["context"]), .sweeps = {}};
    for (const RecordValue& entry : record["benchmarks"].list()) {
      read_entry(entry, measurements.sweeps);
    }
    for (Sweep& sweep : measurements.sweeps) put_in_order(sweep);
    return measurements;
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

std::string indicative_note(const std::vector<std::string>& against) {
  if (against.empty()) return "";
  return fmt::format("! times are only indicative: {}\n", fmt::join(against, ", "));
}

}  // namespace bqsa::harness
