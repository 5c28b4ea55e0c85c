#include "harness/program/declare_commands.hpp"

namespace bqsa::harness {
namespace {

constexpr int kMostProcesses = 1000;
constexpr double kLargestThreshold = 100;

void declare_measure(CLI::App& app, CommandLine& line) {
  CLI::App* measure = add_command(
      app, "measure", "Measure detectors and control steps over sizes (docs/measuring.md)");
  measure
      ->add_option("--out,-o", line.measure.out,
                   "File for the measurements, Google Benchmark's JSON")
      ->required();
  CLI::Option* quick = measure->add_flag("--quick", line.quick, "A minute [the default]");
  measure
      ->add_flag("--full", line.measure.full, "More, longer blocks and more processes: ten minutes")
      ->excludes(quick);
  measure
      ->add_option("--sweep", line.measure.sweeps,
                   "plane_nm, plane_nk, space_nm, space_nk: passes of detectors; step_nk,\n"
                   "space_step_nk: control steps of methods; speed_pairs, speed_steps: for the\n"
                   "claims on speed; gate: the measuring itself; repeatable [all]")
      ->allow_extra_args(false);
  measure
      ->add_option("--processes", line.measure.processes,
                   "Processes, one after the other; intervals need two [4, --full: 10]")
      ->check(CLI::Range(1, kMostProcesses));
  measure
      ->add_option("--process", line.measure.process,
                   "Be the one process of this number: measure here, write --out, print nothing")
      ->check(CLI::Range(1, kMostProcesses));
  on_choice(*measure, line,
            [&line](const Console& console) { return measure_command(line.measure, console); });
}

void declare_compare(CLI::App& app, CommandLine& line) {
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
  on_choice(*compare, line,
            [&line](const Console& console) { return compare_command(line.compare, console); });
}

void declare_claims(CLI::App& app, CommandLine& line) {
  CLI::App* claims = add_command(
      app, "claims", "Evaluate the paper's claims: figures, bounds, verdicts (docs/claims.md)");
  CLI::Option* quick_claims = claims->add_flag("--quick", line.quick, "Two minutes [the default]");
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
  on_choice(*claims, line, [&line](const Console& console) {
    return line.claims_result.empty()
               ? claims_command(line.methods, line.claims, console)
               : render_claims_command(line.claims_result, line.claims_into, console);
  });
}

void declare_figures(CLI::App& app, CommandLine& line) {
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
      "now, about a minute]");
  figures
      ->add_flag("!--without-times", line.figures.times,
                 "Leave out the figures of times, and measure nothing")
      ->excludes(measurements);
  on_choice(*figures, line,
            [&line](const Console& console) { return figures_command(line.figures, console); });
}

}  // namespace

void declare_measuring_commands(CLI::App& app, CommandLine& line) {
  declare_measure(app, line);
  declare_compare(app, line);
  declare_claims(app, line);
  declare_figures(app, line);
}

}  // namespace bqsa::harness
