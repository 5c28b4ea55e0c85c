#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>
#include <set>
#include <system_error>

#include "harness/campaign/campaign_file.hpp"
#include "harness/campaign/plan_file.hpp"
#include "harness/methods.hpp"
#include "harness/program/commands.hpp"
#include "harness/program/external_methods.hpp"
#include "harness/program/progress.hpp"
#include "harness/program/report.hpp"
#include "harness/results/pair_run.hpp"
#include "harness/scenario_files.hpp"

namespace bqsa::harness {
namespace {

std::vector<MethodSpec> chosen_methods(const std::vector<MethodEntry>& methods,
                                       const std::vector<std::string>& texts) {
  std::vector<MethodSpec> chosen;
  std::set<std::string> seen;
  std::set<std::string> named;
  for (const std::string& text : texts) {
    chosen.push_back(parse_method_spec(text, methods));
    named.insert(chosen.back().entry.name);
    if (!seen.insert(variant_name(chosen.back())).second) {
      throw InputError(fmt::format("method '{}' is given twice", text));
    }
  }
  for (const MethodEntry& entry : methods) {
    const bool takes_part = texts.empty() || !entry.external.empty();
    if (takes_part && !named.contains(entry.name)) chosen.push_back(with_defaults(entry));
  }
  return chosen;
}

/// `, did you mean --method NAME?` where a scenario file that does not exist is a method's name.
std::string hint_for(const std::filesystem::path& file, const std::vector<MethodEntry>& methods) {
  std::error_code unknown;
  if (std::filesystem::exists(file, unknown)) return "";
  try {
    parse_method_spec(file.string(), methods);
  } catch (const InputError&) {
    return "";
  }
  return fmt::format("; did you mean --method {}?", file.string());
}

/// The files that can be used; the others are reported.
std::vector<std::filesystem::path> usable(const std::vector<std::filesystem::path>& files,
                                          const LoadOptions& load,
                                          const std::vector<MethodEntry>& methods,
                                          const Console& console) {
  std::vector<std::filesystem::path> good;
  std::map<std::string, std::filesystem::path> by_name;
  for (const std::filesystem::path& file : files) {
    std::string name;
    try {
      name = load_scenario(file, load).problem.name;
    } catch (const InputError& error) {
      console.error(error.what() + hint_for(file, methods));
      continue;
    }
    const auto [other, first] = by_name.try_emplace(name, file);
    if (!first) {
      throw InputError(fmt::format("{} and {} have the same scenario name '{}'; nothing was run",
                                   other->second.string(), file.string(), name));
    }
    good.push_back(file);
  }
  return good;
}

Circumstances circumstances_of(const RunOptions& options) {
  if (!std::isfinite(options.joint_noise)) {
    throw InputError("--joint-noise: expected a standard deviation [rad], got no finite number");
  }
  return {.settings = {.seed = options.seed,
                       .plan_budget_s = options.plan_budget,
                       .disturbance = {.joint_noise = options.joint_noise,
                                       .latency_ticks = options.latency ? 1 : 0}},
          .command_line = options.command_line,
          .trajectories = options.trajectories ? KeptTrajectories::kAll : KeptTrajectories::kNone,
          .limits = {.wall_s = options.time_limit,
                     .memory_bytes = static_cast<std::uint64_t>(options.memory_limit) << 20U},
          .in_process = options.in_process};
}

/// How often a method runs on each scenario.
std::uint64_t seeds_of(const MethodSpec& spec, const RunOptions& options) {
  return spec.entry.capabilities.plans ? static_cast<std::uint64_t>(options.seeds) : 1;
}

}  // namespace

void refuse_options(const std::vector<std::string>& given, const std::string& where) {
  if (!given.empty()) throw InputError(fmt::format("{}: is for {}", given.front(), where));
}

void Console::error(std::string_view message) const {
  err << "bqsa-bench: error: " << message << std::endl;
}

Status run_command(const std::vector<MethodEntry>& methods, const RunOptions& options,
                   const Console& console) {
  if (std::any_of(options.scenarios.begin(), options.scenarios.end(), is_campaign_file)) {
    return run_campaign_command(methods, options, console);
  }
  refuse_options(options.for_campaigns, "a campaign, and there is none among the scenarios");
  if (options.directory.empty()) throw InputError("--out: expected a directory, got nothing");
  if (has_plan(options.directory)) {
    throw InputError(
        fmt::format("--out: {}: expected a directory of single runs, got that of a campaign",
                    options.directory.string()));
  }
  const std::vector<MethodSpec> specs = chosen_methods(methods, options.methods);
  Circumstances circumstances = circumstances_of(options);
  circumstances.out_of_tree = names_out_of_tree(methods);
  const std::vector<std::filesystem::path> named = with_directories_opened(options.scenarios);
  const std::vector<std::filesystem::path> files = usable(named, options.load, methods, console);
  const std::size_t refused = named.size() - files.size();
  const auto count_refused = [&] {
    if (refused == 0) return;
    console.error(
        fmt::format("{} of {} scenarios refused, no runs of them", refused, named.size()));
  };
  if (files.empty()) {
    count_refused();
    return kBadInput;
  }
  ResultStore store(options.directory);

  std::vector<TableRow> rows;
  bool lost = false;
  const auto reporting = [&](const auto& work) {
    try {
      work();
    } catch (const InputError& error) {
      console.error(error.what());
      lost = true;
    }
  };
  {
    // Scenarios are loaded one at a time: thousands of them do not have to fit into memory.
    std::size_t runs = 0;
    std::size_t done = 0;
    for (const MethodSpec& spec : specs) runs += files.size() * seeds_of(spec, options);
    Progress progress(console, !options.quiet, runs);
    const auto run_one = [&](const Scenario& scenario, const Judge& judge, const MethodSpec& spec,
                             std::uint64_t seed) {
      progress.show(done++, scenario.problem.name + " " + variant_name(spec));
      Circumstances seeded = circumstances;
      seeded.settings.seed = seed;
      const StoredRun run = run_pair(scenario, judge, spec, seeded, store);
      rows.push_back(parse_run_record(run.record));
      if (!run.trajectory_error.empty()) throw InputError(run.trajectory_error);
    };
    for (const std::filesystem::path& file : files) {
      reporting([&] {
        const Scenario scenario = load_scenario(file, options.load);
        const Judge judge(scenario.problem, scenario.truth, scenario.self_collision);
        for (const MethodSpec& spec : specs) {
          for (std::uint64_t k = 0; k < seeds_of(spec, options); ++k) {
            reporting([&] { run_one(scenario, judge, spec, options.seed + k); });
          }
        }
      });
    }
  }
  if (!options.quiet && !rows.empty()) print_report(rows, options.report, console);
  const Status reported = report_after_run(methods, options, console);

  bool failed = false;
  for (const TableRow& row : rows) failed = failed || (row.applicable && !row.success);
  count_refused();
  if (lost || refused > 0) return kBadInput;
  return options.strict && failed ? kRunFailed : reported;
}

}  // namespace bqsa::harness
