/// @file
/// Where a result comes from: program, build and machine.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace bqsa::harness {

/// Commit of sources outside a git repository.
inline constexpr const char* kUnknownCommit = "unknown";

/// Fixed when the program is built. The commit is that of the sources at the time of the build.
struct BuildInfo {
  std::string version;  ///< of the program
  std::string commit;   ///< 40 hexadecimal digits, or kUnknownCommit
  bool dirty = false;   ///< tracked files differed from the commit
  std::string compiler;
  std::string build_type;
  std::string flags;
  bool assertions = false;
  bool sanitizers = false;
  std::vector<std::pair<std::string, std::string>> libraries;  ///< name, version
};

/// Taken when a run starts. "unknown" where the system does not say.
struct MachineState {
  std::string processor;
  int cores = 0;
  std::string governor;  ///< frequency governor of the first core
  double mhz = 0;        ///< of the first core, at that moment; not a number if unknown
  double load = 0;       ///< load average of the last minute, not a number if unknown
  std::string os;
  std::string date;  ///< UTC, ISO 8601, to the second
};

/// Said of the times of a run that failed, beside the reasons of build and machine.
inline constexpr const char* kNotASuccess = "not judged a success";

const BuildInfo& build_info();
MachineState machine_state();

/// As the system calls itself.
std::string host_name();

/// How often Slurm has started this job anew, by SLURM_RESTART_COUNT; 0 outside of Slurm.
int restart_count();

/// `0.1.0 (commit 1a2b3c4d5e, modified)`, as `--version` prints it; of a program with methods out of
/// tree `..., with a, b out of tree` follows.
std::string version_text(const std::vector<std::string>& out_of_tree = {});

/// Why times of this build on this machine are only indicative; empty if they can be published.
std::vector<std::string> reasons_against_times(const BuildInfo& build, const MachineState& machine);

}  // namespace bqsa::harness
