#include "harness/report/method_summary.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "harness/results/summary.hpp"
#include "harness/results/summary/tallies.hpp"
#include "harness/runner.hpp"
#include "harness/statistics/estimates.hpp"

namespace bqsa::harness::report {
namespace {

/// What methods are compared on: a scenario file and its hash. Seeds and repetitions are runs of one problem.
using ProblemKey = std::pair<std::string, std::string>;

/// The runs of one method on one problem.
struct ProblemRuns {
  int runs = 0;
  int successes = 0;
  std::vector<double> tip_errors_m;    ///< of successes
  std::vector<double> step_medians_s;  ///< of successes
};

/// The runs of one method on the scenarios of one scope.
struct MethodRuns {
  Tally tally;
  std::map<ProblemKey, ProblemRuns> by_problem;
  std::vector<double> step_medians_s;    ///< of successes
  double clearance_m = TableRow::kNone;  ///< least of the successes

  void add(const TableRow& row) {
    tally.add(row);
    if (!row.applicable) return;
    ProblemRuns& problem = by_problem[{row.scenario, row.sha256}];
    ++problem.runs;
    if (!row.success) return;
    ++problem.successes;
    if (std::isfinite(row.tip_error_at_ticks_m)) {
      problem.tip_errors_m.push_back(row.tip_error_at_ticks_m);
    }
    if (std::isfinite(row.step_median_s)) {
      problem.step_medians_s.push_back(row.step_median_s);
      step_medians_s.push_back(row.step_median_s);
    }
    clearance_m = std::fmin(clearance_m, row.clearance_m);
  }
};

/// Fewer of large samples, of which each takes longer and tells more.
Bootstrap resampling(std::size_t size) {
  constexpr std::size_t kDraws = 400'000;
  constexpr std::size_t kFewest = 200;
  Bootstrap bootstrap;
  const auto most = static_cast<std::size_t>(bootstrap.resamples);
  bootstrap.resamples =
      static_cast<int>(std::clamp(kDraws / std::max<std::size_t>(size, 1), kFewest, most));
  return bootstrap;
}

struct MedianOf {
  double value = TableRow::kNone;
  Interval interval{TableRow::kNone, TableRow::kNone};
};

MedianOf median_with_interval(std::vector<double> sample) {
  if (sample.empty()) return {};
  std::sort(sample.begin(), sample.end());
  return {median_of(sample), bootstrap_interval(sample, median_of, resampling(sample.size()))};
}

double median_or_none(std::vector<double> sample) {
  if (sample.empty()) return TableRow::kNone;
  std::sort(sample.begin(), sample.end());
  return median_of(sample);
}

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// What a paired comparison looks at and how it adds up differences; less is better.
struct Measure {
  std::function<double(const ProblemRuns&)> of;  ///< not a number if the runs do not have it
  std::function<double(std::span<const double>)> statistic;
};

double failure_share(const ProblemRuns& runs) {
  return 1 - static_cast<double>(runs.successes) / runs.runs;
}

double tip_error(const ProblemRuns& runs) { return median_or_none(runs.tip_errors_m); }

double log_time(const ProblemRuns& runs) {
  const double median_s = median_or_none(runs.step_medians_s);
  return median_s > 0 ? std::log(median_s) : TableRow::kNone;
}

/// Fewer pairs cannot tell at 95 %, not even if one method is better in each: 2 * 0.5^5 > 0.05.
constexpr std::size_t kFewestPairs = 6;

/// @return true: a tie, false: worse than the leader; nothing if there is too little to tell, or if the
///         leader is worse on the problems that both have
std::optional<bool> ties_with(const MethodRuns& leader, const MethodRuns& other,
                              const Measure& measure) {
  std::vector<double> differences;
  for (const auto& [problem, runs] : leader.by_problem) {
    const auto others = other.by_problem.find(problem);
    if (others == other.by_problem.end()) continue;
    const double difference = measure.of(others->second) - measure.of(runs);
    if (std::isfinite(difference)) differences.push_back(difference);
  }
  if (differences.size() < kFewestPairs) return std::nullopt;
  const Interval interval =
      bootstrap_interval(differences, measure.statistic, resampling(differences.size()));
  if (interval.upper < 0) return std::nullopt;
  return interval.contains(0);
}

/// @param score  the least leads, of equal ones that of more runs; not a number: does not take part
/// @return index of the leader, nothing if nobody takes part
std::optional<std::size_t> leader_of(const std::vector<MethodRuns>& methods,
                                     const std::vector<double>& score) {
  std::optional<std::size_t> first;
  for (std::size_t m = 0; m < score.size(); ++m) {
    if (!std::isfinite(score[m])) continue;
    if (!first || score[m] < score[*first] ||
        (score[m] == score[*first] && methods[m].tally.runs > methods[*first].tally.runs)) {
      first = m;
    }
  }
  return first;
}

/// By method: true: the leader, or tied with it, and all others are decided; false: worse than the leader;
/// null: too little to tell.
std::vector<Json> marks_of(const std::vector<MethodRuns>& methods, const std::vector<double>& score,
                           const Measure& measure) {
  std::vector<Json> marks(methods.size());
  const std::optional<std::size_t> lead = leader_of(methods, score);
  if (!lead) return marks;
  std::vector<std::size_t> best = {*lead};
  std::size_t compared = 0;
  std::size_t decided = 0;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    if (m == *lead || !std::isfinite(score[m])) continue;
    ++compared;
    const std::optional<bool> tie = ties_with(methods[*lead], methods[m], measure);
    if (!tie || (*tie && methods[m].tally.successes == 0)) continue;
    ++decided;
    if (*tie) {
      best.push_back(m);
    } else {
      marks[m] = false;
    }
  }
  if (compared == 0 || decided < compared) return marks;
  for (const std::size_t m : best) marks[m] = true;
  return marks;
}

/// Who is best of a scope, or tied with the best, by method.
struct Best {
  std::vector<Json> rate, tip_error, step;
};

Best best_of(const std::vector<MethodRuns>& methods) {
  const std::size_t count = methods.size();
  std::vector<double> failures(count, TableRow::kNone), errors = failures, steps = failures;
  for (std::size_t m = 0; m < count; ++m) {
    const Tally& tally = methods[m].tally;
    if (tally.runs > 0) failures[m] = 1 - static_cast<double>(tally.successes) / tally.runs;
  }
  Best best{marks_of(methods, failures, {failure_share, mean_of}), {}, {}};
  bool times_count = true;
  for (std::size_t m = 0; m < count; ++m) {
    if (best.rate[m] != true) continue;
    errors[m] = median_or_none(methods[m].tally.tip_errors_at_ticks_m);
    steps[m] = median_or_none(methods[m].step_medians_s);
    times_count = times_count && (methods[m].tally.times_count || !std::isfinite(steps[m]));
  }
  best.tip_error = marks_of(methods, errors, {tip_error, median_of});
  best.step =
      times_count ? marks_of(methods, steps, {log_time, median_of}) : std::vector<Json>(count);
  return best;
}

Json rate_json(const Tally& tally) {
  const auto problems = static_cast<double>(tally.problems.size());
  if (tally.runs == 0) return {{"rate", nullptr}, {"rate_lower", nullptr}, {"rate_upper", nullptr}};
  const double rate = static_cast<double>(tally.successes) / tally.runs;
  const Interval interval = wilson_interval(problems * rate, problems);
  return {{"rate", rate}, {"rate_lower", interval.lower}, {"rate_upper", interval.upper}};
}

/// What is added up together.
struct Scope {
  std::optional<std::string> family;  ///< nothing: all
  std::optional<std::string> robot;   ///< nothing: all, and those without a name

  auto operator<=>(const Scope&) const = default;
};

Json text_or_null(const std::optional<std::string>& text) { return text ? Json(*text) : Json(); }

Json method_json(const Scope& scope, std::size_t method, const MethodRuns& runs, const Best& best) {
  const Tally& tally = runs.tally;
  const MedianOf error = median_with_interval(tally.tip_errors_at_ticks_m);
  const MedianOf step = median_with_interval(runs.step_medians_s);
  const MedianOf plan = median_with_interval(tally.plans_s);
  const double most_error = tally.successes > 0
                                ? *std::max_element(tally.tip_errors_at_ticks_m.begin(),
                                                    tally.tip_errors_at_ticks_m.end())
                                : TableRow::kNone;
  const double p99 = std::fmin(tally.step_times.quantile(0.99) * RunTimes::kHistogramUnit,
                               tally.slowest_of_successes_s);
  Json json = {{"family", text_or_null(scope.family)},
               {"robot", text_or_null(scope.robot)},
               {"method", method},
               {"runs", tally.runs},
               {"not_applicable", tally.not_applicable},
               {"problems", tally.problems.size()},
               {"successes", tally.successes}};
  json.update(rate_json(tally));
  json.update({{"wrong_claims", tally.claims_wrong},
               {"failures", tally.failures.empty() ? Json::object() : Json(tally.failures)},
               {"tip_error_median_m", number_or_null(error.value)},
               {"tip_error_median_lower_m", number_or_null(error.interval.lower)},
               {"tip_error_median_upper_m", number_or_null(error.interval.upper)},
               {"tip_error_max_m", number_or_null(most_error)},
               {"clearance_min_m", number_or_null(runs.clearance_m)},
               {"closed_path_drift_median_rad",
                number_or_null(median_over(tally.motions, &MotionQuality::closed_path_drift))},
               {"manipulability_min_median",
                number_or_null(median_over(tally.motions, &MotionQuality::manipulability_min))},
               {"null_space_share_median",
                number_or_null(median_over(tally.motions, &MotionQuality::null_space_share))},
               {"jerk_rms_median_rad_s3",
                number_or_null(median_over(tally.motions, &MotionQuality::jerk_rms))},
               {"step_median_s", number_or_null(step.value)},
               {"step_median_lower_s", number_or_null(step.interval.lower)},
               {"step_median_upper_s", number_or_null(step.interval.upper)},
               {"step_p99_s", tally.step_times.total() > 0 ? number_or_null(p99) : Json()},
               {"step_max_s", number_or_null(tally.slowest_of_successes_s)},
               {"plan_median_s", number_or_null(plan.value)},
               {"times_publishable", tally.times_count},
               {"best_rate", best.rate[method]},
               {"best_tip_error", best.tip_error[method]},
               {"best_step", best.step[method]}});
  return json;
}

void add_scope(const Scope& scope, const std::vector<MethodRuns>& methods, Json& summary) {
  const Best best = best_of(methods);
  for (std::size_t m = 0; m < methods.size(); ++m) {
    if (methods[m].tally.runs + methods[m].tally.not_applicable == 0) continue;
    summary.push_back(method_json(scope, m, methods[m], best));
  }
}

}  // namespace

Json summary_json(const std::vector<IndexedRun>& runs, std::size_t methods) {
  Order families;
  Order robots;
  std::map<Scope, std::vector<MethodRuns>> scopes;
  for (const IndexedRun& run : runs) {
    const TableRow& row = run.row();
    const auto add_to = [&](const Scope& scope) {
      scopes.try_emplace(scope, methods).first->second[run.method].add(row);
    };
    const std::string family = family_of(row.scenario);
    families.add(family);
    add_to({});
    add_to({family, {}});
    if (row.robot.empty()) continue;
    robots.add(row.robot);
    add_to({{}, row.robot});
    add_to({family, row.robot});
  }
  Json summary = Json::array();
  const auto add_scopes_of = [&](const std::optional<std::string>& robot) {
    const auto add = [&](const Scope& scope) {
      const auto found = scopes.find(scope);
      if (found != scopes.end()) add_scope(scope, found->second, summary);
    };
    add({{}, robot});
    for (const std::string& family : families.names()) add({family, robot});
  };
  add_scopes_of(std::nullopt);
  if (robots.names().size() > 1) {
    for (const std::string& robot : robots.names()) add_scopes_of(robot);
  }
  return summary;
}

}  // namespace bqsa::harness::report
