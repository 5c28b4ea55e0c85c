#include "harness/figures/sweep_figures.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "harness/figures/series_style.hpp"
#include "harness/figures/sweep_curves.hpp"
#include "harness/figures/times_figure.hpp"
#include "harness/measuring/detector.hpp"
#include "harness/measuring/run_sweep.hpp"

namespace bqsa::harness {
namespace {

constexpr const char* kTestPoints = "test_points";
constexpr const char* kPaperForm = "bqsa_paper";
/// NM from which on the paper's 25 multiplications a pair are fewer than its 2 NM (section 3.4).
constexpr double kPredictedCrossover = 12.5;

/// `fig05` along NM, `fig06` along nk.
std::string figure_stem(const Sweep& sweep) {
  return sweep.axis == SweepAxis::kPointPairs ? "fig05" : "fig06";
}

std::string paper_number(const Sweep& sweep) {
  return sweep.axis == SweepAxis::kPointPairs ? "Fig. 5" : "Fig. 6";
}

/// Log-log axes, a key on the right in the order of the curves, all series.
Figure all_series(Figure figure, const Sweep& sweep, const MissRates& misses) {
  const bool of_detectors = !is_of_steps(sweep.name);
  const char* y_label =
      of_detectors ? "time of a pass over all nk pairs [µs]" : "time of a control step [µs]";
  const std::string title = fmt::format("{}{}", in_space(sweep) ? "in space" : "in the plane",
                                        of_detectors ? ", " + fixed_text(sweep, misses) : "");
  const std::vector<std::string> names = by_last_time(sweep);
  figure.width = 1300;
  figure.data.emplace_back("", times_table(sweep, names, misses));
  figure.drawing += log_axes() + upper_axis(sweep, misses);
  figure.drawing += fmt::format(
      "set xlabel \"{}\"\nset ylabel \"{}\"\nset key outside right center reverse Left font "
      "\",12\" "
      "samplen 4 spacing 1.25\nset tmargin 5.2; set bmargin 4.5; set pointsize 0.9\nset title "
      "\"{}\"\nset xrange [{}:{}]\n",
      axis_label(sweep), y_label, title, sweep.at(0), sweep.at(sweep.sizes.size() - 1));
  std::string elements;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string style = of_detectors ? detector_style(names[i]) : method_style(names[i]);
    elements += (i == 0 ? "" : ", \\\n  ") +
                curve_with_bars(sweep, names[i], style,
                                of_detectors ? detector_label(names[i]) : plain(names[i]));
  }
  figure.drawing += "plot " + elements + "\n";
  return figure;
}

std::string interval_text(const Estimate& estimate, int digits) {
  if (!std::isfinite(estimate.interval.upper))
    return fmt::format("{:.{}f}", estimate.value, digits);
  return fmt::format("{:.{}f} ({:.{}f} to {:.{}f})", estimate.value, digits,
                     estimate.interval.lower, digits, estimate.interval.upper, digits);
}

/// How many passes the means are of, as `100 passes` or `3 to 100 passes`.
std::string passes_text(const Series& series) {
  if (series.paper_passes.empty()) return "no pass";
  const auto [least, most] =
      std::minmax_element(series.paper_passes.begin(), series.paper_passes.end());
  return *least == *most ? fmt::format("{} passes", *most)
                         : fmt::format("{} to {} passes", *least, *most);
}

}  // namespace

Figure paper_times(const Sweep& sweep, const MissRates& misses, const TimesOrigin& origin) {
  const std::string axis = axis_name(sweep);
  Figure figure = new_times_figure(
      fmt::format("{}_time_against_{}", figure_stem(sweep), axis == "NM" ? "nm" : "nk"),
      paper_number(sweep),
      fmt::format(
          "Computation time against {}, {}, by the paper's protocol: mean of repeated passes "
          "by the wall clock",
          axis, fixed_text(sweep)),
      origin);
  CsvTable table({axis, time_column(kTestPoints), time_column(kPaperForm), "test_points passes",
                  "bqsa_paper passes", kMissColumns[0], kMissColumns[1]});
  const Series& points = *sweep.find(kTestPoints);
  const Series& quadratic = *sweep.find(kPaperForm);
  const std::size_t sizes = std::min(points.paper_seconds.size(), quadratic.paper_seconds.size());
  for (std::size_t size = 0; size < sizes; ++size) {
    const auto [anywhere, first_contact] = missed_by_test_points(misses, sweep.sizes[size]);
    table.add_row({sweep.at(size), points.paper_seconds[size] / kMicrosecond,
                   quadratic.paper_seconds[size] / kMicrosecond, points.paper_passes[size],
                   quadratic.paper_passes[size], anywhere, first_contact});
  }
  figure.data.emplace_back("", table);
  figure.drawing +=
      fmt::format(R"gp(set title "{title}"
set xlabel "{axis_label}"
set ylabel "time of a pass over all nk pairs [µs]"
set key top left reverse Left samplen 4
set xrange [0:*]; set yrange [0:*]
set tmargin 3.6; set bmargin 4.5
plot name . ".csv" using "{axis}":"{points} [us]" with linespoints {points_style} title "{points_label}", \
  "" using "{axis}":"{quadratic} [us]" with linespoints {quadratic_style} title "{quadratic_label}"
)gp",
                  fmt::arg("title", fixed_text(sweep, misses) + "; mean of " + passes_text(points)),
                  fmt::arg("axis", axis), fmt::arg("axis_label", axis_label(sweep)),
                  fmt::arg("points", kTestPoints), fmt::arg("quadratic", kPaperForm),
                  fmt::arg("points_style", detector_style(kTestPoints)),
                  fmt::arg("quadratic_style", detector_style(kPaperForm)),
                  fmt::arg("points_label", detector_label(kTestPoints)),
                  fmt::arg("quadratic_label", detector_label(kPaperForm)));
  return figure;
}

namespace {

/// The fitted lines of both series as gnuplot functions, and the table of what was fitted.
std::string fit_functions(const Sweep& sweep, CsvTable& table) {
  std::string text;
  for (const char* name : {kTestPoints, kPaperForm}) {
    const LinearTime line = linear_time(sweep, name);
    const Estimate exponent = time_exponent(sweep, name, exponents_from(sweep));
    table.add_row(
        {std::string(name), line.intercept.value / kMicrosecond,
         line.intercept.interval.lower / kMicrosecond, line.intercept.interval.upper / kMicrosecond,
         line.slope.value / kMicrosecond, line.slope.interval.lower / kMicrosecond,
         line.slope.interval.upper / kMicrosecond, line.r_squared, sweep.at(exponents_from(sweep)),
         exponent.value, exponent.interval.lower, exponent.interval.upper});
    text += fmt::format("fit_{}(x) = {:.6g} + {:.6g} * x    # [us]\n", name,
                        line.intercept.value / kMicrosecond, line.slope.value / kMicrosecond);
  }
  return text;
}

std::string crossover_marks(const Sweep& sweep) {
  if (sweep.axis != SweepAxis::kPointPairs) return "";
  std::string text = fmt::format(
      "set arrow from {0},graph 0 to {0},graph 1 nohead linecolor \"#707070\" dashtype (2,4)\n"
      "set label \"predicted: NM = {0}\" at {0},graph 0.97 right rotate offset 1,0 font \",12\"\n",
      kPredictedCrossover);
  const std::optional<Estimate> measured = crossover(sweep, kTestPoints, kPaperForm);
  if (!measured) {
    return text + "set label \"measured: none, test points stay faster\" at graph 0.03,0.06 left\n";
  }
  if (measured->value == 0) {
    return text + fmt::format("set label \"measured: below NM = {:.3g}\" at graph 0.03,0.06 left\n",
                              measured->interval.upper);
  }
  return text +
         fmt::format(
             "set arrow from {0:.4g},graph 0 to {0:.4g},graph 1 nohead linecolor \"#000000\"\n"
             "set label \"measured: NM = {1}\" at {0:.4g},graph 0.97 right rotate offset 1,0 "
             "font \",12\"\n",
             measured->value, interval_text(*measured, 2));
}

}  // namespace

Figure estimated_times(const Sweep& sweep, const MissRates& misses, const TimesOrigin& origin) {
  Figure figure = new_times_figure(
      fmt::format("{}_estimated", figure_stem(sweep)), paper_number(sweep),
      fmt::format("The same by our own estimator, {}: interleaved blocks, 95 % intervals "
                  "over processes, fitted lines{}",
                  fixed_text(sweep),
                  sweep.axis == SweepAxis::kPointPairs ? ", predicted and measured crossover" : ""),
      origin);
  CsvTable fits({"series", "intercept [us]", "intercept lower [us]", "intercept upper [us]",
                 "slope [us]", "slope lower [us]", "slope upper [us]", "r squared", "exponent from",
                 "exponent", "exponent lower", "exponent upper"});
  const std::string functions = fit_functions(sweep, fits);
  figure.data.emplace_back("", times_table(sweep, {kTestPoints, kPaperForm}, misses));
  figure.data.emplace_back("fits", fits);
  figure.drawing += log_axes() + functions + crossover_marks(sweep) + upper_axis(sweep, misses);
  figure.drawing += fmt::format(
      "set title \"{}\"\nset xlabel \"{}\"\nset ylabel \"time of a pass over all nk pairs [µs]\"\n"
      "set key bottom right reverse Left samplen 4 font \",13\"\nset tmargin 5.2; set bmargin "
      "4.5\nset xrange "
      "[{}:{}]\n",
      fmt::format("{}; exponents from {} = {} on", fixed_text(sweep, misses), axis_name(sweep),
                  sweep.at(exponents_from(sweep))),
      axis_label(sweep), sweep.at(0), sweep.at(sweep.sizes.size() - 1));
  std::string elements;
  for (const char* name : {kTestPoints, kPaperForm}) {
    const std::string label =
        fmt::format("{}, exponent {}", detector_label(name),
                    interval_text(time_exponent(sweep, name, exponents_from(sweep)), 3));
    elements +=
        fmt::format("{}{}, \\\n  fit_{}(x) with lines linecolor \"#707070\" linewidth 1 notitle",
                    elements.empty() ? "" : ", \\\n  ",
                    curve_with_bars(sweep, name, detector_style(name), label), name);
  }
  elements +=
      ", \\\n  NaN with lines linecolor \"#707070\" linewidth 1 title \"intercept + slope x\"";
  figure.drawing += "plot " + elements + "\n";
  return figure;
}

Figure fair_times(const Sweep& sweep, const MissRates& misses, const TimesOrigin& origin) {
  return all_series(
      new_times_figure(fmt::format("{}_{}", figure_stem(sweep), in_space(sweep) ? "space" : "fair"),
                       paper_number(sweep),
                       fmt::format("Time of all detectors against {}, in {}, {}", axis_name(sweep),
                                   in_space(sweep) ? "space" : "the plane", fixed_text(sweep)),
                       origin),
      sweep, misses);
}

Figure step_times(const Sweep& sweep, const TimesOrigin& origin) {
  const bool space = in_space(sweep);
  return all_series(
      new_times_figure(space ? "step_against_nk_space" : "step_against_nk", "-",
                       fmt::format("Time of a whole control step of every method against nk, {}",
                                   space ? "in space" : "in the plane"),
                       origin),
      sweep, {});
}

}  // namespace bqsa::harness
