#include "harness/exchange/exported_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "harness/results/record_files.hpp"
#include "harness/results/result_store.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

struct OriginColumn {
  const char* name;  ///< no keyword of SQL
  const char* key;   ///< below `provenance`
};

constexpr std::array kOriginColumns{
    OriginColumn{"version", "version"},
    OriginColumn{"source_commit", "commit"},
    OriginColumn{"modified", "dirty"},
    OriginColumn{"compiler", "compiler"},
    OriginColumn{"build_type", "build_type"},
    OriginColumn{"compiler_flags", "flags"},
    OriginColumn{"assertions", "assertions"},
    OriginColumn{"sanitizers", "sanitizers"},
    OriginColumn{"libraries", "libraries"},
    OriginColumn{"processor", "processor"},
    OriginColumn{"cores", "cores"},
    OriginColumn{"governor", "governor"},
    OriginColumn{"os", "os"},
    OriginColumn{"host", "host"},
    OriginColumn{"jobs", "jobs"},
    OriginColumn{"isolated", "isolated"},
    OriginColumn{"wall_limit_s", "wall_limit_s"},
    OriginColumn{"memory_limit_bytes", "memory_limit_bytes"},
    OriginColumn{"plan_budget_s", "plan_budget_s"},
    OriginColumn{"command_line", "command_line"},
    OriginColumn{"out_of_tree", "out_of_tree"},
    OriginColumn{"external_command", "external"},
};

constexpr auto kOriginNames = [] {
  std::array<const char*, kOriginColumns.size()> names{};
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kOriginColumns[i].name;
  return names;
}();

/// Whole numbers that SQL has no place for become real ones.
Cell scalar_cell(const nlohmann::json& json) {
  if (json.is_boolean()) return json.get<bool>();
  constexpr std::uint64_t kLargest = std::numeric_limits<std::int64_t>::max();
  if (json.is_number_unsigned() && json.get<std::uint64_t>() > kLargest) return json.get<double>();
  if (json.is_number_integer()) return json.get<std::int64_t>();
  if (json.is_number()) return json.get<double>();
  if (json.is_string()) return printable(json.get_ref<const std::string&>());
  return {};
}

/// `Eigen 3.4.0, FCL 0.7.0` of an object, `a, b` of a list.
Cell origin_cell(const nlohmann::json& json) {
  if (!json.is_structured()) return scalar_cell(json);
  std::string text;
  for (const auto& [key, value] : json.items()) {
    const std::string entry =
        value.is_string() ? printable(value.get_ref<const std::string&>()) : value.dump();
    text += text.empty() ? "" : ", ";
    text += json.is_object() ? printable(key) + " " + entry : entry;
  }
  return text;
}

Origin read_origin(const nlohmann::json& provenance) {
  Origin origin;
  for (const OriginColumn& column : kOriginColumns) {
    const auto found = provenance.find(column.key);
    origin.values.push_back(found == provenance.end() ? Cell() : origin_cell(*found));
  }
  return origin;
}

std::vector<std::string> texts(const RecordValue& list) {
  std::vector<std::string> all;
  for (const RecordValue& value : list.list()) all.push_back(value.text());
  return all;
}

std::string optional_text(const RecordValue& object, const char* key) {
  return object.has(key) && !object[key].is_null() ? object[key].text() : "";
}

double optional_number(const RecordValue& object, const char* key) {
  return object.has(key) ? object[key].number() : std::numeric_limits<double>::quiet_NaN();
}

double finite(const RecordValue& value) {
  const double number = value.number();
  if (!std::isfinite(number)) value.refuse("expected a number");
  return number;
}

ExportedScenario read_scenario(const RecordValue& record) {
  const RecordValue problem = record["problem"];
  return {.name = record["scenario"]["name"].text(),
          .sha256 = record["scenario"]["sha256"].text(),
          .file = record["scenario"]["file"].text(),
          .dimension = problem["dimension"].integer(),
          .joints = problem["joints"].integer(),
          .links = problem["links"].integer(),
          .obstacles = texts(problem["obstacles"]),
          .nk = problem["nk"].integer(),
          .ticks = problem["ticks"].integer(),
          .dt_s = finite(problem["dt_s"]),
          .tolerance_m = finite(problem["tolerance_m"]),
          .margin_m = finite(problem["margin_m"]),
          .link_radius_m = finite(problem["link_radius_m"])};
}

/// @param json  of the record's method
ExportedMethod read_method(const RecordValue& method, const nlohmann::json& json) {
  ExportedMethod read{.name = method["name"].text(),
                      .variant = method["variant"].text(),
                      .changed = method["changed"].text(),
                      .parameters = {}};
  for (const auto& [name, value] : method["parameters"].members()) {
    read.parameters.push_back({name, {}});
  }
  std::size_t i = 0;
  for (const auto& value : json["parameters"]) {
    read.parameters[i++].value = scalar_cell(value);
  }
  return read;
}

std::vector<ExportedContact> read_contacts(const RecordValue& list) {
  std::vector<ExportedContact> contacts;
  for (const RecordValue& contact : list.list()) {
    contacts.push_back({.link = contact["link"].integer(),
                        .obstacle = optional_text(contact, "obstacle"),
                        .first_tick = contact["first_tick"].integer(),
                        .at_tick = contact["at_tick"].boolean(),
                        .ticks = contact["ticks"].integer()});
  }
  return contacts;
}

ExportedRun read_run(const RecordValue& record, const TableRow& row) {
  const RecordValue provenance = record["provenance"];
  ExportedRun run;
  run.figures = read_figures(record, row);
  if (record.has("counters")) {
    for (const auto& [name, value] : record["counters"].members()) {
      run.counters.emplace_back(name, value.whole());
    }
  }
  run.failures = row.failures;
  run.contacts = read_contacts(record["judged"]["contacts"]);
  run.claim_obstacle = optional_text(record["claimed"], "obstacle");
  run.claim_message = optional_text(record["claimed"], "message");
  run.disagreement = row.disagreement;
  run.trajectory = optional_text(record, "trajectory");
  run.seed = provenance.has("seed") ? std::to_string(provenance["seed"].whole()) : "";
  run.date = provenance["date"].text();
  run.load_average = optional_number(provenance, "load_average");
  if (provenance.has("restarts")) run.restarts = provenance["restarts"].integer();
  run.against = texts(record["times"]["against"]);
  run.total_s = std::isfinite(row.run_s) ? row.run_s : 0;
  return run;
}

bool is_of_campaign(const RecordValue& record) {
  return record.has("campaign") && !record["campaign"].is_null();
}

/// Collects what the records hold until it is known which of them count.
class Collection {
 public:
  explicit Collection(const std::optional<std::vector<std::string>>& planned)
      : has_plan_(planned.has_value()) {
    if (!planned) return;
    for (std::size_t i = 0; i < planned->size(); ++i) places_in_plan_.try_emplace((*planned)[i], i);
  }

  /// @param place  file and line
  void add(const std::string& text, const std::string& place) {
    const TableRow row = parse_run_record(text);
    const auto json = nlohmann::json::parse(text);
    const RecordValue record(json);
    Entry entry = read_entry(record, json, row);
    const auto planned = places_in_plan_.find(entry.key);
    if (has_plan_ && planned == places_in_plan_.end()) {
      ++read_.stale;
      return;
    }
    entry.place = has_plan_ ? planned->second : entries_.size();
    if (entry.run) {
      entry.run->record = place;
      entry.run->origin = intern(read_origin(json["provenance"]), read_.origins);
      entry.run->campaign = entry.campaign;
      entry.run->key = entry.key;
    }
    keep(std::move(entry));
  }

  void add_bad_line(std::string message) { read_.bad_lines.push_back(std::move(message)); }

  ExportedRuns result() {
    std::stable_sort(entries_.begin(), entries_.end(),
                     [](const Entry& a, const Entry& b) { return a.place < b.place; });
    for (Entry& entry : entries_) {
      if (!entry.run) {
        ++read_.not_applicable;
        continue;
      }
      const std::string& file = entry.run->trajectory;
      if (!file.empty() && trajectory_owners_.at(file) != entry.run->record) {
        entry.run->trajectory.clear();
      }
      ++read_.runs;
      configuration_of(entry).runs.push_back(std::move(*entry.run));
    }
    return std::move(read_);
  }

 private:
  struct Entry {
    std::size_t place = 0;
    std::string campaign, key;
    int repetition = 1;
    std::string seed;  ///< of a planning method
    std::size_t scenario = 0;
    std::size_t method = 0;
    std::optional<ExportedRun> run = {};  ///< of a pair that fits
  };

  /// Index of a value among those that are known, of which it is one from now on.
  static std::size_t intern(Origin value, std::vector<Origin>& known) {
    const auto found = std::find(known.rbegin(), known.rend(), value);
    if (found != known.rend()) return static_cast<std::size_t>(known.rend() - found) - 1;
    known.push_back(std::move(value));
    return known.size() - 1;
  }

  Entry read_entry(const RecordValue& record, const nlohmann::json& json, const TableRow& row) {
    Entry entry;
    if (is_of_campaign(record)) {
      entry.campaign = record["campaign"]["name"].text();
      entry.key = record["campaign"]["key"].text();
      entry.repetition = record["campaign"]["repetition"].integer();
    }
    entry.seed = row.seed;
    if (row.applicable) entry.run = read_run(record, row);
    ExportedMethod method = read_method(record["method"], json["method"]);
    const auto [known_method, new_method] = method_places_.try_emplace(
        fmt::format("{}\n{}", method.variant, fmt::join(method.settings(), "\n")), methods_.size());
    if (new_method) methods_.push_back(std::move(method));
    entry.method = known_method->second;
    ExportedScenario scenario = read_scenario(record);
    const auto [known, is_new] =
        scenario_places_.try_emplace({scenario.name, scenario.sha256}, scenarios_.size());
    if (is_new) scenarios_.push_back(std::move(scenario));
    entry.scenario = known->second;
    return entry;
  }

  void keep(Entry entry) {
    if (entry.run && !entry.run->trajectory.empty()) {
      trajectory_owners_[entry.run->trajectory] = entry.run->record;
    }
    const auto [first, is_new] = places_.try_emplace(
        {entry.scenario, methods_[entry.method].variant, entry.seed, entry.key, entry.repetition},
        entries_.size());
    if (is_new) {
      entries_.push_back(std::move(entry));
      return;
    }
    ++read_.superseded;
    entry.place = entries_[first->second].place;
    entries_[first->second] = std::move(entry);
  }

  ExportedConfiguration& configuration_of(const Entry& entry) {
    const auto [experiment, new_experiment] =
        experiment_places_.try_emplace(entry.scenario, read_.experiments.size());
    if (new_experiment) read_.experiments.push_back({scenarios_[entry.scenario], {}});
    std::vector<ExportedConfiguration>& all = read_.experiments[experiment->second].configurations;
    const auto [place, is_new] =
        configuration_places_.try_emplace({entry.scenario, entry.method}, all.size());
    if (is_new) all.push_back({methods_[entry.method], {}});
    return all[place->second];
  }

  bool has_plan_;
  std::map<std::string, std::size_t> places_in_plan_;
  ExportedRuns read_;
  std::vector<Entry> entries_;
  std::vector<ExportedScenario> scenarios_;
  std::vector<ExportedMethod> methods_;
  std::map<std::string, std::size_t> method_places_;
  std::map<std::pair<std::string, std::string>, std::size_t> scenario_places_;
  std::map<std::tuple<std::size_t, std::string, std::string, std::string, int>, std::size_t>
      places_;
  std::map<std::size_t, std::size_t> experiment_places_;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> configuration_places_;
  std::map<std::string, std::string> trajectory_owners_;  ///< by file: the last record that has it
};

}  // namespace

std::span<const char* const> Origin::columns() { return kOriginNames; }

const Cell& Origin::operator[](std::string_view column) const {
  const auto found = std::find(kOriginNames.begin(), kOriginNames.end(), column);
  assert(found != kOriginNames.end());
  return values[static_cast<std::size_t>(found - kOriginNames.begin())];
}

std::string Origin::text(std::string_view column) const {
  const auto* text = std::get_if<std::string>(&(*this)[column]);
  return text != nullptr ? *text : "unknown";
}

double Origin::number(std::string_view column) const {
  const Cell& cell = (*this)[column];
  if (const auto* real = std::get_if<double>(&cell)) return *real;
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*whole);
  return 0;
}

const Figure& ExportedRun::figure(std::string_view column) const {
  const auto columns = run_columns();
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [column](const RunColumn& c) { return column == c.name; });
  assert(found != columns.end());
  return figures[static_cast<std::size_t>(found - columns.begin())];
}

std::vector<std::string> ExportedMethod::settings() const {
  std::vector<std::string> lines{"method = " + name};
  for (const ExportedParameter& parameter : parameters) {
    lines.push_back(parameter.name + " = " + cell_text(parameter.value));
  }
  return lines;
}

ExportedRuns read_exported_runs(const std::filesystem::path& directory,
                                const std::optional<std::vector<std::string>>& planned) {
  Collection collection(planned);
  for (const std::filesystem::path& file : required_record_files(directory)) {
    const std::string name = file.lexically_relative(directory).generic_string();
    for_each_line(file, [&](const StoredLine& line) {
      try {
        collection.add(line.text, fmt::format("{}:{}", name, line.number));
      } catch (const InputError& error) {
        collection.add_bad_line(fmt::format("{}:{}: {}", file.string(), line.number, error.what()));
      }
    });
  }
  return collection.result();
}

}  // namespace bqsa::harness
