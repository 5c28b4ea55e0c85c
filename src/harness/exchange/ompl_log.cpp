#include "harness/exchange/ompl_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <system_error>

#include "harness/exchange/arena_experiment.hpp"
#include "harness/exchange/sqlite_database.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

namespace fs = std::filesystem;

/// Texts of numbers that SQLite reads back as the same.
class SqliteNumbers {
 public:
  SqliteNumbers() : read_(database_, "SELECT CAST(? AS REAL)") {}

  std::string text(const Cell& cell) {
    const auto* number = std::get_if<double>(&cell);
    if (number == nullptr) return cell_text(cell);
    constexpr int kFewest = 17;  // from which on a reader that rounds well is right
    constexpr int kMost = 20;
    std::string text = cell_text(cell);
    for (int digits = kFewest; digits <= kMost && read_.number({text}) != *number; ++digits) {
      text = fmt::format("{:.{}e}", *number, digits - 1);
    }
    return text;
  }

 private:
  SqliteDatabase database_;
  SqliteStatement read_;
};

using Out = std::back_insert_iterator<std::string>;

void write_head(const ArenaExperiment& arena, SqliteNumbers& numbers, Out out) {
  fmt::format_to(out, "{} version {}\nExperiment {}\n{} experiment properties\n", kLibrary,
                 arena.version, arena.name, arena.properties.size());
  for (const ExperimentProperty& property : arena.properties) {
    fmt::format_to(out, "{} {} = {}\n", property.name, property.sql_type,
                   numbers.text(property.value));
  }
  fmt::format_to(out, "Running on {}\nStarting at {}\n<<<|\n{}|>>>\n<<<|\n{}|>>>\n", arena.host,
                 arena.date, arena.setup, arena.processor);
  fmt::format_to(out,
                 "{} is the random seed\n{} seconds per run\n{} MB per run\n{} runs per planner\n"
                 "{} seconds spent to collect the data\n{} enum types\n",
                 arena.seed, arena.time_limit_s, arena.memory_limit_mb, arena.runs_per_planner,
                 arena.total_s, enumerations().size());
  for (const Enumeration& enumeration : enumerations()) {
    fmt::format_to(out, "{}|{}\n", enumeration.name, fmt::join(enumeration.values, "|"));
  }
}

void write_planner(const ExportedConfiguration& configuration, SqliteNumbers& numbers, Out out) {
  const std::vector<std::string> settings = configuration.method.settings();
  fmt::format_to(out, "{}\n{} common properties\n", configuration.method.variant, settings.size());
  for (const std::string& line : settings) fmt::format_to(out, "{}\n", line);
  fmt::format_to(out, "{} properties for each run\n", run_columns().size());
  for (const RunColumn& column : run_columns()) {
    fmt::format_to(out, "{} {}\n", column.name, column.sql_type());
  }
  fmt::format_to(out, "{} runs\n", configuration.runs.size());
  for (const ExportedRun& run : configuration.runs) {
    for (const Figure& figure : run.figures) {
      fmt::format_to(out, "{}; ", numbers.text(cell_of(figure)));
    }
    fmt::format_to(out, "\n");
  }
  fmt::format_to(out, ".\n");
}

/// Of experiment `number`, from 1.
std::string log_name(std::size_t number, const ExportedExperiment& experiment) {
  constexpr std::size_t kLongest = 100;
  std::string name;
  for (const char c : experiment.scenario.name.substr(0, kLongest)) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    name += plain ? c : '_';
  }
  return fmt::format("{:06}_{}.log", number, name);
}

bool is_log_name(const std::string& name) {
  constexpr std::size_t kDigits = 6;
  return name.size() > kDigits && name.ends_with(".log") && name[kDigits] == '_' &&
         std::all_of(name.begin(), name.begin() + kDigits,
                     [](char c) { return c >= '0' && c <= '9'; });
}

void remove_other_logs(const fs::path& directory, const std::vector<fs::path>& kept) {
  const std::set<fs::path> ours(kept.begin(), kept.end());
  std::vector<fs::path> others;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(directory, error)) {
    const bool log = is_log_name(entry.path().filename().string());
    if (log && !ours.contains(entry.path())) others.push_back(entry.path());
  }
  for (const fs::path& file : others) {
    if (!error) fs::remove(file, error);
  }
  if (error) {
    throw InputError(
        fmt::format("{}: expected a directory that can be written to, got one that "
                    "cannot ({})",
                    directory.string(), error.message()));
  }
}

}  // namespace

std::string ompl_log(const ExportedExperiment& experiment, const std::vector<Origin>& origins) {
  SqliteNumbers numbers;
  std::string text;
  const Out out(text);
  write_head(arena_experiment(experiment, origins), numbers, out);
  fmt::format_to(out, "{} planners\n", experiment.configurations.size());
  for (const ExportedConfiguration& configuration : experiment.configurations) {
    write_planner(configuration, numbers, out);
  }
  return text;
}

std::vector<fs::path> write_ompl_logs(const ExportedRuns& runs, const fs::path& place) {
  if (place.extension() == ".log") {
    if (runs.experiments.size() != 1) {
      throw InputError(
          fmt::format("{}: expected the name of a directory, without .log: there are {} scenario "
                      "files, and a log holds one; got that of a file",
                      place.string(), runs.experiments.size()));
    }
    write_text_file(place, ompl_log(runs.experiments.front(), runs.origins));
    return {place};
  }
  std::error_code error;
  fs::create_directories(place, error);
  if (error || !fs::is_directory(place)) {
    throw InputError(
        fmt::format("{}: expected a directory, or a file *.log, that can be written, "
                    "got one that cannot",
                    place.string()));
  }
  std::vector<fs::path> files;
  for (const ExportedExperiment& experiment : runs.experiments) {
    files.push_back(place / log_name(files.size() + 1, experiment));
    write_text_file(files.back(), ompl_log(experiment, runs.origins));
  }
  remove_other_logs(place, files);
  return files;
}

}  // namespace bqsa::harness
