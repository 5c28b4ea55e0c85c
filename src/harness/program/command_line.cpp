#include "harness/program/command_line.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <functional>
#include <limits>
#include <ostream>
#include <string_view>

#include "harness/methods.hpp"
#include "harness/program/external_methods.hpp"
#include "harness/results/provenance.hpp"

namespace bqsa::harness {
namespace {

constexpr const char* kFooter =
    "Exit status: 0 done, 1 a run failed (with --strict), a law is broken (conform), something "
    "got\n"
    "worse (compare) or a claim no longer holds (claims), 2 bad input or results not written.";

constexpr int kMostGenerated = 100'000;  // the index in a name has five digits

constexpr int kMostProcesses = 1000;
constexpr double kLargestThreshold = 100;
constexpr double kMostNoise = 1;  // [rad]
constexpr int kMostSeeds = 10'000;
constexpr double kMostSeconds = 1e6;
constexpr int kMostMebibytes = 1 << 24;

/// A word of the command line as a shell would need it.
std::string quoted(std::string_view word) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,./@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string_view::npos) {
    return std::string(word);
  }
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string command_line_text(int argc, const char* const* argv) {
  std::string text = std::filesystem::path(argv[0]).filename().string();
  for (int i = 1; i < argc; ++i) text += " " + quoted(argv[i]);
  return text;
}

/// What the options are read into, and the command that was chosen.
struct CommandLine {
  std::vector<MethodEntry> methods;    ///< of this program
  std::vector<std::string> externals;  ///< `NAME=COMMAND`
  RunOptions run;
  GenerateOptions generate;
  StepOptions step;
  ConformOptions conform;
  FiguresOptions figures;
  MeasureOptions measure;
  CompareOptions compare;
  ClaimsOptions claims;
  std::filesystem::path claims_result;
  std::filesystem::path claims_into;
  ReportOptions report;
  std::filesystem::path scenario_directory;
  std::filesystem::path results_directory;
  std::filesystem::path scenario;
  std::filesystem::path trajectory;
  std::vector<std::filesystem::path> files;
  std::string method_name;
  std::filesystem::path tree = ".";
  bool strict = false;
  bool quick = false;  ///< what measure does anyway
  std::function<Status(const Console&)> command;

  std::vector<MethodEntry> known() const { return with_externals(methods, externals); }
};

CLI::App* add_command(CLI::App& app, const char* name, const char* description) {
  CLI::App* command = app.add_subcommand(name, description);
  command->set_version_flag("--version", app.version());
  command->footer(kFooter);
  return command;
}

void add_external_option(CLI::App& command, std::vector<std::string>& externals) {
  command
      .add_option("--external", externals,
                  "A program as method, NAME=COMMAND, as \"mine=python3 mine.py\"; repeatable\n"
                  "(docs/external-methods.md)")
      ->allow_extra_args(false);
}

void add_report_options(CLI::App& command, ReportOptions& report) {
  CLI::Option* summary =
      command.add_flag("--summary", report.summary,
                       "Print rates, causes of failure and times by family instead of the table\n"
                       "[from 13 scenarios on]");
  command.add_flag("--table", report.table, "Print the table [up to 12 scenarios]")
      ->excludes(summary);
  command.add_flag("--failures", report.failures, "List every failed run too");
}

void declare(CLI::App& app, CommandLine& line) {
  app.set_version_flag("--version", "bqsa-bench " + version_text(names_out_of_tree(line.methods)));
  app.footer(kFooter);
  app.require_subcommand(1);

  CLI::App* list =
      add_command(app, "list", "List methods with their parameters, families, scenarios");
  list->add_option("--scenarios", line.scenario_directory,
                   "Directory of scenario files [./scenarios]");
  add_external_option(*list, line.externals);
  list->callback([&line] {
    line.command = [&line](const Console& console) {
      return list_command(line.known(), line.scenario_directory, console);
    };
  });

  CLI::App* run = add_command(app, "run", "Run methods on scenarios, judge them, print the table");
  run->add_option("SCENARIO", line.run.scenarios,
                  "Scenario files, or directories with files *.yaml")
      ->required();
  run->add_option("--method,-m", line.run.methods,
                  "Method with parameters, M[:key=value,...], as bqsa:increment=1e-3; see list;\n"
                  "repeatable [all methods]")
      ->allow_extra_args(false);
  add_external_option(*run, line.externals);
  run->add_option("--out,-o", line.run.directory,
                  "Results directory; runs are added to an existing one, and the last of a\n"
                  "scenario and method counts, in the table and as trajectory")
      ->required();
  run->add_flag("--strict", line.run.strict, "Exit with 1 if a run is not judged a success");
  run->add_flag("--quiet,-q", line.run.quiet, "Print neither progress nor table");
  run->add_flag("!--no-trajectories", line.run.trajectories, "Do not store the trajectories");
  run->add_option("--joint-noise", line.run.joint_noise,
                  "Standard deviation of normal noise on the joint angles that reactive methods\n"
                  "are told [rad] [none]")
      ->check(CLI::Range(0.0, kMostNoise));
  run->add_flag("--latency", line.run.latency,
                "Tell reactive methods the joint angles of one tick ago");
  run->add_option("--seed", line.run.seed, "Seed of the noise and of planning methods [1]")
      ->check(CLI::NonNegativeNumber);
  run->add_option(
         "--seeds", line.run.seeds,
         "Run planning methods so many times, with --seed and the seeds that follow it [1]")
      ->check(CLI::Range(1, kMostSeeds));
  run->add_option("--plan-budget", line.run.plan_budget,
                  "Wall time that planning methods may use for a plan [s] [10]")
      ->check(CLI::Range(1e-3, kMostSeconds));
  run->add_option("--time-limit", line.run.time_limit,
                  "Wall time after which a run is stopped [s] [120]")
      ->check(CLI::Range(1e-2, kMostSeconds));
  run->add_option("--memory-limit", line.run.memory_limit,
                  "Memory that a run may have beyond the program's own [MiB] [4096]")
      ->check(CLI::Range(1, kMostMebibytes));
  run->add_flag("--in-process", line.run.in_process,
                "Run methods in this process, without limits, for a profiler or debugger");
  add_report_options(*run, line.run.report);
  run->callback([&line] {
    line.command = [&line](const Console& console) {
      return run_command(line.known(), line.run, console);
    };
  });

  CLI::App* show = add_command(app, "show", "Print the table of a results directory");
  show->add_option("DIR", line.results_directory, "Results directory")->required();
  add_report_options(*show, line.report);
  show->callback([&line] {
    line.command = [&line](const Console& console) {
      return show_command(line.results_directory, line.report, console);
    };
  });

  CLI::App* step =
      add_command(app, "step", "Repeat one tick of a method: what it does, how long it takes");
  step->add_option("SCENARIO", line.step.scenario, "Scenario file")->required();
  step->add_option("--method,-m", line.step.method, "Method with parameters, as for run")
      ->required();
  add_external_option(*step, line.externals);
  CLI::Option* slowest = step->add_option(
      "--slowest", line.step.slowest,
      "Results directory: the slowest tick of this scenario and method, undisturbed");
  CLI::Option* tick = step->add_option("--tick", line.step.tick, "Tick, from 1")
                          ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  CLI::Option* state = step->add_option(
      "--state", line.step.state,
      "Joint angles before that tick: q1,...,qn [rad], or a trajectory file that has them");
  tick->needs(state)->excludes(slowest);
  state->needs(tick)->excludes(slowest);
  step->callback([&line] {
    line.command = [&line](const Console& console) {
      return step_command(line.known(), line.step, console);
    };
  });

  CLI::App* conform =
      add_command(app, "conform", "Check what the contract asks of every method, law by law");
  conform
      ->add_option("SCENARIO", line.conform.scenarios,
                   "Scenario files, or directories with files *.yaml")
      ->required();
  conform
      ->add_option("--method,-m", line.conform.methods,
                   "Method with parameters, as for run; repeatable")
      ->required()
      ->allow_extra_args(false);
  add_external_option(*conform, line.externals);
  conform
      ->add_option("--plan-budget", line.conform.plan_budget,
                   "Wall time that planning methods may use for a plan [s] [10]")
      ->check(CLI::Range(1e-3, kMostSeconds));
  conform->callback([&line] {
    line.command = [&line](const Console& console) {
      return conform_command(line.known(), line.conform, console);
    };
  });

  CLI::App* judge = add_command(app, "judge", "Judge any trajectory of a scenario");
  judge->add_option("SCENARIO", line.scenario, "Scenario file")->required();
  judge
      ->add_option("TRAJECTORY", line.trajectory,
                   "CSV file t,q1..qn [s, rad], one row for each of the ticks and the start")
      ->required();
  judge->add_flag("--strict", line.strict, "Exit with 1 if it is not a success [0 all the same]");
  judge->callback([&line] {
    line.command = [&line](const Console& console) {
      return judge_command(line.scenario, line.trajectory, line.strict, console);
    };
  });

  CLI::App* measure = add_command(
      app, "measure", "Measure detectors and control steps over sizes (docs/measuring.md)");
  measure
      ->add_option("--out,-o", line.measure.out,
                   "File for the measurements, Google Benchmark's JSON")
      ->required();
  CLI::Option* quick = measure->add_flag("--quick", line.quick, "One or two minutes [the default]");
  measure
      ->add_flag("--full", line.measure.full, "More, longer blocks and more processes: ten minutes")
      ->excludes(quick);
  measure
      ->add_option("--sweep", line.measure.sweeps,
                   "plane_nm, plane_nk, space_nm, space_nk: passes of detectors; step_nk,\n"
                   "space_step_nk: control steps of methods; repeatable [all]")
      ->allow_extra_args(false);
  measure
      ->add_option("--processes", line.measure.processes,
                   "Processes, one after the other; intervals need two [4, --full: 10]")
      ->check(CLI::Range(1, kMostProcesses));
  measure
      ->add_option("--process", line.measure.process,
                   "Be the one process of this number: measure here, write --out, print nothing")
      ->check(CLI::Range(1, kMostProcesses));
  measure->callback([&line] {
    line.command = [&line](const Console& console) {
      return measure_command(line.measure, console);
    };
  });

  CLI::App* compare =
      add_command(app, "compare", "Compare old and new results (docs/measuring.md)");
  compare
      ->add_option("OLD", line.compare.before,
                   "Results directory, or JSON file of measure or any Google Benchmark program")
      ->required()
      ->check(CLI::ExistingPath);
  compare->add_option("NEW", line.compare.after, "The same kind of thing")
      ->required()
      ->check(CLI::ExistingPath);
  compare
      ->add_option("--threshold", line.compare.threshold,
                   "A time is worse if the whole interval of new / old is above this [1.10]")
      ->check(CLI::Range(1.0, kLargestThreshold));
  compare->add_flag("--all", line.compare.all, "Print ties too");
  compare->callback([&line] {
    line.command = [&line](const Console& console) {
      return compare_command(line.compare, console);
    };
  });

  CLI::App* claims = add_command(
      app, "claims", "Evaluate the paper's claims: figures, bounds, verdicts (docs/claims.md)");
  CLI::Option* quick_claims =
      claims->add_flag("--quick", line.quick, "Two or three minutes [the default]");
  claims->add_flag("--full", line.claims.full, "More samples and processes: a quarter of an hour")
      ->excludes(quick_claims);
  claims->add_option("--claims", line.claims.claims, "Claims file [./claims.yaml]");
  claims->add_option("--measurements", line.claims.measurements,
                     "Times as measure wrote them [measured afresh]");
  claims->add_option("--only", line.claims.only, "Id of a claim, shown in full; repeatable [all]")
      ->allow_extra_args(false);
  claims->add_option("--scenarios", line.claims.scenarios, "Directory of scenarios [./scenarios]");
  claims->add_option("--out,-o", line.claims.directory, "Directory for claims.json and claims.md");
  CLI::Option* render = claims->add_option("--render", line.claims_result,
                                           "Evaluate nothing: print this claims.json as Markdown");
  claims
      ->add_option("--into", line.claims_into,
                   "With --render: replace what stands between <!-- claims --> and\n"
                   "<!-- /claims --> of this file")
      ->needs(render);
  claims->callback([&line] {
    line.command = [&line](const Console& console) {
      return line.claims_result.empty()
                 ? claims_command(line.methods, line.claims, console)
                 : render_claims_command(line.claims_result, line.claims_into, console);
    };
  });

  CLI::App* generate =
      add_command(app, "generate", "Write random scenarios of a family (docs/generator.md)");
  generate->add_option("--family", line.generate.family, "Family of scenarios, see list")
      ->required();
  generate->add_option("--count", line.generate.count, "Number of scenarios, at most 100000")
      ->required()
      ->check(CLI::Range(1, kMostGenerated));
  generate->add_option("--seed", line.generate.seed, "Seed; file k is the same for every count")
      ->required()
      ->check(CLI::NonNegativeNumber);
  generate
      ->add_option("--out,-o", line.generate.directory,
                   "Directory for the files; other content in it is not overwritten")
      ->required();
  generate->add_option("--robots", line.generate.robots,
                       "Directory of robot files, for families with spatial arms [./robots]");
  generate->add_flag("--witnesses", line.generate.witnesses,
                     "Write a solution beside each scenario too, FILE.witness.csv, for judge");
  generate->callback([&line] {
    line.command = [&line](const Console& console) {
      return generate_command(line.generate, console);
    };
  });

  CLI::App* figures =
      add_command(app, "figures", "Draw the paper's figures from our own runs and measurements");
  figures
      ->add_option("--out,-o", line.figures.directory,
                   "Directory for the figures: CSV, gnuplot script, SVG and PNG of each")
      ->required();
  figures->add_option("--scenarios", line.figures.scenarios,
                      "Directory with the paper's scenarios [./scenarios]");
  CLI::Option* measurements = figures->add_option(
      "--measurements", line.figures.measurements,
      "Measurements for the figures of times, a file that measure wrote [measured\n"
      "now, about two minutes]");
  figures
      ->add_flag("!--without-times", line.figures.times,
                 "Leave out the figures of times, and measure nothing")
      ->excludes(measurements);
  figures->callback([&line] {
    line.command = [&line](const Console& console) {
      return figures_command(line.figures, console);
    };
  });

  CLI::App* new_method = add_command(
      app, "new-method", "Write a method that works, with its test, into the source tree");
  new_method->add_option("NAME", line.method_name, "Its name, [a-z][a-z0-9_]*")->required();
  new_method->add_option("--tree", line.tree, "Source tree of the project [.]");
  new_method->callback([&line] {
    line.command = [&line](const Console& console) {
      return new_method_command(line.methods, line.method_name, line.tree, console);
    };
  });

  CLI::App* validate = add_command(app, "validate", "Check scenario files without running");
  validate->add_option("FILE", line.files, "Scenario files, or directories with files *.yaml")
      ->required();
  validate->callback([&line] {
    line.command = [&line](const Console& console) {
      return validate_command(line.files, console);
    };
  });
}

}  // namespace

int run_program(int argc, const char* const* argv, const Console& console,
                const std::vector<MethodEntry>& added) {
  try {
    CLI::App app("Compares inverse-kinematics methods with obstacle avoidance on the same problems",
                 "bqsa-bench");
    CommandLine line;
    line.methods = add_methods(added);
    line.run.command_line = command_line_text(argc, argv);
    line.figures.command_line = line.run.command_line;
    line.measure.command_line = line.run.command_line;
    line.claims.command_line = line.run.command_line;
    declare(app, line);
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      const bool asked_for = error.get_exit_code() == 0;  // --help, --version
      if (asked_for) return app.exit(error, console.out, console.err);
      const std::vector<std::string> unknown = app.remaining();
      const bool no_command = app.get_subcommands().empty() && !unknown.empty();
      console.error(
          no_command ? fmt::format("unknown command or option '{}' (see --help)", unknown.front())
                     : fmt::format("{} (see --help)", error.what()));
      return kBadInput;
    }
    return line.command(console);
  } catch (const std::exception& error) {
    console.error(error.what());
  } catch (...) {
    console.error("something was thrown that is not a std::exception");
  }
  return kBadInput;
}

}  // namespace bqsa::harness
