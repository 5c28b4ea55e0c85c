#include "harness/results/provenance.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/utsname.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <limits>
#include <thread>

#include "build_configuration.hpp"
#include "source_version.hpp"

namespace bqsa::harness {
namespace {

constexpr const char* kUnknown = "unknown";

/// Rest of the first line of `file` that starts with `key`, without the separators between.
std::string value_in(const char* file, std::string_view key, std::string_view separators) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(key)) continue;
    const std::size_t begin = line.find_first_not_of(separators, key.size());
    if (begin == std::string::npos) break;
    return line.substr(begin, line.find_last_not_of(separators) - begin + 1);
  }
  return kUnknown;
}

/// Not a number if it is none.
double number_in(const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  return end == text.c_str() ? std::numeric_limits<double>::quiet_NaN() : number;
}

std::string operating_system() {
  utsname kernel{};
  const std::string release = uname(&kernel) == 0 ? kernel.release : kUnknown;
  return value_in("/etc/os-release", "PRETTY_NAME", "=\"") + ", kernel " + release;
}

}  // namespace

const BuildInfo& build_info() {
  static const BuildInfo kInfo{
      .version = kProgramVersion,
      .commit = kSourceCommit,
      .dirty = kSourceDirty,
      .compiler = kCompiler,
      .build_type = kBuildType,
      .flags = kCompilerFlags,
#ifdef NDEBUG
      .assertions = false,
#else
      .assertions = true,
#endif
      .sanitizers = kSanitized,
      .libraries = {{"Eigen", kEigenVersion},
                    {"Highway", kHighwayVersion},
                    {"FCL", kFclVersion},
                    {"libccd", kCcdVersion},
                    {"Bullet", kBulletVersion},
                    {"Orocos KDL", kKdlVersion},
                    {"OMPL", kOmplVersion},
                    {"yaml-cpp", kYamlCppVersion},
                    {"nlohmann_json", kNlohmannJsonVersion},
                    {"CLI11", kCli11Version},
                    {"fmt", kFmtVersion}},
  };
  return kInfo;
}

MachineState machine_state() {
  MachineState state;
  state.processor = value_in("/proc/cpuinfo", "model name", "\t :");
  state.cores = static_cast<int>(std::thread::hardware_concurrency());
  state.governor = value_in("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "", " ");
  state.mhz = number_in(value_in("/proc/cpuinfo", "cpu MHz", "\t :"));
  state.load = std::numeric_limits<double>::quiet_NaN();
  getloadavg(&state.load, 1);
  state.os = operating_system();
  state.date = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  return state;
}

std::string host_name() {
  utsname system{};
  return uname(&system) == 0 ? system.nodename : kUnknown;
}

int restart_count() {
  const char* const text = std::getenv("SLURM_RESTART_COUNT");
  int count = 0;
  if (text == nullptr) return count;
  std::from_chars(text, text + std::strlen(text), count);
  return std::max(count, 0);
}

std::string version_text(const std::vector<std::string>& out_of_tree) {
  const BuildInfo& build = build_info();
  constexpr std::size_t kCommitDigits = 10;
  std::string text =
      fmt::format("{} (commit {}{})", build.version, build.commit.substr(0, kCommitDigits),
                  build.dirty ? ", modified" : "");
  if (!out_of_tree.empty())
    text += fmt::format(", with {} out of tree", fmt::join(out_of_tree, ", "));
  return text;
}

std::vector<std::string> reasons_against_times(const BuildInfo& build,
                                               const MachineState& machine) {
  std::vector<std::string> reasons;
  if (build.build_type != "Release") reasons.push_back("build type " + build.build_type);
  if (build.assertions) reasons.push_back("assertions on");
  if (build.sanitizers) reasons.push_back("sanitizers on");
  if (machine.load > machine.cores) {
    reasons.push_back("load average above the number of cores");
  }
  return reasons;
}

}  // namespace bqsa::harness
