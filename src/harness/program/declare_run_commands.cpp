#include "harness/program/declare_commands.hpp"

#include <limits>

namespace bqsa::harness {
namespace {

constexpr int kMostGenerated = 100'000;  // the index in a name has five digits
constexpr double kMostNoise = 1;         // [rad]
constexpr int kMostSeeds = 10'000;
constexpr double kMostSeconds = 1e6;
constexpr int kMostJobs = 1024;
constexpr int kMostShards = 100'000;
constexpr int kMostMebibytes = 1 << 24;
constexpr int kMostReplays = 100'000;

void add_external_option(CLI::App& command, std::vector<std::string>& externals) {
  command
      .add_option("--external", externals,
                  "A program as method, NAME=COMMAND, as \"mine=python3 mine.py\"; repeatable\n"
                  "(docs/external-methods.md)")
      ->allow_extra_args(false);
}

void add_load_options(CLI::App& command, LoadOptions& load) {
  command.add_flag("--allow-outside", load.allow_outside,
                   "Let scenarios name files outside of their own directories");
}

void add_report_options(CLI::App& command, ReportOptions& report) {
  CLI::Option* summary =
      command.add_flag("--summary", report.summary,
                       "Print rates, causes of failure and times by family instead of the table\n"
                       "[from 13 scenarios on]");
  command.add_flag("--table", report.table, "Print the table [up to 12 scenarios]")
      ->excludes(summary);
  command.add_flag("--failures", report.failures, "List every failed run too");
  command.add_flag("--motion", report.motions,
                   "List drift, manipulability, self-motion and jerk of every run too");
}

void declare_list(CLI::App& app, CommandLine& line) {
  CLI::App* list =
      add_command(app, "list", "List methods with their parameters, families, scenarios");
  list->add_option("--scenarios", line.scenario_directory,
                   "Directory of scenario files [./scenarios]");
  add_external_option(*list, line.externals);
  on_choice(*list, line, [&line](const Console& console) {
    return list_command(line.known(), line.scenario_directory, console);
  });
}

/// What was given of some options.
std::vector<std::string> given(const std::vector<CLI::Option*>& options) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options) {
    if (option->count() > 0) names.push_back(option->get_name());
  }
  return names;
}

/// Options that say what is run, and how: a campaign says it itself.
std::vector<CLI::Option*> add_conditions(CLI::App& run, RunOptions& options) {
  return {run.add_option(
                 "--method,-m", options.methods,
                 "Method with parameters, M[:key=value,...], as bqsa:increment=1e-3; see list;\n"
                 "repeatable [all methods]")
              ->allow_extra_args(false),
          run.add_flag("!--no-trajectories", options.trajectories, "Do not store the trajectories"),
          run.add_option(
                 "--joint-noise", options.joint_noise,
                 "Standard deviation of normal noise on the joint angles that reactive methods\n"
                 "are told [rad] [none]")
              ->check(CLI::Range(0.0, kMostNoise)),
          run.add_flag("--latency", options.latency,
                       "Tell reactive methods the joint angles of one tick ago"),
          run.add_option("--seed", options.seed, "Seed of the noise and of planning methods [1]")
              ->check(CLI::NonNegativeNumber),
          run.add_option(
                 "--seeds", options.seeds,
                 "Run planning methods so many times, with --seed and the seeds that follow it [1]")
              ->check(CLI::Range(1, kMostSeeds)),
          run.add_option("--plan-budget", options.plan_budget,
                         "Wall time that planning methods may use for a plan [s] [10]")
              ->check(CLI::Range(1e-3, kMostSeconds)),
          run.add_option("--time-limit", options.time_limit,
                         "Wall time after which a run is stopped [s] [120]")
              ->check(CLI::Range(1e-2, kMostSeconds)),
          run.add_option("--memory-limit", options.memory_limit,
                         "Memory that a run may have beyond the program's own [MiB] [4096]")
              ->check(CLI::Range(1, kMostMebibytes)),
          run.add_flag("--in-process", options.in_process,
                       "Run methods in this process, without limits, for a profiler or debugger")};
}

std::vector<CLI::Option*> add_campaign_options(CLI::App& run, RunOptions& options) {
  return {run.add_option("--jobs,-j", options.jobs,
                         "Campaign: so many runs side by side, each on a processor of its own\n"
                         "[as many as there are]")
              ->check(CLI::Range(1, kMostJobs)),
          run.add_option("--shard", options.shard,
                         "Campaign: only part k of N, as 3/8 (docs/campaigns.md)"),
          run.add_flag("--force", options.force, "Campaign: runs that are recorded, too"),
          run.add_option("--shuffle", options.shuffle,
                         "Campaign: in an order that is random by this seed")
              ->check(CLI::NonNegativeNumber)};
}

void declare_run(CLI::App& app, CommandLine& line) {
  CLI::App* run = add_command(app, "run", "Run methods on scenarios, judge them, print the table");
  run->add_option("SCENARIO", line.run.scenarios,
                  "Scenario files, or directories with files *.yaml; or a campaign, of which only\n"
                  "what is missing in the results directory is run")
      ->required();
  run->add_option("--out,-o", line.run.directory,
                  "Results directory; runs are added to an existing one, and the last of a\n"
                  "scenario and method counts, in the table and as trajectory")
      ->required();
  add_load_options(*run, line.run.load);
  const std::vector<CLI::Option*> conditions = add_conditions(*run, line.run);
  const std::vector<CLI::Option*> of_campaigns = add_campaign_options(*run, line.run);
  add_external_option(*run, line.externals);
  run->add_flag("--strict", line.run.strict, "Exit with 1 if a run is not judged a success");
  run->add_flag("--quiet,-q", line.run.quiet, "Print neither progress nor table");
  run->add_flag("!--no-report", line.run.page,
                "Do not write report.html into the results directory");
  add_report_options(*run, line.run.report);
  on_choice(*run, line, [&line, conditions, of_campaigns](const Console& console) {
    line.run.not_for_campaigns = given(conditions);
    line.run.for_campaigns = given(of_campaigns);
    line.run.shuffled = of_campaigns.back()->count() > 0;
    return run_command(line.known(), line.run, console);
  });
}

void declare_plan(CLI::App& app, CommandLine& line) {
  CLI::App* plan = add_command(app, "plan", "Check a campaign and list its runs, without running");
  plan->add_option("CAMPAIGN", line.run.scenarios, "Campaign file")->required()->expected(1);
  plan->add_option("--out,-o", line.run.directory, "Directory of the campaign")->required();
  add_load_options(*plan, line.run.load);
  add_external_option(*plan, line.externals);
  on_choice(*plan, line, [&line](const Console& console) {
    return plan_command(line.known(), line.run, console);
  });
}

void declare_status(CLI::App& app, CommandLine& line) {
  CLI::App* status = add_command(app, "status", "Print how much of a campaign is recorded");
  status->add_option("DIR", line.results_directory, "Directory of a campaign")->required();
  on_choice(*status, line, [&line](const Console& console) {
    return status_command(line.results_directory, console);
  });
}

void declare_missing(CLI::App& app, CommandLine& line) {
  CLI::App* missing =
      add_command(app, "missing", "Print the shards of a campaign of which runs are missing");
  missing->add_option("N", line.shards, "Number of shards")
      ->required()
      ->check(CLI::Range(1, kMostShards));
  missing->add_option("DIR", line.results_directory, "Directory of a campaign")->required();
  on_choice(*missing, line, [&line](const Console& console) {
    return missing_command(line.shards, line.results_directory, console);
  });
}

void declare_merge(CLI::App& app, CommandLine& line) {
  CLI::App* merge = add_command(app, "merge", "Put the shards of a campaign together");
  merge->add_option("DIR", line.files, "Directories of one campaign")->required();
  merge->add_option("--out,-o", line.results_directory, "Results directory; may be one of them")
      ->required();
  on_choice(*merge, line, [&line](const Console& console) {
    return merge_command(line.files, line.results_directory, console);
  });
}

void declare_show(CLI::App& app, CommandLine& line) {
  CLI::App* show = add_command(app, "show", "Print the table of a results directory");
  show->add_option("DIR", line.results_directory, "Results directory")->required();
  add_report_options(*show, line.report);
  show->add_flag("--sparklines", line.report.sparklines,
                 "Draw tip error and clearance over the ticks in the table, where the locale is\n"
                 "UTF-8 and the trajectories are there [on a terminal]");
  on_choice(*show, line, [&line](const Console& console) {
    return show_command(line.results_directory, line.report, console);
  });
}

void declare_report(CLI::App& app, CommandLine& line) {
  CLI::App* report =
      add_command(app, "report",
                  "Write results as one HTML file to look at, without a network (docs/report.md)");
  PageOptions& page = line.page;
  report->add_option("DIR", page.directory, "Results directory, of single runs or a campaign")
      ->required();
  report->add_option("--out,-o", page.page, "The file [DIR/report.html]");
  report->add_option("--measurements", page.measurements,
                     "Times as measure wrote them [DIR/measurements.json, if it is there]");
  report->add_option("--claims", page.claims,
                     "Claims as claims wrote them [DIR/claims/claims.json, if it is there]");
  report->add_option("--figures", page.figures,
                     "Directory that figures wrote, to link to [DIR/figures, if it is there]");
  report
      ->add_option("--scenarios", page.scenarios,
                   "Directory in which scenario files may lie now; repeatable [where they lay\n"
                   "when they were run, and DIR]")
      ->allow_extra_args(false);
  report->add_option("--replays", page.replays, "Motions to replay, at most [200]")
      ->check(CLI::Range(0, kMostReplays));
  add_load_options(*report, page.load);
  on_choice(*report, line, [&line](const Console& console) {
    return report_command(line.methods, line.page, console);
  });
}

void declare_export(CLI::App& app, CommandLine& line) {
  CLI::App* command =
      add_command(app, "export", "Write runs in the formats of others (docs/exchange.md)");
  command->add_option("DIR", line.exported.directory, "Results directory")->required();
  command->add_option("--ompl-log", line.exported.ompl_log,
                      "OMPL's benchmark log: a file *.log for one scenario, else a directory");
  command->add_option("--planner-arena", line.exported.planner_arena,
                      "Planner Arena's SQLite database, with columns and tables of our own");
  command->add_option("--csv", line.exported.csv, "A row a run, all figures");
  command->add_option("--google-benchmark", line.exported.google_benchmark,
                      "Times of successes as Google Benchmark's JSON");
  on_choice(*command, line,
            [&line](const Console& console) { return export_command(line.exported, console); });
}

void declare_step(CLI::App& app, CommandLine& line) {
  CLI::App* step =
      add_command(app, "step", "Repeat one tick of a method: what it does, how long it takes");
  step->add_option("SCENARIO", line.step.scenario, "Scenario file")->required();
  step->add_option("--method,-m", line.step.method, "Method with parameters, as for run")
      ->required();
  add_external_option(*step, line.externals);
  add_load_options(*step, line.step.load);
  CLI::Option* slowest = step->add_option(
      "--slowest", line.step.slowest,
      "Results directory: the slowest tick of this scenario and method, undisturbed\n"
      "(of a campaign: of all repetitions, as disturbed)");
  CLI::Option* tick = step->add_option("--tick", line.step.tick, "Tick, from 1")
                          ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  CLI::Option* state = step->add_option(
      "--state", line.step.state,
      "Joint angles before that tick: q1,...,qn [rad], or a trajectory file that has them");
  tick->needs(state)->excludes(slowest);
  state->needs(tick)->excludes(slowest);
  on_choice(*step, line, [&line](const Console& console) {
    return step_command(line.known(), line.step, console);
  });
}

void declare_conform(CLI::App& app, CommandLine& line) {
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
  add_load_options(*conform, line.conform.load);
  conform
      ->add_option("--plan-budget", line.conform.plan_budget,
                   "Wall time that planning methods may use for a plan [s] [10]")
      ->check(CLI::Range(1e-3, kMostSeconds));
  on_choice(*conform, line, [&line](const Console& console) {
    return conform_command(line.known(), line.conform, console);
  });
}

void declare_inspect(CLI::App& app, CommandLine& line) {
  CLI::App* inspect =
      add_command(app, "inspect-robot", "Print the chain of a robot: joints, limits, links, reach");
  inspect->add_option("FILE", line.inspect.file, "Scenario or robot file, or a robot in URDF")
      ->required();
  inspect->add_option("--base-link", line.inspect.base_link, "In URDF: the link that is at rest");
  inspect->add_option("--tip-link", line.inspect.tip_link, "In URDF: a link that hangs from it");
  inspect->add_flag("--capsules", line.inspect.capsules,
                    "In URDF: radii of the links that contain its collision geometry");
  add_load_options(*inspect, line.inspect.load);
  on_choice(*inspect, line, [&line](const Console& console) {
    return inspect_robot_command(line.inspect, console);
  });
}

void declare_judge(CLI::App& app, CommandLine& line) {
  CLI::App* judge = add_command(app, "judge", "Judge any trajectory of a scenario");
  judge->add_option("SCENARIO", line.scenario, "Scenario file")->required();
  judge
      ->add_option("TRAJECTORY", line.trajectory,
                   "CSV file t,q1..qn [s, rad], one row for each of the ticks and the start")
      ->required();
  add_load_options(*judge, line.load);
  judge->add_flag("--strict", line.strict, "Exit with 1 if it is not a success [0 all the same]");
  on_choice(*judge, line, [&line](const Console& console) {
    return judge_command(line.scenario, line.trajectory, line.load, line.strict, console);
  });
}

void declare_generate(CLI::App& app, CommandLine& line) {
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
  on_choice(*generate, line,
            [&line](const Console& console) { return generate_command(line.generate, console); });
}

void declare_import(CLI::App& app, CommandLine& line) {
  CLI::App* import = add_command(
      app, "import",
      "Make tracking problems of a published set of planning problems (docs/importing.md)");
  import->add_option("FILE", line.import.set, "Problem set of VAMP (JSON) or Robometrics (YAML)")
      ->required();
  import->add_option("--robot", line.import.robot, "Robot file, schema bqsa-robot/1")->required();
  import
      ->add_option("--out,-o", line.import.directory,
                   "Directory for the files; other content in it is not overwritten")
      ->required();
  import->add_option("--group", line.import.groups, "Groups of the set [all]");
  import->add_option("--count", line.import.count, "At most so many of each group [all]")
      ->check(CLI::Range(1, kMostGenerated));
  import->add_option("--seed", line.import.seed, "Of the planner of reference motions [1]")
      ->check(CLI::NonNegativeNumber);
  import->add_option("--clearance", line.import.clearance, "That references keep, in m [0.005]")
      ->check(CLI::Range(0.0, 1.0));
  import->add_option("--tolerance", line.import.tolerance, "Of the scenarios, in m [0.001]")
      ->check(CLI::Range(1e-9, 1.0));
  import->add_option("--margin", line.import.margin, "Of the scenarios, in m [0]")
      ->check(CLI::Range(0.0, 1.0));
  import->add_flag("--witnesses", line.import.witnesses,
                   "Write the reference motions too, FILE.witness.csv, for judge");
  on_choice(*import, line,
            [&line](const Console& console) { return import_command(line.import, console); });
}

void declare_new_method(CLI::App& app, CommandLine& line) {
  CLI::App* new_method = add_command(
      app, "new-method", "Write a method that works, with its test, into the source tree");
  new_method->add_option("NAME", line.method_name, "Its name, [a-z][a-z0-9_]*")->required();
  new_method->add_option("--tree", line.tree, "Source tree of the project [.]");
  on_choice(*new_method, line, [&line](const Console& console) {
    return new_method_command(line.methods, line.method_name, line.tree, console);
  });
}

void declare_validate(CLI::App& app, CommandLine& line) {
  CLI::App* validate = add_command(app, "validate", "Check scenario files without running");
  validate->add_option("FILE", line.files, "Scenario files, or directories with files *.yaml")
      ->required();
  add_load_options(*validate, line.load);
  on_choice(*validate, line, [&line](const Console& console) {
    return validate_command(line.files, line.load, console);
  });
}

}  // namespace

void declare_run_commands(CLI::App& app, CommandLine& line) {
  declare_list(app, line);
  declare_run(app, line);
  declare_plan(app, line);
  declare_status(app, line);
  declare_missing(app, line);
  declare_merge(app, line);
  declare_show(app, line);
  declare_report(app, line);
  declare_export(app, line);
  declare_step(app, line);
  declare_conform(app, line);
  declare_inspect(app, line);
  declare_judge(app, line);
  declare_generate(app, line);
  declare_import(app, line);
  declare_new_method(app, line);
  declare_validate(app, line);
}

}  // namespace bqsa::harness
