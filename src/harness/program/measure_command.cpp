#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "bqsa/batch/instruction_set.hpp"
#include "harness/measuring/measure_processes.hpp"
#include "harness/measuring/measurements.hpp"
#include "harness/measuring/other_work.hpp"
#include "harness/measuring/run_sweep.hpp"
#include "harness/program/commands.hpp"
#include "harness/results/text_table.hpp"
#include "harness/text_file.hpp"

namespace bqsa::harness {
namespace {

constexpr int kQuickProcesses = 4;
constexpr int kFullProcesses = 10;

int processes_of(const MeasureOptions& options) {
  if (options.processes > 0) return options.processes;
  return options.full ? kFullProcesses : kQuickProcesses;
}

std::vector<std::string> chosen_sweeps(const MeasureOptions& options) {
  if (!options.sweeps.empty()) return options.sweeps;
  return {sweep_names().begin(), sweep_names().end()};
}

/// This process's share.
std::vector<Sweep> measure_here(const MeasureOptions& options, const Console& console) {
  SweepSettings settings = options.full ? full_sweeps() : quick_sweeps();
  settings.contest.seed = static_cast<std::uint64_t>(options.process);
  settings.paper_protocol = options.process == 1;
  constexpr const char* kClearLine = "\r\033[K";
  const SweepProgress progress = [&](const std::string& what) {
    if (!console.terminal) return;
    console.err << fmt::format("{}[process {}/{}] {}", kClearLine, options.process,
                               processes_of(options), what)
                << std::flush;
  };
  std::vector<Sweep> sweeps;
  for (const std::string& name : chosen_sweeps(options)) {
    sweeps.push_back(run_sweep(name, settings, progress));
  }
  if (console.terminal) console.err << kClearLine << std::flush;
  return sweeps;
}

/// Another process of this program, for measure_processes().
std::vector<std::string> own_command(const MeasureOptions& options) {
  std::vector<std::string> words{"/proc/self/exe", "measure", options.full ? "--full" : "--quick",
                                 "--processes", std::to_string(processes_of(options))};
  for (const std::string& sweep : options.sweeps) {
    words.emplace_back("--sweep");
    words.push_back(sweep);
  }
  return words;
}

std::string rounded_text(double value) { return std::isfinite(value) ? figure(value) : "?"; }

std::string range_text(const Interval& interval) {
  if (!std::isfinite(interval.lower) || !std::isfinite(interval.upper)) return "";
  return fmt::format("{:.3f} .. {:.3f}", interval.lower, interval.upper);
}

/// `12.4 (11 .. 14)`, `< 1`, `-` where it takes longer nowhere; nothing for what does not look at test
/// points, whose times are flat.
std::string crossover_text(const Sweep& sweep, const std::string& name, const char* rival) {
  if (!name.starts_with("test_points") || sweep.axis != SweepAxis::kPointPairs) return "";
  if (sweep.find(rival) == nullptr) return "";
  const std::optional<Estimate> found = crossover(sweep, name, rival);
  if (!found) return "-";
  if (found->value == 0) return fmt::format("< {}", rounded_text(found->interval.upper));
  if (!std::isfinite(found->interval.upper)) return rounded_text(found->value);
  return fmt::format("{} ({} .. {})", rounded_text(found->value),
                     rounded_text(found->interval.lower), rounded_text(found->interval.upper));
}

void add_sweep(const Sweep& sweep, TextTable& table) {
  constexpr double kNanosecond = 1e-9;
  const bool steps = is_of_steps(sweep.name);
  const std::size_t last = sweep.sizes.size() - 1;
  table.add_heading(fmt::format("{}: {}, {} from {:.0f} to {:.0f}", sweep.name,
                                steps ? "a control step" : "a pair of link and obstacle",
                                sweep.axis == SweepAxis::kPointPairs ? "NM" : "nk", sweep.at(0),
                                sweep.at(last)));
  for (const Series& series : sweep.series) {
    const auto time_at = [&](std::size_t size) {
      if (!series.measured(size)) return std::string("-");
      return figure(series.median(size) / kNanosecond / (steps ? 1 : sweep.sizes[size].pairs()));
    };
    if (is_at_one_size(sweep.name)) {
      table.add_row({"  " + series.name, time_at(0), time_at(last), "-", "", "", ""});
      continue;
    }
    const Estimate exponent = time_exponent(sweep, series.name, exponents_from(sweep));
    table.add_row(
        {"  " + series.name, time_at(0), time_at(last), fmt::format("{:.3f}", exponent.value),
         range_text(exponent.interval), crossover_text(sweep, series.name, "bqsa"),
         crossover_text(sweep, series.name,
                        sweep.sizes[0].dimension == 2 ? "bqsa_paper" : "bqsa_projections")});
  }
}

void print(const Measurements& measurements, std::ostream& out) {
  const std::string note = indicative_note(measurements.origin.against);
  TextTable table({{.head = "", .unit = ""},
                   {.head = "smallest", .unit = "[ns]"},
                   {.head = "largest", .unit = "[ns]"},
                   {.head = "exponent", .unit = ""},
                   {.head = "95 % interval", .unit = "", .left = false, .optional = true},
                   {.head = "slower from NM on", .unit = "than bqsa", .optional = true},
                   {.head = "slower from NM on", .unit = "than the paper's", .optional = true}});
  for (const Sweep& sweep : measurements.sweeps) add_sweep(sweep, table);
  out << note << table.text()
      << "\nTimes are medians over processes of those in a typical round, processor time of the "
         "thread. "
         "Exponent of\nNM or nk, over the upper half of the sizes; intervals over processes.\n"
      << note;
}

}  // namespace

Status measure_command(const MeasureOptions& options, const Console& console) {
  { const StagedTextFile can_be_written(options.out, ""); }
  for (const std::string& name : options.sweeps) {
    const auto known = sweep_names();
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw InputError(
        fmt::format("--sweep: expected one of {}, got '{}'", fmt::join(known, ", "), name));
  }
  Measurements measurements{.origin = {.build = build_info(),
                                       .before = machine_state(),
                                       .instruction_set = std::string(instruction_set().name),
                                       .effort = options.full ? "full" : "quick",
                                       .command_line = options.command_line,
                                       .against = {}},
                            .sweeps = {}};
  const OtherWork other_work;
  const bool is_one_of_several = options.process > 0;
  measurements.sweeps = is_one_of_several
                            ? measure_here(options, console)
                            : measure_processes(own_command(options), processes_of(options));
  measurements.origin.other_cores = other_work.cores();
  measurements.origin.against = reasons_against_measuring(build_info(), measurements.origin.before,
                                                          measurements.origin.other_cores);
  write_text_file(options.out, measurements_json(measurements));
  if (!is_one_of_several) print(measurements, console.out);
  return kOk;
}

}  // namespace bqsa::harness
