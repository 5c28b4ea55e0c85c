#include "harness/figures/tracking_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "harness/figures/panels.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;

constexpr double kMillimetre = 1e-3;
constexpr double kDegree = std::numbers::pi / 180;
constexpr std::array kAxes = {"x", "y", "z"};

using RunPair = std::array<const JudgedRun*, 2>;

/// Grey behind the curves where a link is close to an obstacle.
void add_close_spans(const RunPair& runs, Figure& figure) {
  for (const JudgedRun* run : runs) {
    CsvTable table({"from [s]", "to [s]"});
    for (const Span& span : close_spans(*run)) table.add_row({span.from, span.to});
    figure.data.emplace_back("close_" + run->method, table);
    figure.provenance.push_back(run_provenance(*run));
  }
}

const LegendEntry kCloseLegend = {LegendEntry::kArea, "\"#dcdcdc\"",
                                  "a link within 0.1 mm of an obstacle"};

/// The gnuplot plot element that draws them over the whole height of the panel.
std::string close_element(const JudgedRun& run) {
  return fmt::format(
      "name . \"_close_{}.csv\" using \"from [s]\":(bottom):\"from [s]\":\"to "
      "[s]\":(bottom):(top) with boxxyerror fillstyle solid noborder linecolor \"#dcdcdc\" notitle",
      run.method);
}

// --- errors along the axes

/// Tip errors [mm] of a tick, and the least and the greatest of the motion to it.
struct TickErrors {
  double t;
  Vector3d at_tick;
  Vector3d least;
  Vector3d greatest;
};

std::vector<TickErrors> tick_errors(const JudgedRun& run) {
  const Vector3d none = Vector3d::Constant(1e9);
  std::vector<TickErrors> ticks;
  TickErrors current{0, none, none, -none};
  for (const TipSample& sample : tip_samples(run)) {
    const Vector3d error = (sample.actual - sample.desired) / kMillimetre;
    current.least = current.least.cwiseMin(error);
    current.greatest = current.greatest.cwiseMax(error);
    if (!sample.at_tick) continue;
    ticks.push_back({sample.t, error, current.least, current.greatest});
    current = {0, none, error, error};  // the next motion begins where this one ends
  }
  return ticks;
}

CsvTable error_table(const std::vector<TickErrors>& ticks) {
  std::vector<std::string> columns = {"t [s]", "error [mm]"};
  for (const char* axis : kAxes) {
    columns.push_back(fmt::format("{} error [mm]", axis));
    columns.push_back(fmt::format("{} least between [mm]", axis));
    columns.push_back(fmt::format("{} greatest between [mm]", axis));
  }
  CsvTable table(columns);
  for (const TickErrors& tick : ticks) {
    std::vector<CsvTable::Cell> cells = {tick.t, tick.at_tick.norm()};
    for (int axis = 0; axis < 3; ++axis) {
      for (const Vector3d* error : {&tick.at_tick, &tick.least, &tick.greatest}) {
        cells.emplace_back((*error)(axis));
      }
    }
    table.add_row(cells);
  }
  return table;
}

/// Bounds of an axis that holds these values, with room on both sides.
struct Range {
  double bottom;
  double top;
};

Range room_for(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double room = std::max(0.08 * (*most - *least), 1e-9);
  return {*least - room, *most + room};
}

constexpr const char* kErrorPanel = R"gp(
set title "{title}"
bottom = {bottom:.6g}; top = {top:.6g}
set yrange [bottom:top]
plot {close}, \
  name . "_{method}.csv" using "t [s]":"{axis} least between [mm]":"{axis} greatest between [mm]" with filledcurves linecolor "#ee9418" notitle, \
  "" using "t [s]":"{axis} error [mm]" with lines linewidth 1.6 linecolor "#000000" notitle
)gp";

Figure error_figure(Figure figure, const RunPair& runs, int axes) {
  add_close_spans(runs, figure);
  const PanelGrid grid{.rows = axes, .columns = 2, .left = 0.115};
  figure.drawing = fmt::format("set multiplot\nset xrange [0:{}]\n", runs[0]->problem().duration());
  std::array<std::vector<TickErrors>, 2> ticks;
  for (std::size_t r = 0; r < 2; ++r) {
    ticks.at(r) = tick_errors(*runs.at(r));
    figure.data.emplace_back(runs.at(r)->method, error_table(ticks.at(r)));
  }
  for (int axis = 0; axis < axes; ++axis) {
    const char* letter = kAxes.at(static_cast<std::size_t>(axis));
    figure.drawing += axis + 1 < axes ? "set format x \"\"\nunset xlabel\n"
                                      : "set format x\nset xlabel \"time t [s]\"\n";
    for (std::size_t r = 0; r < 2; ++r) {
      std::vector<double> errors = {0};
      for (const TickErrors& tick : ticks.at(r)) {
        errors.push_back(tick.least(axis));
        errors.push_back(tick.greatest(axis));
      }
      const Range range = room_for(errors);
      figure.drawing += grid.place(axis, static_cast<int>(r));
      figure.drawing +=
          r == 0 ? fmt::format("set ylabel \"{} error [mm]\"\n", letter) : "unset ylabel\n";
      figure.drawing += fmt::format(
          kErrorPanel, fmt::arg("title", axis == 0 ? plain(verdict_text(*runs.at(r))) : ""),
          fmt::arg("bottom", range.bottom), fmt::arg("top", range.top),
          fmt::arg("close", close_element(*runs.at(r))), fmt::arg("method", runs.at(r)->method),
          fmt::arg("axis", letter));
    }
  }
  figure.drawing +=
      legend_row({{LegendEntry::kLine, "linewidth 2 linecolor \"#000000\"", "at ticks"},
                  {LegendEntry::kArea, "\"#ee9418\"", "on the way to the tick"},
                  kCloseLegend},
                 figure.width);
  return figure;
}

// --- joint angles

CsvTable joint_table(const JudgedRun& run) {
  const int joints = run.problem().chain.joints();
  std::vector<std::string> columns = {"t [s]"};
  for (int j = 1; j <= joints; ++j) columns.push_back(fmt::format("q{} [deg]", j));
  for (int j = 1; j <= joints; ++j) columns.push_back(fmt::format("v{} [deg/s]", j));
  CsvTable table(columns);
  for (std::size_t row = 0; row < run.rows(); ++row) {
    const JointVector& q = run.trajectory().q[row];
    std::vector<CsvTable::Cell> cells = {run.time(row)};
    for (const double angle : q) cells.emplace_back(angle / kDegree);
    const JointVector step = row == 0 ? JointVector(JointVector::Constant(joints, std::nan("")))
                                      : JointVector(q - run.trajectory().q[row - 1]);
    for (const double angle : step) cells.emplace_back(angle / kDegree / run.problem().dt);
    table.add_row(cells);
  }
  return table;
}

std::string joint_style(std::size_t joint) {
  constexpr std::size_t kStyles = 8;
  return fmt::format("linestyle {}", (joint - 1) % kStyles + 1);
}

std::string curves(const JudgedRun& run, const char* letter, const char* unit) {
  std::string elements;
  const auto joints = static_cast<std::size_t>(run.problem().chain.joints());
  for (std::size_t j = 1; j <= joints; ++j) {
    const std::size_t every = std::max<std::size_t>(run.rows() / 10, 1);
    elements += fmt::format(
        ", \\\n  name . \"_{}.csv\" using \"t [s]\":\"{}{} [{}]\" with linespoints {} "
        "pointinterval {} pointsize 0.9 notitle",
        run.method, letter, j, unit, joint_style(j), every);
  }
  return elements;
}

std::string joint_panel(const JudgedRun& run, bool velocities) {
  std::vector<double> values;
  for (std::size_t row = 1; row < run.rows(); ++row) {
    const JointVector& q = run.trajectory().q[row];
    const JointVector step = (q - run.trajectory().q[row - 1]) / run.problem().dt;
    const JointVector& shown = velocities ? step : q;
    for (const double value : shown) values.push_back(value / kDegree);
  }
  if (values.empty()) values.push_back(0);
  const Range range = room_for(values);
  std::string text = fmt::format("bottom = {:.6g}; top = {:.6g}\nset yrange [bottom:top]\n",
                                 range.bottom, range.top);
  text += fmt::format("set title \"{}\"\n", velocities ? "" : plain(verdict_text(run)));
  return text + "plot " + close_element(run) +
         (velocities ? curves(run, "v", "deg/s") : curves(run, "q", "deg")) + "\n";
}

Figure joint_figure(Figure figure, const RunPair& runs) {
  add_close_spans(runs, figure);
  for (const JudgedRun* run : runs) figure.data.emplace_back(run->method, joint_table(*run));
  const PanelGrid grid{.rows = 2, .columns = 2, .left = 0.085, .bottom = 0.14};
  figure.drawing = fmt::format("set multiplot\nset xrange [0:{}]\n", runs[0]->problem().duration());
  for (const int row : {0, 1}) {
    figure.drawing += row == 0 ? "set format x \"\"\nset ylabel \"joint angle [deg]\"\n"
                               : "set format x\nset xlabel \"time t [s]\"\nset ylabel \"joint "
                                 "velocity [deg/s]\"\n";
    for (const int column : {0, 1}) {
      figure.drawing += grid.place(row, column);
      figure.drawing += joint_panel(*runs.at(static_cast<std::size_t>(column)), row == 1);
    }
  }
  std::vector<LegendEntry> legend;
  const auto joints = static_cast<std::size_t>(runs[0]->problem().chain.joints());
  for (std::size_t j = 1; j <= joints; ++j) {
    legend.push_back({LegendEntry::kMarkedLine, joint_style(j), fmt::format("q_{}", j)});
  }
  legend.push_back(kCloseLegend);
  figure.drawing += legend_row(legend, figure.width);
  return figure;
}

}  // namespace

Figure planar_errors(const JudgedRun& first, const JudgedRun& second) {
  return error_figure({.name = "fig11_planar_tracking_errors",
                       .paper = "Fig. 11",
                       .what = "Tip errors of the planar arm along x and y over time, at ticks and "
                               "between them, the start left out",
                       .width = 1300,
                       .height = 760},
                      {&first, &second}, 2);
}

Figure spatial_errors(const JudgedRun& first, const JudgedRun& second) {
  return error_figure(
      {.name = "fig18_puma_tracking_errors",
       .paper = "Fig. 18",
       .what = "Tip errors of the PUMA 560 along x, y and z over time, at ticks and "
               "between them, the start left out",
       .width = 1300,
       .height = 900},
      {&first, &second}, 3);
}

Figure planar_joint_angles(const JudgedRun& first, const JudgedRun& second) {
  return joint_figure({.name = "fig12_planar_joint_angles",
                       .paper = "Fig. 12",
                       .what = "Joint angles of the planar arm, continuous, and joint velocities, "
                               "which are not",
                       .width = 1300,
                       .height = 900},
                      {&first, &second});
}

Figure spatial_joint_angles(const JudgedRun& first, const JudgedRun& second) {
  return joint_figure({.name = "fig19_puma_joint_angles",
                       .paper = "Fig. 19",
                       .what = "Joint angles of the PUMA 560, continuous, and joint velocities, "
                               "which are not",
                       .width = 1300,
                       .height = 900},
                      {&first, &second});
}

}  // namespace bqsa::harness
