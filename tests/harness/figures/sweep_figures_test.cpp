// Figures of times, from sweeps that were made up so that all that is shown is known.
#include "harness/figures/sweep_figures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "figure_data.hpp"
#include "harness/figures/figure_writer.hpp"
#include "harness/figures/gnuplot.hpp"
#include "harness/figures/miss_rate_figure.hpp"
#include "harness/measuring/detector.hpp"
#include "harness/temporary_directory.hpp"

namespace bqsa::harness {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kMicrosecond = 1e-6;

/// Test points take 2 us a point pair, all others 25 us a pass, in three processes that differ by 0 and
/// +-1 %.
double made_up_time(std::string_view detector, const WorkloadSize& size, int process) {
  const bool sampled = detector.starts_with("test_points");
  return (sampled ? 2.0 * size.point_pairs() : 25.0) * kMicrosecond * (1 + 0.01 * (process - 1));
}

Sweep made_up_sweep(const std::string& name, SweepAxis axis, int dimension) {
  Sweep sweep{.name = name, .axis = axis, .sizes = {}, .series = {}};
  for (const int step : {1, 10, 100, 1000}) {
    sweep.sizes.push_back(axis == SweepAxis::kPointPairs ? workload_size(dimension, 27, step)
                                                         : workload_size(dimension, step, 600));
  }
  for (const Detector& detector : detectors()) {
    if (!(dimension == 2 ? detector.in_plane : detector.in_space)) continue;
    Series series{.name = std::string(detector.name), .seconds = {}, .paper_seconds = {}};
    for (const WorkloadSize& size : sweep.sizes) {
      series.seconds.push_back({});
      for (const int process : {0, 1, 2}) {
        series.seconds.back().push_back(made_up_time(detector.name, size, process));
      }
      series.paper_seconds.push_back(made_up_time(detector.name, size, 1) * 1.5);
      series.paper_passes.push_back(size.point_pairs() == 1000 ? 30 : 100);
    }
    sweep.series.push_back(series);
  }
  return sweep;
}

TimesOrigin made_up_origin() {
  MeasurementOrigin origin{.build = build_info(),
                           .before = {},
                           .instruction_set = "AVX2",
                           .effort = "quick",
                           .command_line = "x",
                           .against = {"a busy machine"}};
  return times_origin(origin);
}

TEST(SweepFigures, SayWhatTheirTimesAreWorth) {
  EXPECT_EQ(made_up_origin().against, "a busy machine");
  EXPECT_THAT(made_up_origin().caption, HasSubstr(build_info().commit.substr(0, 10)));
  const Figure figure =
      fair_times(made_up_sweep("plane_nm", SweepAxis::kPointPairs, 2), {}, made_up_origin());
  EXPECT_THAT(figure.drawing, HasSubstr("not publishable: a busy machine"));
  EXPECT_THAT(gnuplot_script(figure), HasSubstr("\n# bqsa-bench"));
  MeasurementOrigin clean;
  const Figure unmarked =
      fair_times(made_up_sweep("plane_nm", SweepAxis::kPointPairs, 2), {}, times_origin(clean));
  EXPECT_THAT(gnuplot_script(unmarked), Not(HasSubstr("not publishable")));
}

TEST(SweepFigures, ShowThePaperProtocolOnLinearAxes) {
  const Figure figure =
      paper_times(made_up_sweep("plane_nm", SweepAxis::kPointPairs, 2), {}, made_up_origin());
  EXPECT_EQ(figure.name, "fig05_time_against_nm");
  const ReadTable table = data_of(figure, "");
  ASSERT_EQ(table.rows.size(), 4);
  EXPECT_EQ(table.text(3, "NM"), "1000");
  EXPECT_NEAR(table.number(3, "test_points [us]"), 3000, 1e-6);
  EXPECT_NEAR(table.number(3, "bqsa_paper [us]"), 37.5, 1e-6);
  EXPECT_EQ(table.text(3, "test_points passes"), "30");
  EXPECT_THAT(figure.drawing, HasSubstr("nk = 27; mean of 30 to 100 passes"));
  EXPECT_THAT(figure.drawing, Not(HasSubstr("logscale xy")));
}

/// Three processes at 0.99, 1 and 1.01 times t: geometric mean t (1 - 1e-4)^(1/3), standard deviation of the
/// logarithms 0.0100003, t of two degrees of freedom 4.302653: 2.48 % either way.
TEST(SweepFigures, ShowIntervalsOverProcesses) {
  const Figure figure =
      fair_times(made_up_sweep("plane_nk", SweepAxis::kPairs, 2), {}, made_up_origin());
  EXPECT_EQ(figure.name, "fig06_fair");
  const ReadTable table = data_of(figure, "");
  EXPECT_NEAR(table.number(2, "bqsa [us]"), 25, 0.002);
  EXPECT_NEAR(table.number(2, "bqsa upper [us]") / table.number(2, "bqsa [us]"), 1.02515, 1e-4);
  EXPECT_NEAR(table.number(2, "bqsa [us]") / table.number(2, "bqsa lower [us]"), 1.02515, 1e-4);
}

TEST(SweepFigures, LeaveOutWhatWasNotMeasured) {
  Sweep sweep = made_up_sweep("plane_nm", SweepAxis::kPointPairs, 2);
  sweep.series[0].seconds[3].clear();
  for (Series& series : sweep.series) {
    for (std::vector<double>& processes : series.seconds) {
      if (!processes.empty()) processes = {processes.front()};
    }
  }
  const ReadTable table = data_of(fair_times(sweep, {}, made_up_origin()), "");
  EXPECT_EQ(table.text(3, sweep.series[0].name + " [us]"), "");
  EXPECT_NE(table.text(2, sweep.series[0].name + " [us]"), "");
  EXPECT_EQ(table.text(2, sweep.series[0].name + " lower [us]"), "");  // one process bounds nothing
}

/// 2 NM = 25 us: they cross at NM = 12.5 in all processes. Straight lines in log-log between 10 and 100 meet
/// there, too, for both are powers.
TEST(SweepFigures, MarkTheCrossoverAndTheLines) {
  const Figure figure =
      estimated_times(made_up_sweep("plane_nm", SweepAxis::kPointPairs, 2), {}, made_up_origin());
  EXPECT_THAT(figure.drawing, HasSubstr("predicted: NM = 12.5"));
  EXPECT_THAT(figure.drawing, HasSubstr("measured: NM = 12.50"));
  const ReadTable fits = data_of(figure, "fits");
  ASSERT_EQ(fits.rows.size(), 2);
  EXPECT_EQ(fits.text(0, "series"), "test_points");
  EXPECT_NEAR(fits.number(0, "slope [us]"), 2, 1e-3);
  EXPECT_EQ(fits.text(0, "exponent from"), "10");
  EXPECT_NEAR(fits.number(0, "exponent"), 1, 1e-9);
  EXPECT_NEAR(fits.number(1, "intercept [us]"), 25, 1e-3);
  EXPECT_NEAR(fits.number(1, "slope [us]"), 0, 1e-6);
}

TEST(SweepFigures, PutMissRatesBesideTimes) {
  const Sweep sweep = made_up_sweep("plane_nm", SweepAxis::kPointPairs, 2);
  const auto asked = [&sweep](const char* name, std::size_t size, int hits, int missed) {
    MissRate rate{.detector = detector_named(name).name, .size = sweep.sizes[size]};
    rate.hits = hits;
    rate.missed = missed;
    return rate;
  };
  const MissRates misses{.anywhere = {asked("test_points", 1, 200, 150),
                                      asked("test_points", 2, 200, 10), asked("bqsa", 0, 200, 0)},
                         .first_contact = {asked("test_points", 1, 100, 90)}};
  const Figure figure = times_against_miss_rate(sweep, misses, made_up_origin());
  const ReadTable anywhere = data_of(figure, "anywhere");
  ASSERT_EQ(anywhere.rows.size(), 3);
  EXPECT_EQ(anywhere.text(0, "detector"), "bqsa");
  EXPECT_EQ(anywhere.text(0, "miss rate"), "0");
  EXPECT_GT(anywhere.number(0, "shown at"), 0);
  EXPECT_EQ(anywhere.text(1, "NM"), "10");
  EXPECT_EQ(anywhere.text(1, "miss rate"), "0.75");
  EXPECT_NEAR(anywhere.number(1, "time a pair [ns]"), 2e4 / 27, 1e-3);
  EXPECT_EQ(anywhere.text(2, "shown at"), "0.05");

  for (const Figure& times : {fair_times(sweep, misses, made_up_origin()),
                              paper_times(sweep, misses, made_up_origin())}) {
    const ReadTable beside = data_of(times, "");
    EXPECT_EQ(beside.text(1, "missed by test points"), "0.75");
    EXPECT_EQ(beside.text(1, "missed by test points at first contact"), "0.9");
    EXPECT_EQ(beside.text(2, "missed by test points"), "0.05");
    EXPECT_EQ(beside.text(3, "missed by test points"), "");  // not asked
  }
  const std::string drawing = fair_times(sweep, misses, made_up_origin()).drawing;
  EXPECT_THAT(drawing, HasSubstr("set x2tics (\"75\" 10, \"5\" 100)"));
  EXPECT_EQ(miss_text(misses, sweep.sizes[1]),
            "test points miss 75 % of hits, 90 % at first contact");
}

TEST(SweepFigures, AreDrawnWithoutComplaint) {
  const TemporaryDirectory directory;
  ASSERT_FALSE(find_gnuplot().empty());
  FigureWriter writer(directory.path(), find_gnuplot());
  for (const int dimension : {2, 3}) {
    const std::string where = dimension == 2 ? "plane" : "space";
    const Sweep nm = made_up_sweep(where + "_nm", SweepAxis::kPointPairs, dimension);
    const Sweep nk = made_up_sweep(where + "_nk", SweepAxis::kPairs, dimension);
    writer.write(fair_times(nm, {}, made_up_origin()));
    writer.write(fair_times(nk, {}, made_up_origin()));
    if (dimension == 3) continue;
    writer.write(paper_times(nm, {}, made_up_origin()));
    writer.write(paper_times(nk, {}, made_up_origin()));
    writer.write(estimated_times(nm, {}, made_up_origin()));
    writer.write(estimated_times(nk, {}, made_up_origin()));
  }
  Sweep steps = made_up_sweep("step_nk", SweepAxis::kPairs, 2);
  steps.series = {
      {.name = "bqsa", .seconds = {{1e-6}, {2e-6}, {3e-6}, {4e-6}}, .paper_seconds = {}},
      {.name = "qp", .seconds = {{1e-5}, {2e-5}, {3e-5}, {4e-5}}, .paper_seconds = {}}};
  writer.write(step_times(steps, made_up_origin()));
  EXPECT_EQ(writer.figures(), 9);
}

}  // namespace
}  // namespace bqsa::harness
