/// @file
/// The runs of a results directory as the exchange formats see them: an experiment is a scenario file, in
/// it a configuration is a variant of a method, and has runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/exchange/run_columns.hpp"
#include "harness/input_error.hpp"

namespace bqsa::harness {

/// What of a run's provenance many runs share: build, machine, limits, call.
struct Origin {
  static std::span<const char* const> columns();

  std::vector<Cell> values;  ///< one for each column

  /// @param column  of columns()
  const Cell& operator[](std::string_view column) const;
  std::string text(std::string_view column) const;  ///< `unknown` if it has none
  double number(std::string_view column) const;     ///< 0 if it has none

  bool operator==(const Origin&) const = default;
};

struct ExportedContact {
  int link = 0;
  std::string obstacle;  ///< empty if the record names none
  int first_tick = 0;
  bool at_tick = false;
  int ticks = 0;
};

/// One run that was judged.
struct ExportedRun {
  std::vector<Figure> figures;  ///< by run_columns()
  std::vector<std::pair<std::string, std::uint64_t>> counters;
  std::vector<std::string> failures;  ///< the most telling first
  std::vector<ExportedContact> contacts;
  std::string claim_obstacle;
  std::string claim_message;
  std::string disagreement;
  std::string
      trajectory;  ///< file, relative to the directory; empty if it has none, or a later run's
  std::string campaign;  ///< empty for a run of none
  std::string key;
  std::string seed;  ///< all digits
  std::string date;
  double load_average = 0;           ///< not a number if unknown
  std::optional<int> restarts;       ///< older records lack it
  std::vector<std::string> against;  ///< why its times are only indicative
  std::size_t origin = 0;            ///< index into ExportedRuns::origins
  std::string record;                ///< file and line: `runs.jsonl:7`
  double total_s = 0;                ///< wall time, whatever came of it; 0 if unknown

  /// @param column  name of a run_columns()
  const Figure& figure(std::string_view column) const;
};

struct ExportedParameter {
  std::string name;
  Cell value;
};

/// A variant of a method.
struct ExportedMethod {
  std::string name;
  std::string variant;
  std::string changed;
  std::vector<ExportedParameter> parameters;

  /// A line for each parameter, `increment = 0.002`, after `method = bqsa`.
  std::vector<std::string> settings() const;
};

struct ExportedConfiguration {
  ExportedMethod method;
  std::vector<ExportedRun> runs;  ///< at least one
};

/// A scenario file as its records describe it.
struct ExportedScenario {
  std::string name;
  std::string sha256;
  std::string file;
  int dimension = 0;
  int joints = 0;
  int links = 0;
  std::vector<std::string> obstacles;
  int nk = 0;
  int ticks = 0;
  double dt_s = 0;
  double tolerance_m = 0;
  double margin_m = 0;
  double link_radius_m = 0;
};

struct ExportedExperiment {
  ExportedScenario scenario;
  std::vector<ExportedConfiguration> configurations;  ///< at least one
};

struct ExportedRuns {
  std::vector<ExportedExperiment> experiments;
  std::vector<Origin> origins;
  int runs = 0;            ///< in all experiments
  int not_applicable = 0;  ///< pairs of method and problem that do not fit, without a run
  int superseded = 0;      ///< repeated later
  int stale = 0;           ///< not of the plan
  std::vector<std::string> bad_lines;  ///< `<file>:<line>: why`
};

/// Reads all files with records. Of several runs of the same scenario file, variant, seed, key and
/// repetition the last one counts, at the place of the first.
/// @param planned  keys of the campaign's plan: other records are left out, and runs are in its order.
///   Without a plan all count, in order of appearance
/// @throws InputError if there are no records
ExportedRuns read_exported_runs(const std::filesystem::path& directory,
                                const std::optional<std::vector<std::string>>& planned);

}  // namespace bqsa::harness
