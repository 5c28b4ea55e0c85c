/// @file
/// A planning problem made into a problem of tracking: the tip's path is that of a reference motion.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "bqsa/method.hpp"
#include "harness/generator/robot_file.hpp"
#include "harness/problem_sets/problem_set.hpp"
#include "harness/problem_sets/reference_motion.hpp"

namespace bqsa::harness {

struct ImportSettings {
  double clearance = 0.005;  ///< that the reference keeps from all obstacles [m]
  double tolerance = 1e-3;   ///< as in a scenario [m]
  double margin = 0;         ///< as in a scenario [m]
  ReferenceSettings reference = {};
};

/// Files of one scenario.
struct ImportedScenario {
  std::string name;
  std::string yaml;      ///< of `<name>.yaml`
  std::string path_csv;  ///< of `<name>.path.csv`, which it names
  Trajectory witness;    ///< a motion that the judge calls a success
  double clearance = 0;  ///< of the witness, as the judge found it [m]
};

/// Why a problem of a set gives none.
enum class ImportFailure {
  kStart,      ///< the start is refused: it collides, or is beyond the limits
  kGoals,      ///< every goal collides, is too near to an obstacle, or is beyond the limits
  kReference,  ///< no motion was found
  kPath,       ///< the tip's path is refused
  kJudged,     ///< the judge finds fault with the timed motion
};

struct ImportResult {
  std::optional<ImportedScenario> scenario = {};
  ImportFailure failure = ImportFailure::kStart;  ///< if there is none
  std::string why = {};                           ///< in words, if there is none
};

/// `<set>_<group>_<index>`, the index of four digits, the rest of at most 52 characters.
std::string imported_name(const std::string& set, const PlanningProblem& problem);

/// The scenario is read back by the loader before the reference is planned and again before it is
/// judged, so that a file and nothing else decides.
/// @param robot      its file, which says what a scenario says of it
/// @param directory  of that file, for the files that it names
/// @param source     of the problem, for the description: one line
ImportResult import_problem(const PlanningProblem& problem, const std::string& name,
                            const RobotFile& robot, const std::filesystem::path& directory,
                            const std::string& source, const ImportSettings& settings);

const char* name_of(ImportFailure failure);

}  // namespace bqsa::harness
