/// @file
/// What measuring comes to: sweeps with their origin, as one file of Google Benchmark's JSON.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/measuring/sweep.hpp"
#include "harness/results/provenance.hpp"

namespace bqsa::harness {

/// Share of the cores that others may keep busy while we measure: short blocks on one core are disturbed
/// by less than whole runs are.
inline constexpr double kMostOtherWork = 0.25;

/// Why times are only indicative; empty if they can be published. The load average does not count, which
/// tells of the minute before too, a build's for instance.
/// @param other_cores  OtherWork::cores() while measuring
std::vector<std::string> reasons_against_measuring(const BuildInfo& build,
                                                   const MachineState& before, double other_cores);

/// Where measurements come from.
struct MeasurementOrigin {
  BuildInfo build;
  MachineState before;          ///< the machine when measuring began
  double other_cores = 0;       ///< OtherWork::cores() while measuring
  std::string instruction_set;  ///< of batched code (bqsa/batch/instruction_set.hpp)
  std::string effort;           ///< `quick` or `full`
  std::string command_line;
  std::vector<std::string> against;  ///< reasons_against_measuring()
};

struct Measurements {
  MeasurementOrigin origin;
  std::vector<Sweep> sweeps;

  /// @return null if there is no such sweep
  const Sweep* find(std::string_view name) const;
};

/// The same sweeps, each from other processes, as one.
/// @param processes  at least one; the paper's protocol is taken from the first
/// @throws std::runtime_error if they are not the same sweeps, sizes and contestants
std::vector<Sweep> pool(const std::vector<std::vector<Sweep>>& processes);

/// As docs/measuring.md has it: an entry for each sweep, contestant, size and process, then mean, median and
/// standard deviation over processes.
std::string measurements_json(const Measurements& measurements);

/// @throws InputError naming the file, and line or key, if it is not what measurements_json() wrote
Measurements read_measurements(const std::filesystem::path& file);

/// What to say above times that are only indicative, as a line; empty if they can be published.
std::string indicative_note(const std::vector<std::string>& against);

}  // namespace bqsa::harness
