#include "harness/figures/posture_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/figures/panels.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kPostures = 16;  // after the start
constexpr int kOutlinePoints = 90;
constexpr double kShownOfObstacles = 0.4;  // around their centres in space, of the larger side
constexpr double kEdge = 0.06;             // of the larger side, around what is shown

/// What is shown of the three axes, grown point by point.
struct Bounds {
  Vector3d lower = Vector3d::Constant(1e9);
  Vector3d upper = Vector3d::Constant(-1e9);

  void add(const Vector3d& p) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  std::string range(int axis) const {
    const double edge = kEdge * (upper - lower).maxCoeff();
    return fmt::format("[{:.2f}:{:.2f}]", lower(axis) - edge, upper(axis) + edge);
  }
};

void add_arm(const JudgedRun& run, Bounds& bounds) {
  for (const PointPositions& positions : run.positions) {
    for (const Vector3d& p : positions.points) bounds.add(p);
  }
}

/// Rows of the postures that are shown, evenly in time.
std::vector<std::size_t> shown_rows(const JudgedRun& run) {
  std::vector<std::size_t> rows;
  for (int k = 0; k <= kPostures && run.rows() > 0; ++k) {
    const std::size_t row = static_cast<std::size_t>(k) * (run.rows() - 1) / kPostures;
    if (rows.empty() || row > rows.back()) rows.push_back(row);
  }
  return rows;
}

CsvTable postures(const JudgedRun& run) {
  CsvTable table({"tick", "t [s]", "x [m]", "y [m]", "z [m]"});
  for (const std::size_t row : shown_rows(run)) {
    for (const Vector3d& p : run.positions[row].points) {
      table.add_row({static_cast<int>(row), run.time(row), p.x(), p.y(), p.z()});
    }
    table.lift_pen();
  }
  return table;
}

CsvTable tip_path(const JudgedRun& run) {
  CsvTable table({"tick", "t [s]", "x [m]", "y [m]", "z [m]"});
  for (std::size_t row = 0; row < run.rows(); ++row) {
    const Vector3d& p = run.positions[row].tip();
    table.add_row({static_cast<int>(row), run.time(row), p.x(), p.y(), p.z()});
  }
  return table;
}

void add_runs(const JudgedRun& first, const JudgedRun& second, Figure& figure) {
  for (const JudgedRun* run : {&first, &second}) {
    figure.data.emplace_back("postures_" + run->method, postures(*run));
    figure.data.emplace_back("tip_" + run->method, tip_path(*run));
    figure.provenance.push_back(run_provenance(*run));
  }
}

Vector2d point_on(const Ellipse& ellipse, double angle) {
  const Vector2d local(ellipse.semi_axes().x() * std::cos(angle),
                       ellipse.semi_axes().y() * std::sin(angle));
  return ellipse.center() + ellipse.rotation() * local;
}

constexpr const char* kPanelHead = R"gp(
set size ratio -1    # equal units
set key {key} samplen 2.5 font ",13"
set palette defined (0 "#b9cdea", 1 "#06143a")
set cbrange [0:{duration}]
set cblabel "time t [s]" offset 0,0.5
set colorbox user horizontal origin screen 0.3,0.125 size screen 0.4,0.018
set cbtics scale 0.4 offset 0,0.4
set xlabel "x [m]"
)gp";

constexpr const char* kPlanePanel = R"gp(
set title "{title}"
plot name . "_obstacles.csv" using "{u}":"{v}" with filledcurves linecolor "#c4c4c4" title "obstacles", \
  "" using "{u}":"{v}" with lines linewidth 1 linecolor "#606060" notitle, \
  name . "_postures_{method}.csv" using "{u}":"{v}":"t [s]" with linespoints linewidth 1.6 pointtype 7 pointsize 0.45 linecolor palette title "postures, light to dark", \
  name . "_tip_{method}.csv" using "{u}":"{v}" with lines linewidth 2.5 linecolor "#d1495b" dashtype solid title "path of the tip"
unset colorbox
unset key
)gp";

/// The name of an obstacle: in it if there is room, else above it.
std::string label_at(const Ellipse& ellipse, const std::string& name, const Bounds& bounds) {
  constexpr double kRoom = 0.06;  // of the larger side
  const Vector2d extent(ellipse.support(Vector2d::UnitX()), ellipse.support(Vector2d::UnitY()));
  const bool inside = extent.x() > kRoom * (bounds.upper - bounds.lower).maxCoeff();
  return fmt::format("set label \"{}\" at {:.4f},{:.4f} center front offset 0,{} font \",13\"\n",
                     plain(name), ellipse.center().x(),
                     ellipse.center().y() + (inside ? 0 : extent.y()), inside ? 0 : 0.8);
}

/// Two panels in a plane of two axes.
Figure plane_figure(Figure figure, const JudgedRun& first, const JudgedRun& second,
                    const std::vector<Ellipse>& ellipses, int second_axis, const char* key) {
  const char* names[] = {"x [m]", "y [m]", "z [m]"};
  const std::string v = names[second_axis];
  add_runs(first, second, figure);
  Bounds bounds;
  add_arm(first, bounds);
  add_arm(second, bounds);
  CsvTable outlines({"obstacle", "x [m]", v});
  std::string labels;
  for (std::size_t j = 0; j < ellipses.size(); ++j) {
    const std::string& obstacle = first.problem().obstacles[j].name;
    for (int k = 0; k <= kOutlinePoints; ++k) {
      const Vector2d p = point_on(ellipses[j], 2 * std::numbers::pi * k / kOutlinePoints);
      outlines.add_row({obstacle, p.x(), p.y()});
      Vector3d shown = bounds.lower;
      shown(0) = p.x();
      shown(second_axis) = p.y();
      bounds.add(shown);
    }
    outlines.lift_pen();
    labels += label_at(ellipses[j], obstacle, bounds);
  }
  figure.data.emplace_back("obstacles", outlines);

  figure.drawing = fmt::format("set multiplot\nset xrange {}\nset yrange {}\nset ylabel \"{}\"\n",
                               bounds.range(0), bounds.range(second_axis), v);
  figure.drawing += labels;
  figure.drawing += fmt::format(kPanelHead, fmt::arg("duration", first.problem().duration()),
                                fmt::arg("key", key));
  const PanelGrid grid{
      .rows = 1, .columns = 2, .left = 0.085, .right = 0.985, .bottom = 0.26, .top = 0.95};
  for (const JudgedRun* run : {&first, &second}) {
    figure.drawing += grid.place(0, run == &first ? 0 : 1);
    figure.drawing +=
        fmt::format(kPlanePanel, fmt::arg("title", plain(verdict_text(*run))),
                    fmt::arg("method", run->method), fmt::arg("u", "x [m]"), fmt::arg("v", v));
  }
  return figure;
}

/// The surface of an ellipsoid as a grid of lines, its longest axis for poles, no further from the
/// centre than `reach` along any axis [m].
CsvTable wireframe(const std::vector<Obstacle>& obstacles, double reach) {
  constexpr int kParallels = 12;
  constexpr int kMeridians = 16;
  CsvTable table({"obstacle", "x [m]", "y [m]", "z [m]"});
  for (const Obstacle& obstacle : obstacles) {
    const Ellipsoid& shape = obstacle.shape;
    Eigen::Index pole = 0;
    const double longest = shape.semi_axes().maxCoeff(&pole);
    const double last = std::asin(std::min(1.0, reach / longest));
    for (int parallel = 0; parallel <= kParallels; ++parallel) {
      const double latitude = last * (2.0 * parallel / kParallels - 1);
      for (int meridian = 0; meridian <= kMeridians; ++meridian) {
        const double longitude = 2 * std::numbers::pi * meridian / kMeridians;
        Vector3d unit;
        unit(pole) = std::sin(latitude);
        unit((pole + 1) % 3) = std::cos(latitude) * std::cos(longitude);
        unit((pole + 2) % 3) = std::cos(latitude) * std::sin(longitude);
        const Vector3d p = shape.center() + shape.rotation() * shape.semi_axes().cwiseProduct(unit);
        table.add_row({obstacle.name, p.x(), p.y(), p.z()});
      }
      table.lift_pen();
    }
    table.lift_pen();
  }
  return table;
}

constexpr const char* kSpacePanel = R"gp(
set origin {origin},0.12
set size 0.5,0.88
set label 1 "{title}" at screen {middle},0.97 center
splot name . "_obstacles.csv" using "x [m]":"y [m]":"z [m]" with lines linewidth 1 linecolor "#707070" title "obstacle", \
  name . "_postures_{method}.csv" using "x [m]":"y [m]":"z [m]":"t [s]" with linespoints linewidth 1.6 pointtype 7 pointsize 0.45 linecolor palette title "postures, light to dark", \
  name . "_tip_{method}.csv" using "x [m]":"y [m]":"z [m]" with lines linewidth 2.5 linecolor "#d1495b" dashtype solid title "path of the tip"
unset colorbox
unset key
)gp";

Figure space_figure(Figure figure, const JudgedRun& first, const JudgedRun& second,
                    const char* view) {
  add_runs(first, second, figure);
  Bounds bounds;
  add_arm(first, bounds);
  add_arm(second, bounds);
  const double reach = kShownOfObstacles * (bounds.upper - bounds.lower).maxCoeff();
  for (const Obstacle& obstacle : first.problem().obstacles) {
    const Vector3d shown = obstacle.shape.semi_axes().cwiseMin(reach);
    bounds.add(obstacle.shape.center() - shown);
    bounds.add(obstacle.shape.center() + shown);
  }
  figure.data.emplace_back("obstacles", wireframe(first.problem().obstacles, reach));
  figure.drawing = fmt::format("set multiplot\nset xrange {}\nset yrange {}\nset zrange {}\n",
                               bounds.range(0), bounds.range(1), bounds.range(2));
  figure.drawing +=
      fmt::format(kPanelHead, fmt::arg("duration", first.problem().duration()),
                  fmt::arg("key", "at screen 0.5,0.035 center vertical maxrows 1 width 2"));
  figure.drawing += fmt::format(
      "set ylabel \"y [m]\"\nset zlabel \"z [m]\" rotate offset 2,0\nset border 4095\nset xyplane "
      "relative 0\n"
      "set view equal xyz\nset view {}\nset xtics 0.2\nset ytics 0.1\nset ztics 0.2\n",
      view);
  for (const JudgedRun* run : {&first, &second}) {
    const double origin = run == &first ? 0 : 0.5;
    figure.drawing += fmt::format(kSpacePanel, fmt::arg("title", plain(verdict_text(*run))),
                                  fmt::arg("method", run->method), fmt::arg("origin", origin),
                                  fmt::arg("middle", origin + 0.25));
  }
  return figure;
}

}  // namespace

Figure planar_configurations(const JudgedRun& first, const JudgedRun& second) {
  std::vector<Ellipse> ellipses;
  for (const Obstacle& obstacle : first.problem().obstacles) {
    ellipses.push_back(planar_section(obstacle.shape));
  }
  return plane_figure({.name = "fig08_planar_configurations",
                       .paper = "Fig. 8",
                       .what = "Configurations of the planar arm along the motion, with object, "
                               "obstacle and the path of the tip",
                       .width = 1300,
                       .height = 650},
                      first, second, ellipses, 1, "bottom left reverse Left");
}

Figure projected_configurations(const JudgedRun& first, const JudgedRun& second) {
  Eigen::Matrix<double, 2, 3> xoz;
  xoz << 1, 0, 0, 0, 0, 1;
  std::vector<Ellipse> ellipses;
  for (const Obstacle& obstacle : first.problem().obstacles) {
    ellipses.push_back(shadow(obstacle.shape, xoz));
  }
  return plane_figure({.name = "fig14_puma_projected_configurations",
                       .paper = "Fig. 14",
                       .what = "Configurations of the PUMA 560 and the shadow of the ellipsoid, "
                               "projected on the plane XOZ",
                       .width = 1200,
                       .height = 860},
                      first, second, ellipses, 2, "bottom right reverse Left");
}

Figure spatial_configurations(const JudgedRun& first, const JudgedRun& second) {
  return space_figure({.name = "fig15_puma_configurations",
                       .paper = "Fig. 15",
                       .what = "Configurations of the PUMA 560 around the ellipsoid",
                       .width = 1300,
                       .height = 800},
                      first, second, "70,40,1.22");
}

Figure wall_configurations(const JudgedRun& first, const JudgedRun& second) {
  return space_figure({.name = "fig20_puma_wall_configurations",
                       .paper = "Fig. 20",
                       .what = "Configurations of the PUMA 560 beside the wall",
                       .width = 1300,
                       .height = 800},
                      first, second, "74,62,1.06");
}

}  // namespace bqsa::harness
