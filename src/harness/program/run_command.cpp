#include <fmt/core.h>

#include <chrono>
#include <cmath>
#include <map>
#include <ostream>
#include <set>
#include <system_error>

#include "harness/methods.hpp"
#include "harness/program/commands.hpp"
#include "harness/program/external_methods.hpp"
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
                                          const std::vector<MethodEntry>& methods,
                                          const Console& console) {
  std::vector<std::filesystem::path> good;
  std::map<std::string, std::filesystem::path> by_name;
  for (const std::filesystem::path& file : files) {
    std::string name;
    try {
      name = load_scenario(file).problem.name;
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

std::string duration_text(double seconds) {
  constexpr double kMinute = 60;
  constexpr double kHour = 3600;
  if (seconds < 2 * kMinute) return fmt::format("{:.0f} s", seconds);
  if (seconds < 2 * kHour) return fmt::format("{:.0f} min", seconds / kMinute);
  return fmt::format("{:.1f} h", seconds / kHour);
}

/// One line on the terminal that is written over again and again.
class Progress {
 public:
  Progress(const Console& console, bool shown, std::size_t total)
      : err_(console.err), shown_(shown && console.terminal), total_(total) {}
  ~Progress() { overwrite(""); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void next(const std::string& what) {
    const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    std::string pace;
    if (done_ > 0 && seconds > 1) {
      const double rate = static_cast<double>(done_) / seconds;
      pace = fmt::format(", {:.3g} runs/s, {} left", rate,
                         duration_text(static_cast<double>(total_ - done_) / rate));
    }
    overwrite(fmt::format("[{}/{}] {}{}", ++done_, total_, what, pace));
  }

 private:
  using Clock = std::chrono::steady_clock;

  void overwrite(const std::string& text) {
    constexpr const char* kClearLine = "\r\033[K";
    if (shown_) err_ << kClearLine << text << std::flush;
  }

  std::ostream& err_;
  bool shown_;
  std::size_t total_;
  std::size_t done_ = 0;
  Clock::time_point start_ = Clock::now();
};

Circumstances circumstances_of(const RunOptions& options) {
  if (!std::isfinite(options.joint_noise)) {
    throw InputError("--joint-noise: expected a standard deviation [rad], got no finite number");
  }
  return {.settings = {.seed = options.seed,
                       .plan_budget_s = options.plan_budget,
                       .disturbance = {.joint_noise = options.joint_noise,
                                       .latency_ticks = options.latency ? 1 : 0}},
          .command_line = options.command_line,
          .store_trajectories = options.trajectories,
          .limits = {.wall_s = options.time_limit,
                     .memory_bytes = static_cast<std::uint64_t>(options.memory_limit) << 20U},
          .in_process = options.in_process};
}

/// How often a method runs on each scenario.
std::uint64_t seeds_of(const MethodSpec& spec, const RunOptions& options) {
  return spec.entry.capabilities.plans ? static_cast<std::uint64_t>(options.seeds) : 1;
}

}  // namespace

void Console::error(std::string_view message) const {
  err << "bqsa-bench: error: " << message << std::endl;
}

Status run_command(const std::vector<MethodEntry>& methods, const RunOptions& options,
                   const Console& console) {
  if (options.directory.empty()) throw InputError("--out: expected a directory, got nothing");
  const std::vector<MethodSpec> specs = chosen_methods(methods, options.methods);
  Circumstances circumstances = circumstances_of(options);
  circumstances.out_of_tree = names_out_of_tree(methods);
  const std::vector<std::filesystem::path> named = with_directories_opened(options.scenarios);
  const std::vector<std::filesystem::path> files = usable(named, methods, console);
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
    for (const MethodSpec& spec : specs) runs += files.size() * seeds_of(spec, options);
    Progress progress(console, !options.quiet, runs);
    const auto run_one = [&](const Scenario& scenario, const Judge& judge, const MethodSpec& spec,
                             std::uint64_t seed) {
      progress.next(scenario.problem.name + " " + variant_name(spec));
      Circumstances seeded = circumstances;
      seeded.settings.seed = seed;
      const StoredRun run = run_pair(scenario, judge, spec, seeded, store);
      rows.push_back(parse_run_record(run.record));
      if (!run.trajectory_error.empty()) throw InputError(run.trajectory_error);
    };
    for (const std::filesystem::path& file : files) {
      reporting([&] {
        const Scenario scenario = load_scenario(file);
        const Judge judge(scenario.problem);
        for (const MethodSpec& spec : specs) {
          for (std::uint64_t k = 0; k < seeds_of(spec, options); ++k) {
            reporting([&] { run_one(scenario, judge, spec, options.seed + k); });
          }
        }
      });
    }
  }
  if (!options.quiet && !rows.empty()) print_report(rows, options.report, console.out);

  bool failed = false;
  for (const TableRow& row : rows) failed = failed || (row.applicable && !row.success);
  count_refused();
  if (lost || refused > 0) return kBadInput;
  return options.strict && failed ? kRunFailed : kOk;
}

}  // namespace bqsa::harness
