/// @file
/// The runs of a results directory as the exchange formats see them: an experiment is a scenario file, in
/// it a configuration is a variant of a method, and has runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/exchange/origin.hpp"
#include "harness/exchange/run_columns.hpp"
#include "harness/input_error.hpp"
#include "harness/results/table_row.hpp"

namespace bqsa::harness {

struct ExportedContact {
  int link = 0;
  std::string obstacle;  ///< empty if the record names none
  int first_tick = 0;
  bool at_tick = false;
  int ticks = 0;
};

/// Two links that collide.
struct ExportedSelfContact {
  int link = 0;
  int other_link = 0;
  int first_tick = 0;
  bool at_tick = false;
  int ticks = 0;
};

/// A pair of link and obstacle that the method says it kept apart.
struct ExportedClamp {
  int link = 0;
  std::string obstacle;  ///< empty if the record names none
  int ticks = 0;
};

/// One run that was judged.
struct ExportedRun {
  TableRow row;                 ///< what the table shows of it
  std::vector<Figure> figures;  ///< by run_columns()
  std::vector<std::pair<std::string, std::uint64_t>> counters;
  std::vector<std::string> failures;  ///< the most telling first
  std::vector<ExportedContact> contacts;
  std::vector<ExportedSelfContact> self_contacts;
  std::vector<ExportedClamp> clamped;
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

/// An obstacle that is a solid, as a LedgerEntry.
struct ExportedSolid {
  std::string name;
  std::string kind;
  int parts = 1;
  int ellipsoids = 1;
  double inflation_m = 0;
  double volume_ratio = 1;  ///< not a number for a solid without volume
  bool within_bounds = true;
  double hull_over_mesh = 0;  ///< not a number where there is none
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
  double link_radius_m = 0;               ///< of all links, or of the thickest
  std::vector<double> link_radii_m = {};  ///< each link's own, or none
  std::string robot = {};                 ///< its name; empty if it has none
  std::string orientation = {};           ///< `axis` or `pose`; empty if the task has none
  double orientation_tolerance_rad = std::numeric_limits<double>::quiet_NaN();  ///< likewise
  double reference_clearance_m = std::numeric_limits<double>::quiet_NaN();  ///< if it states one
  std::vector<ExportedSolid> solids = {};  ///< none if all obstacles are ellipsoids
  double gap_lost_m = 0;                   ///< GeometryLedger::gap_lost
  double radius_excess_m = 0;              ///< GeometryLedger::radius_excess
};

struct ExportedExperiment {
  ExportedScenario scenario;
  std::vector<ExportedConfiguration> configurations;  ///< at least one
};

/// A pair of method and problem that do not fit each other, of which there is no run.
struct ExportedMisfit {
  ExportedScenario scenario;
  ExportedMethod method;
  TableRow row;
  std::string date;
  std::size_t origin = 0;  ///< index into ExportedRuns::misfit_origins
  std::string record;      ///< file and line
};

struct ExportedRuns {
  std::vector<ExportedExperiment> experiments;
  std::vector<ExportedMisfit> misfits;
  std::vector<Origin> origins;         ///< of the runs
  std::vector<Origin> misfit_origins;  ///< of the misfits
  int runs = 0;                        ///< in all experiments
  int not_applicable = 0;              ///< number of misfits
  int superseded = 0;                  ///< repeated later
  int stale = 0;                       ///< not of the plan
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
