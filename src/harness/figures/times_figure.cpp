#include "harness/figures/times_figure.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace bqsa::harness {

TimesOrigin times_origin(const MeasurementOrigin& origin) {
  constexpr std::size_t kCommitDigits = 10;
  TimesOrigin text;
  text.caption = fmt::format("bqsa-bench {}, commit {}{}, {}, {}, measured {} ({})",
                             origin.build.version, origin.build.commit.substr(0, kCommitDigits),
                             origin.build.dirty ? ", modified" : "", origin.build.compiler,
                             origin.before.processor, origin.before.date, origin.effort);
  text.against = fmt::format("{}", fmt::join(origin.against, ", "));
  text.lines = {text.caption,
                fmt::format("flags {}; governor {}; others kept {:.2f} of {} cores busy; {}",
                            origin.build.flags, origin.before.governor, origin.other_cores,
                            origin.before.cores, origin.before.os)};
  if (!text.against.empty()) text.lines.push_back("not publishable: " + text.against);
  return text;
}

Figure new_times_figure(std::string name, std::string paper, std::string what,
                        const TimesOrigin& origin) {
  Figure figure{.name = std::move(name), .paper = std::move(paper), .what = std::move(what)};
  figure.provenance = origin.lines;
  figure.drawing = fmt::format(
      "set multiplot\nset label 99 \"{}\" at screen 0.012,0.016 left font \",9\" textcolor "
      "\"#505050\"\n",
      plain(origin.caption));
  if (!origin.against.empty()) {
    figure.drawing += fmt::format(
        "set label 98 \"not publishable: {}\" at screen 0.012,0.984 left font \",10\" textcolor "
        "\"#b3264d\"\n",
        plain(origin.against));
  }
  return figure;
}

std::string clear_origin() { return "unset label\n"; }

std::string log_axes() {
  return "set logscale xy\nset format x \"10^{%L}\"\nset format y \"10^{%L}\"\n";
}

bool in_space(const Sweep& sweep) { return sweep.sizes.front().dimension == 3; }

std::vector<std::string> by_last_time(const Sweep& sweep) {
  std::vector<std::pair<double, std::string>> order;
  for (const Series& series : sweep.series) {
    for (std::size_t size = sweep.sizes.size(); size-- > 0;) {
      if (!series.measured(size)) continue;
      order.emplace_back(series.median(size), series.name);
      break;
    }
  }
  std::sort(order.rbegin(), order.rend());
  std::vector<std::string> names;
  names.reserve(order.size());
  for (const auto& [time, name] : order) names.push_back(name);
  return names;
}

}  // namespace bqsa::harness
