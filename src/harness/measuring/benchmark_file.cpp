#include "harness/measuring/benchmark_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "harness/measuring/measurements.hpp"
#include "harness/measuring/measurements_schema.hpp"
#include "harness/results/record_value.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

constexpr std::size_t kMostBytes = std::size_t{256} << 20U;
constexpr const char* kKind = "Google Benchmark's JSON";

/// Google Benchmark writes numbers that JSON does not have, of counters say, as Python reads them. They
/// become null here.
std::string with_null_for_nan(const std::string& text) {
  static constexpr std::array<std::string_view, 3> kNotJson{"NaN", "-Infinity", "Infinity"};
  std::string clean;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view rest = std::string_view(text).substr(i);
    const auto* found = std::find_if(kNotJson.begin(), kNotJson.end(),
                                     [&](std::string_view word) { return rest.starts_with(word); });
    if (!in_string && found != kNotJson.end()) {
      clean += "null";
      i += found->size();
      continue;
    }
    const bool escape = in_string && text[i] == '\\';
    if (text[i] == '"') in_string = !in_string;
    clean += rest.substr(0, escape ? 2 : 1);
    i += escape ? 2 : 1;
  }
  return clean;
}

double seconds_in(const RecordValue& unit) {
  static constexpr std::array<std::pair<std::string_view, double>, 4> kUnits{
      {{"ns", 1e-9}, {"us", 1e-6}, {"ms", 1e-3}, {"s", 1}}};
  const std::string name = unit.text();
  for (const auto& [known, seconds] : kUnits) {
    if (name == known) return seconds;
  }
  unit.refuse(fmt::format("expected ns, us, ms or s, got {}", excerpt(name)));
}

/// What the file says of the processor: ours name it, others count its cores and caches.
std::string machine_text(const RecordValue& context) {
  if (context.has("bqsa")) return context["bqsa"]["processor"].text();
  std::string text = fmt::format("{} cores", context["num_cpus"].integer());
  if (!context.has("caches")) return text;
  for (const RecordValue& cache : context["caches"].list()) {
    text += fmt::format(", L{} {} B", cache["level"].integer(), cache["size"].whole());
  }
  return text;
}

/// Load average before measuring that times of other programs may have.
constexpr double kMostLoadPerCore = 0.5;

/// Ours say it themselves. Of others only the load is known: Debian builds Google Benchmark so that
/// `library_build_type` is always `debug`.
std::vector<std::string> reasons_against(const RecordValue& context) {
  std::vector<std::string> reasons;
  if (context.has("bqsa")) {
    for (const RecordValue& reason : context["bqsa"]["against"].list()) {
      reasons.push_back(reason.text());
    }
  } else if (context.has("load_avg")) {
    const std::vector<RecordValue> loads = context["load_avg"].list();
    const int cores = context["num_cpus"].integer();
    if (!loads.empty() && loads.front().number() > kMostLoadPerCore * cores) {
      reasons.push_back(fmt::format("load average {:.2g} on {} cores before measuring",
                                    loads.front().number(), cores));
    }
  }
  return reasons;
}

BenchmarkFile read(const RecordValue& json) {
  const RecordValue context = json["context"];
  BenchmarkFile file{.benchmarks = {},
                     .machine = machine_text(context),
                     .compiler = context.has("bqsa") ? context["bqsa"]["compiler"].text() : "",
                     .against = reasons_against(context)};
  std::map<std::string, std::size_t> places;
  for (const RecordValue& entry : json["benchmarks"].list()) {
    if (entry.has("error_occurred") && entry["error_occurred"].boolean()) {
      entry.refuse(fmt::format("{} ended with an error", entry["name"].text()));
    }
    if (entry.has("run_type") && entry["run_type"].text() != "iteration") continue;
    const std::string name = entry["name"].text();
    if (context.has("bqsa") && name.ends_with(kPaperEnd)) continue;  // taken once, not to compare
    const double seconds = entry["cpu_time"].number() * seconds_in(entry["time_unit"]);
    if (!(seconds > 0)) entry["cpu_time"].refuse("expected a positive number");
    const auto [place, first] = places.try_emplace(name, file.benchmarks.size());
    if (first) file.benchmarks.push_back({name, {}});
    file.benchmarks[place->second].seconds.push_back(seconds);
  }
  if (file.benchmarks.empty()) json["benchmarks"].refuse("expected a benchmark with times");
  return file;
}

}  // namespace

nlohmann::json read_json(const std::filesystem::path& file) {
  const std::string text = with_null_for_nan(read_text_file(file, kMostBytes));
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    const std::size_t end = std::min(error.byte, text.size());
    const auto line =
        1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
    throw InputError(fmt::format("{}:{}: not JSON, or cut short", file.string(), line));
  }
}

BenchmarkFile read_benchmark_file(const std::filesystem::path& file) {
  const nlohmann::json json = read_json(file);
  try {
    return read(RecordValue(json, "", kKind));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace bqsa::harness
