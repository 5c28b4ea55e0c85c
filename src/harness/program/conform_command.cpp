#include <fmt/core.h>

#include <ostream>

#include "harness/conformance.hpp"
#include "harness/program/commands.hpp"
#include "harness/scenario/scenario.hpp"
#include "harness/scenario_files.hpp"

namespace bqsa::harness {
namespace {

/// Prints what a law made of a method. @return whether it is kept
bool report(const Law& law, const LawCheck& check, std::ostream& out) {
  if (!check.not_asked.empty()) {
    out << fmt::format("  {:<10} {:<14} {}\n", "not asked", law.name, check.not_asked);
  } else if (check.findings.empty()) {
    out << fmt::format("  {:<10} {:<14} {} ({} compared)\n",
                       check.compared > 0 ? "passed" : "no case", law.name, law.demand,
                       check.compared);
  }
  for (const Finding& finding : check.findings) {
    out << fmt::format("  {:<10} {:<14} {}: expected {}, found {}\n", "BROKEN", finding.law,
                       finding.where, finding.expected, finding.found);
  }
  out << std::flush;
  return check.findings.empty();
}

}  // namespace

Status conform_command(const std::vector<MethodEntry>& methods, const ConformOptions& options,
                       const Console& console) {
  std::vector<MethodSpec> specs;
  for (const std::string& text : options.methods) specs.push_back(parse_method_spec(text, methods));
  std::vector<Problem> problems;
  for (const std::filesystem::path& file : with_directories_opened(options.scenarios)) {
    Scenario scenario = load_scenario(file, options.load);
    if (!scenario.geometry.solids.empty() || scenario.self_collision) {
      throw InputError(fmt::format(
          "{}: expected obstacles that are ellipsoids and no self_collision, since laws "
          "are checked on what methods are told, got another scenario",
          file.string()));
    }
    problems.push_back(std::move(scenario.problem));
  }
  const ConformanceSettings settings{.plan_budget_s = options.plan_budget, .limits = {}};
  bool kept = true;
  for (std::size_t i = 0; i < specs.size(); ++i) {
    const MethodSpec& spec = specs[i];
    console.out << fmt::format("{}: applies to {} of {} scenarios\n", options.methods[i],
                               applicable(spec, problems).size(), problems.size());
    for (const Law& law : laws()) {
      kept = report(law, law.check(spec, problems, settings), console.out) && kept;
    }
  }
  return kept ? kOk : kRunFailed;
}

}  // namespace bqsa::harness
