#include "harness/figures/miss_rate_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "harness/figures/panels.hpp"
#include "harness/figures/series_style.hpp"
#include "harness/measuring/detector.hpp"

namespace bqsa::harness {

namespace {

std::string percentage(double share) { return fmt::format("{:.3g}", 100 * share); }

}  // namespace

const MissRate* miss_of(const std::vector<MissRate>& misses, std::string_view detector,
                        const WorkloadSize& size) {
  const auto found = std::find_if(misses.begin(), misses.end(), [&](const MissRate& miss) {
    return miss.detector == detector && miss.size.test_points.link == size.test_points.link &&
           miss.size.test_points.obstacle == size.test_points.obstacle;
  });
  return found == misses.end() ? nullptr : &*found;
}

MissRates miss_rates(const Sweep& sweep, std::uint64_t seed) {
  const int dimension = sweep.sizes.front().dimension;
  MissRates rates;
  for (const Population population : {Population::kAnywhere, Population::kFirstContact}) {
    const PairPopulation pairs(population, dimension, seed);
    std::vector<MissRate>& found =
        population == Population::kAnywhere ? rates.anywhere : rates.first_contact;
    for (const Series& series : sweep.series) {
      const Detector& detector = detector_named(series.name);
      const bool samples = detector.accuracy == Accuracy::kSampled;
      for (std::size_t size = 0; size < (samples ? sweep.sizes.size() : 1); ++size) {
        if (miss_of(found, series.name, sweep.sizes[size]) != nullptr) continue;
        found.push_back(pairs.ask(detector, sweep.sizes[size].test_points));
      }
    }
  }
  return rates;
}

std::array<double, 2> missed_by_test_points(const MissRates& misses, const WorkloadSize& size) {
  const auto rate = [&size](const std::vector<MissRate>& asked) {
    const MissRate* miss = miss_of(asked, "test_points", size);
    return miss == nullptr ? std::nan("") : miss->miss_rate();
  };
  return {rate(misses.anywhere), rate(misses.first_contact)};
}

std::string miss_axis(const Sweep& sweep, const MissRates& misses) {
  std::string marks;
  for (std::size_t size = 0; size < sweep.sizes.size(); ++size) {
    const double missed = missed_by_test_points(misses, sweep.sizes[size])[0];
    if (std::isnan(missed)) continue;
    marks +=
        fmt::format("{}\"{}\" {}", marks.empty() ? "" : ", ", percentage(missed), sweep.at(size));
  }
  if (marks.empty()) return "";
  return fmt::format(
      "set logscale x2\nset x2range [{}:{}]\nset x2tics ({}) font \",10\" offset 0,-0.4\n"
      "set x2label \"hits that test points miss [%], links of any place and direction\" font "
      "\",11\" offset 0,0.1\n",
      sweep.at(0), sweep.at(sweep.sizes.size() - 1), marks);
}

std::string miss_text(const MissRates& misses, const WorkloadSize& size) {
  const auto [anywhere, first_contact] = missed_by_test_points(misses, size);
  if (std::isnan(anywhere) || std::isnan(first_contact)) return "";
  return fmt::format("test points miss {} % of hits, {} % at first contact", percentage(anywhere),
                     percentage(first_contact));
}

namespace {

constexpr double kNanosecond = 1e-9;
constexpr double kNoMisses = 1e-5;  ///< where detectors stand that miss nothing

/// The rows of a series one after the other, in order of the sweep's sizes.
CsvTable miss_table(const Sweep& sweep, const std::vector<MissRate>& misses) {
  CsvTable table({"detector", "NM", "time a pair [ns]", "miss rate", "lower", "upper", "shown at",
                  "false alarm rate"});
  for (const Series& series : sweep.series) {
    for (const MissRate& miss : misses) {
      if (miss.detector != series.name) continue;
      for (std::size_t size = 0; size < sweep.sizes.size(); ++size) {
        if (!(sweep.sizes[size].test_points.link == miss.size.test_points.link &&
              sweep.sizes[size].test_points.obstacle == miss.size.test_points.obstacle) ||
            !series.measured(size)) {
          continue;
        }
        const Interval interval = miss.miss_interval();
        table.add_row({series.name, sweep.at(size),
                       series.median(size) / sweep.sizes[size].pairs() / kNanosecond,
                       miss.miss_rate(), interval.lower, interval.upper,
                       std::max(miss.miss_rate(), kNoMisses), miss.false_alarm_rate()});
      }
    }
  }
  return table;
}

/// Sampling detectors as curves through their NM, the others as points.
std::string miss_panel(const Sweep& sweep, const std::string& part, bool with_key) {
  std::string elements;
  const std::vector<std::string> order = by_last_time(sweep);
  for (const std::string& name : order) {
    const std::string time = fmt::format(
        "(stringcolumn(\"detector\") eq \"{}\" ? column(\"time a pair [ns]\") : NaN)", name);
    const bool samples = detector_named(name).accuracy == Accuracy::kSampled;
    const std::string title =
        with_key ? fmt::format("title \"{}\"", detector_label(name)) : std::string("notitle");
    elements +=
        fmt::format("{}name . \"_{}.csv\" using \"shown at\":{} with linespoints {} {}",
                    elements.empty() ? "" : ", \\\n  ", part, time, detector_style(name), title);
    // The vectorised loop's are those of the two others beside it.
    if (!samples || name == "test_points_vectorized") continue;
    elements += fmt::format(
        ", \\\n  \"\" using \"shown at\":{}:(column(\"NM\") < 10 ? \"\" : sprintf(\"%g\", "
        "column(\"NM\"))) with labels font "
        "\",10\" "
        "offset {} notitle",
        time, name == "test_points" ? "2.3,0.3" : "-2.3,-0.3");
  }
  return "plot " + elements + "\n";
}

}  // namespace

Figure times_against_miss_rate(const Sweep& sweep, const MissRates& misses,
                               const TimesOrigin& origin) {
  Figure figure = new_times_figure(
      in_space(sweep) ? "time_against_miss_rate_space" : "time_against_miss_rate", "-",
      fmt::format(
          "Time a pair against the share of hits that are missed, all detectors in {}: test "
          "points are labelled with NM",
          in_space(sweep) ? "space" : "the plane"),
      origin);
  figure.width = 1300;
  figure.height = 900;
  figure.data.emplace_back("anywhere", miss_table(sweep, misses.anywhere));
  figure.data.emplace_back("first_contact", miss_table(sweep, misses.first_contact));
  figure.drawing += log_axes();
  figure.drawing += fmt::format(
      "set xrange [{0:g}:1.6]\nset xtics (\"0\" {1:g}, \"10^{{-4}}\" 1e-4, \"10^{{-3}}\" 1e-3, "
      "\"10^{{-2}}\" 1e-2, \"10^{{-1}}\" 1e-1, \"1\" 1)\n"
      "set arrow from {2:g},graph 0 to {2:g},graph 1 nohead linecolor \"#707070\" dashtype (2,4)\n"
      "set xlabel \"share of hits that are missed\"\n"
      "set key at screen 0.72,0.9 left top reverse Left font \",12\" samplen 2.5 spacing 1.3\n"
      "set key title \"numbers at curves: NM\" left\n",
      kNoMisses / 12, kNoMisses, kNoMisses * 4);
  const PanelGrid grid{.rows = 1,
                       .columns = 2,
                       .left = 0.07,
                       .right = 0.71,
                       .bottom = 0.11,
                       .top = 0.92,
                       .gap_x = 0.03};
  figure.drawing +=
      grid.place(0, 0) +
      "set title \"links of any place and direction\"\nset ylabel \"time a pair [ns]\"\n" +
      miss_panel(sweep, "anywhere", true);
  figure.drawing += grid.place(0, 1) +
                    "set title \"links at the first contact\"\nunset ylabel\nset format y \"\"\n" +
                    clear_origin() + miss_panel(sweep, "first_contact", false);
  return figure;
}

}  // namespace bqsa::harness
