#include "harness/figures/criteria_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "bqsa/geometry/conic.hpp"
#include "bqsa/geometry/paper_form.hpp"
#include "harness/figures/panels.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Criteria of one pair at one tick, and of what else is known of it then.
struct TickCriteria {
  Criteria shown;
  Category exact;  ///< of the same pair by the exact test
};

/// Criteria of one pair over a run.
struct PairCriteria {
  std::string title;
  std::vector<TickCriteria> ticks;
  std::vector<double>
      vertical;  ///< when x_min and x_max change ends: the link passes the vertical [s]
};

const LinkSegment& link_of(const JudgedRun& run, int number) {
  return *std::find_if(run.links.begin(), run.links.end(),
                       [number](const LinkSegment& link) { return link.number == number; });
}

std::string pair_title(const JudgedRun& run, const ClampedPair& pair) {
  return fmt::format("({}, {})", pair.link,
                     run.problem().obstacles[static_cast<std::size_t>(pair.obstacle)].name);
}

using TickTest = std::function<TickCriteria(const Ellipsoid&, const Vector3d&, const Vector3d&)>;

bool points_right(const JudgedRun& run, const LinkSegment& link, std::size_t row) {
  return run.end_of(link, row).x() > run.start_of(link, row).x();
}

PairCriteria pair_criteria(const JudgedRun& run, const ClampedPair& pair, const TickTest& test) {
  PairCriteria criteria{pair_title(run, pair), {}, {}};
  const LinkSegment& link = link_of(run, pair.link);
  const Obstacle& obstacle = run.problem().obstacles[static_cast<std::size_t>(pair.obstacle)];
  for (std::size_t row = 0; row < run.rows(); ++row) {
    criteria.ticks.push_back(
        test(obstacle.at(static_cast<int>(row)), run.start_of(link, row), run.end_of(link, row)));
    if (row > 0 && points_right(run, link, row) != points_right(run, link, row - 1)) {
      criteria.vertical.push_back((run.time(row - 1) + run.time(row)) / 2);
    }
  }
  return criteria;
}

CsvTable criteria_table(const JudgedRun& run, const PairCriteria& pair) {
  CsvTable table({"tick", "t [s]", "Delta", "f(x_min)", "f(x_max)", "f'(x_min) f'(x_max)",
                  "category", "category by the exact test"});
  for (std::size_t row = 0; row < pair.ticks.size(); ++row) {
    const Criteria& c = pair.ticks[row].shown;
    table.add_row({static_cast<int>(row), run.time(row), c.delta, c.f_min, c.f_max, c.slope_product,
                   static_cast<int>(c.category), static_cast<int>(pair.ticks[row].exact)});
  }
  return table;
}

/// Runs of ticks of one category, each tick standing for half a period before and after it.
CsvTable span_table(const JudgedRun& run, const PairCriteria& pair) {
  CsvTable table({"from [s]", "to [s]", "category"});
  const double half = run.problem().dt / 2;
  for (std::size_t row = 0; row < pair.ticks.size();) {
    const Category category = pair.ticks[row].shown.category;
    std::size_t last = row;
    while (last + 1 < pair.ticks.size() && pair.ticks[last + 1].shown.category == category) ++last;
    table.add_row({run.time(row) - half, run.time(last) + half, static_cast<int>(category)});
    row = last + 1;
  }
  return table;
}

int disagreements(const PairCriteria& pair) {
  return static_cast<int>(
      std::count_if(pair.ticks.begin(), pair.ticks.end(),
                    [](const TickCriteria& tick) { return tick.shown.category != tick.exact; }));
}

constexpr const char* kScale = R"gp(
# A scale that is logarithmic away from zero and linear near it, so that signs can be seen.
smallest = 1e-4
signed_log(v) = asinh(v / (2 * smallest)) / log(10)
limit = 10
set yrange [-limit:limit]
set ytics ("-10^{4}" signed_log(-1e4), "-10^{2}" signed_log(-1e2), "-1" signed_log(-1), "-10^{-2}" signed_log(-1e-2), "0" 0, "10^{-2}" signed_log(1e-2), "1" signed_log(1), "10^{2}" signed_log(1e2), "10^{4}" signed_log(1e4))
set xzeroaxis linecolor "#404040" linewidth 1 dashtype solid
shade(category) = category == 1 ? 0xe4e4e4 : category == 2 ? 0xffffff : 0x8a8a8a
)gp";

constexpr const char* kPanel = R"gp(
set title "{title}"
set label 99 "{remark}" at graph 0.02,0.03 left front font ",12"
plot name . "_spans_{part}.csv" using "from [s]":(-limit):"from [s]":"to [s]":(-limit):(limit):(shade(column("category"))) with boxxyerror fillstyle solid noborder linecolor rgb variable notitle, \
  name . "_{part}.csv" using "t [s]":(signed_log(column("Delta"))) with linespoints linestyle 1 linewidth 2.5 pointinterval {every} notitle, \
  "" using "t [s]":(signed_log(column("f(x_min)"))) with linespoints linestyle 2 pointinterval -{every} notitle, \
  "" using "t [s]":(signed_log(column("f(x_max)"))) with linespoints linestyle 4 pointinterval -{every} notitle, \
  "" using "t [s]":(signed_log(column("f'(x_min) f'(x_max)"))) with linespoints linestyle 5 linewidth 2.5 pointinterval -{every} notitle
)gp";

std::string legend(int width) {
  return legend_row(
      {{LegendEntry::kMarkedLine, "linestyle 1 linewidth 2.5", "Δ"},
       {LegendEntry::kMarkedLine, "linestyle 2", "f(x_{min})"},
       {LegendEntry::kMarkedLine, "linestyle 4", "f(x_{max})"},
       {LegendEntry::kMarkedLine, "linestyle 5 linewidth 2.5", "f '(x_{min}) f '(x_{max})"},
       {LegendEntry::kArea, "\"#e4e4e4\"", "no collision 1"},
       {LegendEntry::kArea, "\"#ffffff\"", "no collision 2"},
       {LegendEntry::kArea, "\"#8a8a8a\"", "neither"}},
      width);
}

std::string panel(const JudgedRun& run, const std::string& part, const PairCriteria& pair,
                  const std::string& of_what) {
  const std::string remark =
      fmt::format("the category of the exact test at {} of {} ticks",
                  static_cast<int>(pair.ticks.size()) - disagreements(pair), pair.ticks.size());
  std::string text = "unset arrow\nunset label\n";
  for (const double t : pair.vertical) {
    text += fmt::format(
        "set arrow from {0:.4g},graph 0 to {0:.4g},graph 1 nohead front linecolor \"#404040\" "
        "dashtype "
        "(2,4)\nset label \"vertical\" at {0:.4g},graph 0.98 right rotate front offset -0.6,0 font "
        "\",11\"\n",
        t);
  }
  return text + fmt::format(kPanel, fmt::arg("part", part), fmt::arg("remark", remark),
                            fmt::arg("title", fmt::format("{}, {}{}", plain(run.method),
                                                          plain(pair.title), of_what)),
                            fmt::arg("every", std::max<std::size_t>(run.rows() / 12, 1)));
}

TickCriteria planar_test(const Ellipsoid& shape, const Vector3d& p1, const Vector3d& p2) {
  const Ellipse ellipse = planar_section(shape);
  return {paper_criteria(ellipse, p1.head<2>(), p2.head<2>()),
          category(polar_form<2>(ellipse, p1.head<2>(), p2.head<2>()))};
}

Ellipse shadow_on_xoz(const Ellipsoid& shape) {
  Eigen::Matrix<double, 2, 3> xoz;
  xoz << 1, 0, 0, 0, 0, 1;
  return shadow(shape, xoz);
}

TickCriteria xoz_test(const Ellipsoid& shape, const Vector3d& p1, const Vector3d& p2) {
  const Ellipse ellipse = shadow_on_xoz(shape);
  const Vector2d start(p1.x(), p1.z());
  const Vector2d end(p2.x(), p2.z());
  return {paper_criteria(ellipse, start, end), category(polar_form<2>(ellipse, start, end))};
}

TickCriteria space_test(const Ellipsoid& shape, const Vector3d& p1, const Vector3d& p2) {
  const Criteria criteria = space_criteria(shape, p1, p2);
  return {criteria, category(polar_form<3>(shape, p1, p2))};
}

}  // namespace

Criteria paper_criteria(const Ellipse& ellipse, const Vector2d& p1, const Vector2d& p2) {
  const Vector2d& left = p1.x() <= p2.x() ? p1 : p2;
  const Vector2d& right = p1.x() <= p2.x() ? p2 : p1;
  const PaperForm<double> f = paper_form(conic_from_ellipse(ellipse), left, right);
  const auto value = [&f](double x) { return (f.alpha * x + f.beta) * x + f.gamma; };
  const auto slope = [&f](double x) { return 2 * f.alpha * x + f.beta; };
  const double width = right.x() - left.x();
  const double scale = 1 / (width * width);
  return {discriminant(f) * scale, value(left.x()) * scale, value(right.x()) * scale,
          slope(left.x()) * slope(right.x()) * scale, paper_category(f, left.x(), right.x())};
}

Criteria space_criteria(const Ellipsoid& ellipsoid, const Vector3d& p1, const Vector3d& p2) {
  const ParameterForm<double> f =
      parameter_form<double, 3>(unit_point(ellipsoid, p1), unit_point(ellipsoid, p2));
  return {f.beta * f.beta - 4 * f.alpha * f.gamma, f.gamma, f.alpha + f.beta + f.gamma,
          f.beta * (2 * f.alpha + f.beta), category(f)};
}

Figure planar_criteria(const JudgedRun& run, const std::string& name) {
  Figure figure{
      .name = name,
      .paper = "Fig. 9",
      .what = fmt::format("Criteria of the paper's categories for the pairs that {} moved "
                          "away, over (x_max - x_min)²",
                          run.method),
      .width = 1300,
      .height = 760};
  figure.provenance.push_back(run_provenance(run));
  const std::vector<ClampedPair>& pairs = run.outcome.clamped_pairs;
  const PanelGrid grid{.rows = 1, .columns = std::max(static_cast<int>(pairs.size()), 1)};
  figure.drawing = fmt::format(
      "set multiplot\nset xrange [0:{}]\nset xlabel \"time t [s]\"\nset ylabel \"criteria "
      "[-]\"\n{}",
      run.problem().duration(), kScale);
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const PairCriteria pair = pair_criteria(run, pairs[p], planar_test);
    const std::string part = fmt::format("link{}_{}", pairs[p].link, p);
    figure.data.emplace_back(part, criteria_table(run, pair));
    figure.data.emplace_back("spans_" + part, span_table(run, pair));
    figure.drawing += grid.place(0, static_cast<int>(p));
    figure.drawing += panel(run, part, pair, "");
  }
  figure.drawing += legend(figure.width);
  return figure;
}

namespace {

/// When a link's projections hit the shadows: spans of ticks, each plane on a line of its own.
CsvTable plane_table(const JudgedRun& run, const ClampedPair& pair) {
  const std::array<std::string, 3> names = {"XOY", "YOZ", "XOZ"};
  CsvTable table({"plane", "line", "from [s]", "to [s]"});
  const LinkSegment& link = link_of(run, pair.link);
  const Obstacle& obstacle = run.problem().obstacles[static_cast<std::size_t>(pair.obstacle)];
  const double half = run.problem().dt / 2;
  for (const CoordinatePlane plane : kCoordinatePlanes) {
    const auto first = static_cast<Eigen::Index>(plane);
    Eigen::Matrix<double, 2, 3> selector;
    selector << Eigen::RowVector3d::Unit(first), Eigen::RowVector3d::Unit((first + 1) % 3);
    const auto hit = [&](std::size_t row) {
      return row < run.rows() &&
             hits(polar_form<2>(shadow(obstacle.at(static_cast<int>(row)), selector),
                                projected(run.start_of(link, row), plane),
                                projected(run.end_of(link, row), plane)));
    };
    for (std::size_t row = 0; row < run.rows(); ++row) {
      const std::size_t from = row;
      while (hit(row)) ++row;
      if (row == from) continue;
      table.add_row({names.at(static_cast<std::size_t>(first)), static_cast<int>(first) + 1,
                     run.time(from) - half, run.time(row - 1) + half});
    }
  }
  return table;
}

constexpr const char* kPlanesPanel = R"gp(
unset label; unset arrow
set title "coordinate planes in which the projections hit" offset 0,-0.6
set xlabel "time t [s]"
unset ylabel
unset xzeroaxis
set yrange [0.4:3.6]
set ytics ("XOY" 1, "YOZ" 2, "XOZ" 3)
plot name . "_planes_{part}.csv" using "from [s]":"line":"from [s]":"to [s]":(column("line") - 0.3):(column("line") + 0.3) with boxxyerror fillstyle solid noborder linecolor "#505050" notitle
)gp";

}  // namespace

Figure spatial_criteria(const JudgedRun& projection, const JudgedRun& exact) {
  Figure figure{.name = "fig16_puma_criteria",
                .paper = "Fig. 16",
                .what =
                    "Criteria of the categories for the pairs moved away from the ellipsoid: of "
                    "the projection on XOZ, and in space",
                .width = 1300,
                .height = 900};
  figure.drawing =
      fmt::format("set multiplot\nset xrange [0:{}]\nunset xlabel\nset ylabel \"criteria [-]\"\n{}",
                  projection.problem().duration(), kScale);
  const PanelGrid criteria{.rows = 1, .columns = 2, .bottom = 0.41};
  const PanelGrid planes{.rows = 1, .columns = 2, .bottom = 0.16, .top = 0.31};
  std::string below;
  int column = 0;
  for (const JudgedRun* run : {&projection, &exact}) {
    figure.provenance.push_back(run_provenance(*run));
    if (run->outcome.clamped_pairs.empty()) continue;
    const ClampedPair& moved = run->outcome.clamped_pairs.front();
    const PairCriteria pair =
        pair_criteria(*run, moved, run == &projection ? xoz_test : space_test);
    figure.data.emplace_back(run->method, criteria_table(*run, pair));
    figure.data.emplace_back("spans_" + run->method, span_table(*run, pair));
    figure.data.emplace_back("planes_" + run->method, plane_table(*run, moved));
    figure.drawing += criteria.place(0, column);
    figure.drawing += panel(*run, run->method, pair,
                            run == &projection ? ", projected on XOZ" : ", in space, over t");
    below += planes.place(0, column);
    below += fmt::format(kPlanesPanel, fmt::arg("part", run->method));
    ++column;
  }
  figure.drawing += below + legend(figure.width);
  return figure;
}

}  // namespace bqsa::harness
