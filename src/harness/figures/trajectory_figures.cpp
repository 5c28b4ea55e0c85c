#include "harness/figures/trajectory_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "harness/figures/panels.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;

constexpr std::array kAxes = {"x", "y", "z"};

using RunPair = std::array<const JudgedRun*, 2>;

CsvTable path_table(const std::vector<TipSample>& samples) {
  CsvTable table({"t [s]", "at tick", "x desired [m]", "y desired [m]", "z desired [m]", "x [m]",
                  "y [m]", "z [m]"});
  for (const TipSample& sample : samples) {
    table.add_row({sample.t, sample.at_tick ? 1 : 0, sample.desired.x(), sample.desired.y(),
                   sample.desired.z(), sample.actual.x(), sample.actual.y(), sample.actual.z()});
  }
  return table;
}

constexpr double kEnlarged = 0.15;  // to which a deviation may be, of the size of the path

struct PathBounds {
  Vector3d lower;
  Vector3d upper;

  double size() const { return (upper - lower).maxCoeff(); }
  std::string range(Eigen::Index axis) const {
    const double edge = kEnlarged * size();
    return fmt::format("[{:.3f}:{:.3f}]", lower(axis) - edge, upper(axis) + edge);
  }
};

PathBounds path_bounds(const std::vector<TipSample>& samples) {
  PathBounds bounds{samples.front().desired, samples.front().desired};
  for (const TipSample& sample : samples) {
    bounds.lower = bounds.lower.cwiseMin(sample.desired);
    bounds.upper = bounds.upper.cwiseMax(sample.desired);
  }
  return bounds;
}

/// The power of ten that makes a deviation as large as can be shown beside a path.
double enlargement(const std::vector<TipSample>& samples) {
  double deviation = 0;
  for (const TipSample& sample : samples) {
    deviation = std::max(deviation, (sample.actual - sample.desired).norm());
  }
  if (deviation == 0) return 1;
  return std::pow(10, std::floor(std::log10(kEnlarged * path_bounds(samples).size() / deviation)));
}

constexpr const char* kPathPanel = R"gp(
enlarged = {enlarged:g}
set title sprintf("{title}, deviation enlarged %g times", enlarged)
set xrange {x_range}; set yrange {y_range}
plot name . "_{method}.csv" using "{u} desired [m]":"{v} desired [m]" with lines linewidth 9 linecolor "#cfcfcf" notitle, \
  "" using "{u} [m]":"{v} [m]" with lines linewidth 1.5 linecolor "#000000" dashtype (6,4) notitle, \
  "" using (column("{u} desired [m]") + enlarged * (column("{u} [m]") - column("{u} desired [m]"))):(column("{v} desired [m]") + enlarged * (column("{v} [m]") - column("{v} desired [m]"))) with lines linewidth 1.2 linecolor "#c33b4f" notitle
)gp";

/// @param u, v  axes shown: 0 for x, 1 for y, 2 for z
Figure trajectory_figure(Figure figure, const RunPair& runs, std::size_t u, std::size_t v) {
  const PanelGrid grid{.rows = 1, .columns = 2, .bottom = 0.2};
  figure.drawing = fmt::format(
      "set multiplot\nset size ratio -1    # equal units\nset xlabel \"{} [m]\"\nset ylabel \"{} "
      "[m]\"\n",
      kAxes.at(u), kAxes.at(v));
  for (const JudgedRun* run : runs) {
    const std::vector<TipSample> samples = tip_samples(*run);
    const PathBounds bounds = path_bounds(samples);
    figure.data.emplace_back(run->method, path_table(samples));
    figure.provenance.push_back(run_provenance(*run));
    figure.drawing += grid.place(0, run == runs[0] ? 0 : 1);
    figure.drawing += fmt::format(kPathPanel, fmt::arg("title", plain(verdict_text(*run))),
                                  fmt::arg("method", run->method), fmt::arg("u", kAxes.at(u)),
                                  fmt::arg("v", kAxes.at(v)),
                                  fmt::arg("x_range", bounds.range(static_cast<Eigen::Index>(u))),
                                  fmt::arg("y_range", bounds.range(static_cast<Eigen::Index>(v))),
                                  fmt::arg("enlarged", enlargement(samples)));
  }
  figure.drawing += legend_row(
      {{LegendEntry::kLine, "linewidth 9 linecolor \"#cfcfcf\"", "desired path"},
       {LegendEntry::kLine, "linewidth 1.5 linecolor \"#000000\" dashtype (6,4)", "actual path"},
       {LegendEntry::kLine, "linewidth 1.2 linecolor \"#c33b4f\"",
        "deviation enlarged, between ticks too"}},
      figure.width);
  return figure;
}

}  // namespace

Figure planar_trajectory(const JudgedRun& first, const JudgedRun& second) {
  return trajectory_figure({.name = "fig10_planar_trajectory",
                            .paper = "Fig. 10",
                            .what = "Desired and actual path of the planar arm's tip, and the "
                                    "deviation enlarged",
                            .width = 1300,
                            .height = 520},
                           {&first, &second}, 0, 1);
}

Figure spatial_trajectory(const JudgedRun& first, const JudgedRun& second) {
  return trajectory_figure({.name = "fig17_puma_trajectory",
                            .paper = "Fig. 17",
                            .what = "Desired and actual circle of the PUMA 560's tip, and the "
                                    "deviation enlarged",
                            .width = 1300,
                            .height = 720},
                           {&first, &second}, 1, 2);
}

}  // namespace bqsa::harness
