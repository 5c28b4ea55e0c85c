#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <ostream>
#include <sstream>

#include "harness/figures/criteria_figures.hpp"
#include "harness/figures/figure_writer.hpp"
#include "harness/figures/gnuplot.hpp"
#include "harness/figures/miss_rate_figure.hpp"
#include "harness/figures/posture_figures.hpp"
#include "harness/figures/sweep_figures.hpp"
#include "harness/figures/tracking_figures.hpp"
#include "harness/figures/trajectory_figures.hpp"
#include "harness/measuring/detector.hpp"
#include "harness/measuring/measurements.hpp"
#include "harness/measuring/run_sweep.hpp"
#include "harness/program/commands.hpp"
#include "harness/results/provenance.hpp"

namespace bqsa::harness {
namespace {

/// Figs. 8 to 12 of the paper.
void write_planar_figures(const Scenario& planar, FigureWriter& writer) {
  const JudgedRun paper = judged_run(planar, "bqsa_paper");
  const JudgedRun exact = judged_run(planar, "bqsa");
  writer.write(planar_configurations(paper, exact));
  writer.write(planar_criteria(paper, "fig09_planar_criteria"));
  writer.write(planar_criteria(exact, "fig09_planar_criteria_exact"));
  writer.write(planar_trajectory(paper, exact));
  writer.write(planar_errors(paper, exact));
  writer.write(planar_joint_angles(paper, exact));
}

/// Figs. 14 to 20.
void write_spatial_figures(const Scenario& ellipsoid, const Scenario& wall, FigureWriter& writer) {
  const JudgedRun projection = judged_run(ellipsoid, "bqsa_projection");
  const JudgedRun exact = judged_run(ellipsoid, "bqsa");
  writer.write(projected_configurations(projection, exact));
  writer.write(spatial_configurations(projection, exact));
  writer.write(spatial_criteria(projection, exact));
  writer.write(spatial_trajectory(projection, exact));
  writer.write(spatial_errors(projection, exact));
  writer.write(spatial_joint_angles(projection, exact));
  writer.write(wall_configurations(judged_run(wall, "bqsa_projection"), judged_run(wall, "bqsa")));
}

constexpr std::uint64_t kMissRateSeed = 1;

/// @throws InputError if it is no sweep of ours, or one of something that is no detector
void require_detectors(const Sweep& sweep) {
  const auto known = sweep_names();
  if (std::find(known.begin(), known.end(), sweep.name) == known.end()) {
    throw InputError(fmt::format("measurements: expected sweeps {}, got '{}'",
                                 fmt::join(known, ", "), sweep.name));
  }
  for (const Series& series : sweep.series) {
    try {
      detector_named(series.name);
    } catch (const InputError& error) {
      throw InputError(fmt::format("measurements: {}: {}", sweep.name, error.what()));
    }
  }
}

bool measured_everywhere(const Series& series) {
  return std::none_of(series.seconds.begin(), series.seconds.end(),
                      [](const std::vector<double>& processes) { return processes.empty(); });
}

/// @throws InputError if the figures of a sweep of detectors in the plane cannot be made of it
void require_paper_series(const Sweep& sweep) {
  constexpr std::size_t kFewestSizes = 6;
  for (const char* name : {"test_points", "bqsa_paper"}) {
    const Series* series = sweep.find(name);
    const bool complete = series != nullptr && sweep.sizes.size() >= kFewestSizes &&
                          measured_everywhere(*series) &&
                          series->paper_seconds.size() == sweep.sizes.size() &&
                          series->paper_passes.size() == sweep.sizes.size();
    if (complete) continue;
    throw InputError(fmt::format(
        "measurements: {}: expected {} at {} sizes or more, by the paper's protocol too, got less",
        sweep.name, name, kFewestSizes));
  }
}

/// Figs. 5 and 6 and what belongs to them, of the sweeps that are there.
void write_measured_figures(const Measurements& measurements, FigureWriter& writer) {
  const TimesOrigin origin = times_origin(measurements.origin);
  for (const Sweep& sweep : measurements.sweeps) {
    if (is_at_one_size(sweep.name)) continue;
    if (is_of_steps(sweep.name)) {
      writer.write(step_times(sweep, origin));
      continue;
    }
    require_detectors(sweep);
    const bool in_plane = sweep.sizes.front().dimension == 2;
    if (in_plane) require_paper_series(sweep);
    const MissRates misses = miss_rates(sweep, kMissRateSeed);
    if (in_plane) {
      writer.write(paper_times(sweep, misses, origin));
      writer.write(estimated_times(sweep, misses, origin));
    }
    writer.write(fair_times(sweep, misses, origin));
    if (sweep.axis != SweepAxis::kPointPairs) continue;
    writer.write(times_against_miss_rate(sweep, misses, origin));
  }
}

/// Measures in processes of its own, as `measure` does; what that prints is left out.
Measurements measure_now(const FiguresOptions& options, const Console& console) {
  std::ostringstream printed;
  MeasureOptions measure;
  measure.out = options.directory / "measurements.json";
  measure.command_line = options.command_line;
  measure_command(measure, {printed, console.err, console.terminal});
  return read_measurements(measure.out);
}

}  // namespace

Status figures_command(const FiguresOptions& options, const Console& console) {
  const Scenario planar = load_scenario(options.scenarios / "planar_7r.yaml");
  const Scenario ellipsoid = load_scenario(options.scenarios / "puma560_ellipsoid.yaml");
  const Scenario wall = load_scenario(options.scenarios / "puma560_wall.yaml");
  const std::filesystem::path gnuplot = find_gnuplot();
  FigureWriter writer(options.directory, gnuplot);
  if (options.times) {
    const Measurements measurements = options.measurements.empty()
                                          ? measure_now(options, console)
                                          : read_measurements(options.measurements);
    write_measured_figures(measurements, writer);
    for (const std::string_view name : sweep_names()) {
      if (is_at_one_size(name) || measurements.find(name) != nullptr) continue;
      console.out << fmt::format("no times of {}: its figures are left out\n", name);
    }
  }
  write_planar_figures(planar, writer);
  write_spatial_figures(ellipsoid, wall, writer);
  writer.write_index("# Figures\n\nMade by bqsa-bench " + version_text() +
                     ". To change one, edit its script and run `gnuplot NAME.gp` here.\n");
  console.out << fmt::format("{}: wrote {} figures, see index.md\n", options.directory.string(),
                             writer.figures());
  if (gnuplot.empty()) {
    console.out
        << "gnuplot was not found: pictures are left out, data and scripts are there; install "
           "gnuplot-nox and run this again, or `gnuplot NAME.gp` in the directory\n";
  }
  return kOk;
}

}  // namespace bqsa::harness
