#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "harness/claims/estimator_lists.hpp"
#include "harness/claims/laboratory.hpp"
#include "harness/claims/program_output.hpp"

namespace bqsa::harness::claims {
namespace {

/// Where programs that this one starts are, in its build.
constexpr const char* kCompanions = "benchmarks/companions";

std::string not_built(const std::filesystem::path& program) {
  return fmt::format("{} was not built (target companions)", program.filename().string());
}

/// Figures that a program of the build prints, as JSON: an object of numbers.
Findings printed_figures(const std::filesystem::path& program,
                         const std::vector<std::string>& arguments) {
  Findings findings;
  const auto json = nlohmann::json::parse(program_output(program, arguments));
  for (const auto& [name, value] : json.items()) {
    findings.figures.push_back({name, value.get<double>()});
  }
  return findings;
}

/// The two builds run by turns, so that what slows the machine down slows both alike.
Findings native_build(const Arguments&, Laboratory& laboratory) {
  const std::filesystem::path directory = laboratory.build_directory() / kCompanions;
  const std::filesystem::path programs[] = {directory / "default_speed",
                                            directory / "native_speed"};
  for (const std::filesystem::path& program : programs) {
    if (!std::filesystem::exists(program)) return {.figures = {}, .not_here = not_built(program)};
  }
  const int rounds = laboratory.full() ? 10 : 4;
  std::map<std::string, std::vector<double>> times[2];  // of a kernel, [build], one a round [s]
  for (int round = 1; round <= rounds; ++round) {
    for (const int build : {0, 1}) {
      for (const Figure& kernel :
           printed_figures(programs[build], {std::to_string(round)}).figures) {
        times[build][kernel.name].push_back(kernel.value);
      }
    }
  }
  Findings findings;
  std::map<std::string, Figure> slowest;  // of kernels and of steps
  for (const auto& [name, seconds] : times[0]) {
    const Estimate ratio = time_ratio(seconds, times[1].at(name));
    findings.remarks.push_back(fmt::format("{}: {:.3f}", name, ratio.value));
    const std::string kind = name.substr(0, name.find('_'));
    const auto found = slowest.find(kind);
    if (found != slowest.end() && found->second.value >= ratio.value) continue;
    slowest.insert_or_assign(kind, Figure{kind, ratio.value, ratio.interval});
  }
  for (const auto& [kind, figure] : slowest) findings.figures.push_back(figure);
  return findings;
}

Findings allocations(const Arguments&, Laboratory& laboratory) {
  const std::filesystem::path program =
      laboratory.build_directory() / kCompanions / "count_allocations";
  if (!std::filesystem::exists(program)) return {.figures = {}, .not_here = not_built(program)};
  return printed_figures(program, {});
}

}  // namespace

std::vector<Estimator> companion_estimators() {
  return {
      {.name = "native_build",
       .what =
           "Time of this build over time of a build for the instructions of this processor alone, "
           "two programs run by turns",
       .timing = true,
       .arguments = {},
       .figures = {{"kernel", "-", "of the segment test, batched or single, where it is largest"},
                   {"step", "-", "of a control step of bqsa, where it is largest"}},
       .estimate = native_build},
      {.name = "allocations",
       .what = "Heap allocations of warm queries and steps",
       .arguments = {},
       .figures = {{"batch", "-", "a pass of the batched test, all forms and both precisions"},
                   {"single", "-", "a single segment test"},
                   {"step", "-", "200 control steps of bqsa in the plane and in space each"},
                   {"fcl_collide", "-", "a query of FCL, its result kept from query to query"}},
       .estimate = allocations},
  };
}

}  // namespace bqsa::harness::claims
