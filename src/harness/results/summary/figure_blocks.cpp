#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/results/summary/blocks.hpp"
#include "harness/results/table.hpp"
#include "harness/runner.hpp"
#include "harness/statistics/estimates.hpp"

namespace bqsa::harness {
namespace {

constexpr double kMillimetre = 1e-3;
constexpr double kMicrosecond = 1e-6;
constexpr double kMillisecond = 1e-3;
constexpr double kPercent = 1e-2;
constexpr double kDegree = std::numbers::pi / 180;

}  // namespace

std::string accuracy_table(const Tallies& tallies) {
  TextTable table({{"successes", "", true},
                   {"tip error [mm]", "median"},
                   {"", "max"},
                   {"[mm]", "between"},
                   {"clearance", "[mm]"},
                   {"max step", "[deg]"},
                   {"cleared", "ticks"},
                   {"increments", "median"},
                   {"", "p99"},
                   {"", "max"}});
  tallies.fill(table, [](const Tally& tally) -> std::vector<std::string> {
    if (tally.successes == 0) return std::vector<std::string>(9, "-");
    std::vector<double> errors = tally.tip_errors_at_ticks_m;
    std::sort(errors.begin(), errors.end());
    return {figure(median_of(errors) / kMillimetre),
            figure(errors.back() / kMillimetre),
            figure(tally.tip_error_between_ticks_m / kMillimetre),
            figure(tally.clearance_m / kMillimetre),
            figure(tally.max_joint_step_rad / kDegree),
            std::to_string(tally.increments.total()),
            figure(std::round(tally.increments.quantile(0.5))),
            figure(std::round(tally.increments.quantile(0.99))),
            tally.increments.total() > 0 ? std::to_string(tally.increments_max) : "-"};
  });
  return table.text();
}

std::string motion_table(const Tallies& tallies) {
  TextTable table({{"motion", "", true},
                   {"drift", "[deg]"},
                   {"manipulability", "least"},
                   {"", "mean"},
                   {"singular value", "[m]"},
                   {"self-motion", "[%]"},
                   {"jerk", "[rad/s3]"}});
  bool any = false;
  tallies.fill(table, [&any](const Tally& tally) -> std::vector<std::string> {
    const auto median = [&tally](double MotionQuality::*value) {
      return median_over(tally.motions, value);
    };
    const double jerk = median(&MotionQuality::jerk_rms);
    any = any || std::isfinite(jerk);
    return {figure(median(&MotionQuality::closed_path_drift) / kDegree),
            figure(median(&MotionQuality::manipulability_min)),
            figure(median(&MotionQuality::manipulability_mean)),
            figure(median(&MotionQuality::singular_value_min)),
            figure(median(&MotionQuality::null_space_share) / kPercent),
            figure(jerk)};
  });
  return any ? table.text() + '\n' : "";
}

std::string time_table(const Tallies& tallies) {
  TextTable table({{"time", "", true},
                   {"ticks", ""},
                   {"[us]", "median"},
                   {"", "p99"},
                   {"", "p99.9"},
                   {"", "max"},
                   {"slowest", "[us]"},
                   {"in", "", true},
                   {"at", "tick"},
                   {"repe-", "tition", false, true},
                   {"total", "[s]"}});
  tallies.fill(table, [](const Tally& tally) -> std::vector<std::string> {
    const auto pooled = [&tally](double share) {
      const double seconds = tally.step_times.quantile(share) * RunTimes::kHistogramUnit;
      return figure(std::min(seconds, tally.slowest_of_successes_s) / kMicrosecond);
    };
    const bool timed = std::isfinite(tally.slowest_s);
    const char* doubt = tally.times_count || tally.step_times.total() == 0 ? "" : "~";
    const char* pipe = tally.includes_pipe && tally.step_times.total() > 0 ? kPipeMark : "";
    return {std::to_string(tally.step_times.total()),
            fmt::format("{}{}{}", pipe, doubt, pooled(0.5)),
            pooled(0.99),
            pooled(0.999),
            figure(tally.slowest_of_successes_s / kMicrosecond),
            fmt::format("{}{}{}", tally.includes_pipe ? kPipeMark : "",
                        tally.slowest_counts ? "" : "~", figure(tally.slowest_s / kMicrosecond)),
            tally.slowest_scenario,
            timed ? std::to_string(tally.slowest_tick) : "-",
            std::to_string(tally.slowest_repetition),
            figure(tally.total_s)};
  });
  return table.text();
}

std::string plan_table(const Tallies& tallies) {
  TextTable table(
      {{"plans", "", true}, {"solved", ""}, {"[ms]", "median"}, {"", "p99"}, {"", "max"}});
  bool any = false;
  for (const std::string& family : tallies.families.names()) {
    table.add_heading(family);
    for (const std::string& method : tallies.methods.names()) {
      const auto found = tallies.by_family_and_method.find({family, method});
      if (found == tallies.by_family_and_method.end() || found->second.plans_s.empty()) continue;
      const Tally& tally = found->second;
      any = true;
      std::vector<double> plans = tally.plans_s;
      std::sort(plans.begin(), plans.end());
      table.add_row(
          {fmt::format("  {}", method), std::to_string(std::ssize(plans)),
           fmt::format("{}{}{}", tally.includes_pipe ? kPipeMark : "", tally.times_count ? "" : "~",
                       figure(median_of(plans) / kMillisecond)),
           figure(quantile_of(plans, 0.99) / kMillisecond), figure(plans.back() / kMillisecond)});
    }
  }
  return any ? table.text() + '\n' : "";
}

}  // namespace bqsa::harness
