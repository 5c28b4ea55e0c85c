/// @file
/// The runs of a campaign, each with a key that changes with whatever its result may depend on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/campaign/campaign_file.hpp"
#include "harness/scenario/scenario.hpp"

namespace bqsa::harness {

struct PlannedScenario {
  std::filesystem::path file;
  std::string name;    ///< no two of a plan have the same
  std::string sha256;  ///< as Scenario::sha256
};

struct PlannedRun {
  std::size_t scenario = 0;  ///< index into Plan::scenarios
  std::size_t method = 0;    ///< index into Plan::methods
  int repetition = 1;        ///< from 1
  std::uint64_t seed = 0;    ///< run_seed()
  std::string key;           ///< run_key()
};

struct Plan {
  std::string campaign;  ///< its name
  std::vector<PlannedScenario> scenarios;
  std::vector<MethodSpec> methods;
  std::vector<std::string> identities;  ///< method_identity() of each
  std::vector<PlannedRun> runs;         ///< by scenario, then method, then repetition
  RunSettings settings;                 ///< of all runs, but for the seed
  RunLimits limits;
  KeptTrajectories trajectories = KeptTrajectories::kAll;
};

/// Seed of a run: 32 bits of SHA-256. Of a method that plans it depends on scenario, method,
/// parameters and repetition; of one that answers tick by tick, where it is that of the noise, on
/// scenario and repetition alone, so that all methods meet the same noise.
std::uint64_t run_seed(std::uint64_t campaign_seed, const PlannedScenario& scenario,
                       const MethodSpec& method, int repetition);

/// What of the program a key depends on: version, commit, build type, flags, compiler and libraries;
/// where the commit does not say what the program is (modified, unknown, methods out of tree), the SHA-256
/// of the running executable too.
std::string program_identity(const std::vector<std::string>& out_of_tree);

/// What of a method a key depends on: its name and all its parameters; of an external one the command too,
/// with the SHA-256 of the program that it starts and of the files that its words name.
std::string method_identity(const MethodSpec& method);

/// Key of a run: 32 hexadecimal digits of the SHA-256 of the bytes of the scenario, method, repetition,
/// seed, disturbance, limits, budget and program.
/// @param method   method_identity()
/// @param program  program_identity()
std::string run_key(const PlannedScenario& scenario, const std::string& method, int repetition,
                    std::uint64_t seed, const RunSettings& settings, const RunLimits& limits,
                    const std::string& program);

struct PlanOptions {
  LoadOptions load = {};
  std::vector<std::string> out_of_tree = {};  ///< methods that were added to the stock program
  /// Told how many scenarios of how many are loaded or generated.
  std::function<void(std::size_t done, std::size_t all)> progress = {};
};

/// Loads every scenario once, generates those that are to be generated into `<directory>/scenarios`,
/// and lists all runs.
/// @throws InputError for a scenario that cannot be used, two of one name, or a directory that cannot be
///   written to
Plan make_plan(const Campaign& campaign, const std::filesystem::path& directory,
               const PlanOptions& options = {});

}  // namespace bqsa::harness
