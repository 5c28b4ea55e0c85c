#include "harness/exchange/exported_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "harness/exchange/record_parts.hpp"
#include "harness/results/record_files.hpp"
#include "harness/results/result_store.hpp"

namespace bqsa::harness {
namespace {

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
    Origin origin = read_origin(json["provenance"]);
    if (!entry.run) {
      entry.misfit.record = place;
      entry.misfit.origin = intern(std::move(origin), read_.misfit_origins);
    } else {
      entry.run->record = place;
      entry.run->origin = intern(std::move(origin), read_.origins);
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
        entry.misfit.scenario = scenarios_[entry.scenario];
        entry.misfit.method = methods_[entry.method];
        read_.misfits.push_back(std::move(entry.misfit));
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
    ExportedMisfit misfit = {};           ///< of one that does not
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
    if (row.applicable) {
      entry.run = read_run(record, row);
    } else {
      entry.misfit.row = row;
      entry.misfit.date = record["provenance"]["date"].text();
    }
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
