#include <fmt/core.h>

#include <ostream>
#include <set>

#include "harness/methods.hpp"
#include "harness/program/commands.hpp"
#include "harness/results/pair_run.hpp"
#include "harness/results/table.hpp"

namespace bqsa::harness {
namespace {

std::vector<MethodSpec> chosen_methods(const std::vector<std::string>& texts) {
  std::vector<MethodSpec> chosen;
  if (texts.empty()) {
    for (const MethodEntry& entry : methods()) chosen.push_back(with_defaults(entry));
  }
  std::set<std::string> seen;
  for (const std::string& text : texts) {
    chosen.push_back(parse_method_spec(text, methods()));
    if (!seen.insert(variant_name(chosen.back())).second) {
      throw InputError(fmt::format("method '{}' is given twice", text));
    }
  }
  return chosen;
}

/// Loads the scenarios that can be used; the others are reported and noted in `refused`.
std::vector<Scenario> load_all(const std::vector<std::filesystem::path>& files,
                               const Console& console, std::vector<std::string>& refused) {
  std::vector<Scenario> scenarios;
  for (const std::filesystem::path& file : files) {
    try {
      scenarios.push_back(load_scenario(file));
    } catch (const InputError& error) {
      console.error(error.what());
      refused.push_back(error.what());
    }
  }
  for (std::size_t i = 0; i < scenarios.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (scenarios[i].problem.name != scenarios[k].problem.name) continue;
      throw InputError(fmt::format("{} and {} have the same scenario name '{}'; nothing was run",
                                   scenarios[k].file.string(), scenarios[i].file.string(),
                                   scenarios[i].problem.name));
    }
  }
  return scenarios;
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
    overwrite(fmt::format("[{}/{}] {}", ++done_, total_, what));
  }

 private:
  void overwrite(const std::string& text) {
    constexpr const char* kClearLine = "\r\033[K";
    if (shown_) err_ << kClearLine << text << std::flush;
  }

  std::ostream& err_;
  bool shown_;
  std::size_t total_;
  std::size_t done_ = 0;
};

}  // namespace

void Console::error(std::string_view message) const {
  err << "bqsa-bench: error: " << message << std::endl;
}

Status run_command(const RunOptions& options, const Console& console) {
  if (options.directory.empty()) throw InputError("--out: expected a directory, got nothing");
  const std::vector<MethodSpec> specs = chosen_methods(options.methods);
  std::vector<std::string> refused;
  const std::vector<Scenario> scenarios = load_all(options.scenarios, console, refused);
  ResultStore store(options.directory);
  const Circumstances circumstances{.settings = {}, .command_line = options.command_line};

  std::vector<TableRow> rows;
  bool lost = false;
  {
    Progress progress(console, !options.quiet, scenarios.size() * specs.size());
    for (const Scenario& scenario : scenarios) {
      const Judge judge(scenario.problem);
      for (const MethodSpec& spec : specs) {
        progress.next(scenario.problem.name + " " + variant_name(spec));
        try {
          const StoredRun run = run_pair(scenario, judge, spec, circumstances, store);
          rows.push_back(parse_run_record(run.record));
          if (run.trajectory_error.empty()) continue;
          console.error(run.trajectory_error);
          lost = true;
        } catch (const InputError& error) {
          console.error(error.what());
          lost = true;
        }
      }
    }
  }
  if (!options.quiet && !rows.empty()) console.out << render_table(rows) << std::flush;

  bool failed = false;
  for (const TableRow& row : rows) failed = failed || (row.applicable && !row.success);
  if (!refused.empty()) {
    console.error(fmt::format("{} of {} scenarios refused, no runs of them:", refused.size(),
                              options.scenarios.size()));
    for (const std::string& message : refused) console.err << "  " << message << '\n';
  }
  if (lost || !refused.empty()) return kBadInput;
  return options.strict && failed ? kRunFailed : kOk;
}

}  // namespace bqsa::harness
