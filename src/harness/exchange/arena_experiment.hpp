/// @file
/// What OMPL's benchmark logs and Planner Arena's database say of an experiment.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "harness/exchange/exported_runs.hpp"

namespace bqsa::harness {

/// `<library> version <number>` in a log, `<library> <number>` in a database.
inline constexpr const char* kLibrary = "bqsa-bench";

struct ExperimentProperty {
  const char* name;  ///< of a column: a word that SQL does not know
  const char* sql_type;
  Cell value;
};

/// Where the runs of an experiment do not agree its words are `several`, its limits the largest.
struct ArenaExperiment {
  std::string name;  ///< one word: the scenario's family, so that a series of sizes has one name
  std::vector<ExperimentProperty> properties;  ///< those that the scenario has, by name
  double total_s = 0;                          ///< wall time of all runs
  double time_limit_s = 0;
  double memory_limit_mb = 0;  ///< in units of 2^20 bytes
  int runs_per_planner = 0;    ///< the most that one has
  std::string version;         ///< one word
  std::string host;            ///< one word
  std::string date;            ///< of the first run; one word
  std::string seed;            ///< one word
  std::string processor;       ///< a line for each of processor, cores and governor
  std::string setup;           ///< lines that describe the scenario
};

ArenaExperiment arena_experiment(const ExportedExperiment& experiment,
                                 const std::vector<Origin>& origins);

/// The settings of a configuration as Planner Arena stores them.
std::string arena_settings(const ExportedMethod& method);

/// The text with `_` for everything that Python takes for white space, `unnamed` for none.
std::string one_word(std::string_view text);

}  // namespace bqsa::harness
