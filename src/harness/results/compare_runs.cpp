#include "harness/results/compare_runs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "harness/results/text_table.hpp"
#include "harness/statistics/comparison.hpp"

namespace bqsa::harness {
namespace {

struct RunPair {
  const TableRow* before;
  const TableRow* after;
};

/// The runs of one method that have a partner.
struct MethodPairs {
  std::string variant;
  bool plans = false;
  std::vector<RunPair> all;
  std::vector<RunPair> solved;  ///< by both
};

auto key_of(const TableRow& row) {
  return std::tie(row.scenario, row.sha256, row.variant, row.seed, row.repetition);
}

/// Methods in the order of their first pairs.
std::vector<MethodPairs> pairs_of(const std::vector<TableRow>& before,
                                  const std::vector<TableRow>& after) {
  std::map<std::tuple<std::string, std::string, std::string, std::string, int>, const TableRow*>
      partner;
  for (const TableRow& row : after) {
    if (row.applicable) partner[key_of(row)] = &row;
  }
  std::vector<MethodPairs> methods;
  for (const TableRow& row : before) {
    const auto found = partner.find(key_of(row));
    if (!row.applicable || found == partner.end()) continue;
    auto method = std::find_if(methods.begin(), methods.end(),
                               [&](const MethodPairs& one) { return one.variant == row.variant; });
    if (method == methods.end()) {
      method = methods.insert(methods.end(), {row.variant, !row.seed.empty(), {}, {}});
    }
    const RunPair pair{&row, found->second};
    method->all.push_back(pair);
    if (row.success && found->second->success) method->solved.push_back(pair);
  }
  return methods;
}

/// A time that runs have.
struct TimeQuantity {
  const char* name;
  double TableRow::*seconds;
};
constexpr std::array<TimeQuantity, 3> kTimes{{{"tick median", &TableRow::step_median_s},
                                              {"tick p99", &TableRow::step_p99_s},
                                              {"plan time", &TableRow::plan_s}}};

/// The logarithms of the pairs that both have it.
struct PairedLogs {
  std::vector<double> before;
  std::vector<double> after;
};

PairedLogs logs_of(const std::vector<RunPair>& pairs, double TableRow::*quantity) {
  PairedLogs logs;
  for (const RunPair& pair : pairs) {
    if (!(pair.before->*quantity > 0) || !(pair.after->*quantity > 0)) continue;
    logs.before.push_back(std::log(pair.before->*quantity));
    logs.after.push_back(std::log(pair.after->*quantity));
  }
  return logs;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return median_of(values);
}

/// Why times cannot be compared; empty if they can.
std::vector<std::string> reasons_against(const std::vector<MethodPairs>& methods) {
  std::set<std::string> processors, compilers, reasons;
  for (const MethodPairs& method : methods) {
    for (const RunPair& pair : method.all) {
      for (const TableRow* row : {pair.before, pair.after}) {
        processors.insert(row->processor);
        compilers.insert(row->compiler);
        reasons.insert(row->against_times.begin(), row->against_times.end());
      }
    }
  }
  std::vector<std::string> all(reasons.begin(), reasons.end());
  if (processors.size() > 1)
    all.push_back(fmt::format("processors {}", fmt::join(processors, ", ")));
  if (compilers.size() > 1) all.push_back(fmt::format("compilers {}", fmt::join(compilers, ", ")));
  return all;
}

ComparedRow success_row(const MethodPairs& method, double alpha) {
  int lost = 0, won = 0, before = 0, after = 0;
  std::vector<double> failed_before, failed_after;
  for (const RunPair& pair : method.all) {
    before += pair.before->success;
    after += pair.after->success;
    lost += pair.before->success && !pair.after->success;
    won += !pair.before->success && pair.after->success;
    failed_before.push_back(pair.before->success ? 0 : 1);
    failed_after.push_back(pair.after->success ? 0 : 1);
  }
  const double p = compare_pairs(failed_after, failed_before).sign_test_p;
  ComparedRow row{.subject = method.variant,
                  .quantity = "success",
                  .before = fmt::format("{} of {}", before, method.all.size()),
                  .after = fmt::format("{} of {}", after, method.all.size()),
                  .change = fmt::format("{} lost, {} won", lost, won),
                  .interval = "",
                  .p = p_text(p),
                  .differs = lost + won > 0};
  const bool certain = !method.plans || p < alpha;
  if (certain && lost > won) row.finding = ComparisonFinding::kWorse;
  if (certain && won > lost) row.finding = ComparisonFinding::kBetter;
  return row;
}

ComparedRow tip_error_row(const MethodPairs& method, double confidence) {
  constexpr double kMillimetre = 1e-3;
  std::vector<double> before, after;
  for (const RunPair& pair : method.solved) {
    before.push_back(pair.before->tip_error_at_ticks_m / kMillimetre);
    after.push_back(pair.after->tip_error_at_ticks_m / kMillimetre);
  }
  const PairedComparison found = compare_pairs(after, before, {.confidence = confidence});
  ComparedRow row{
      .subject = method.variant,
      .quantity = "tip error [mm]",
      .before = figure(median(before)),
      .after = figure(median(after)),
      .change = fmt::format("{:+.2g}", found.median),
      .interval = fmt::format("{:+.2g} .. {:+.2g}", found.interval.lower, found.interval.upper),
      .p = p_text(found.sign_test_p)};
  if (found.interval.lower > kSameTipError / kMillimetre) row.finding = ComparisonFinding::kWorse;
  if (found.interval.upper < -kSameTipError / kMillimetre) row.finding = ComparisonFinding::kBetter;
  return row;
}

struct WorkQuantity {
  const char* name;
  std::uint64_t WorkCounters::*count;
};
constexpr std::array<WorkQuantity, 8> kWork{{{"quadratics", &WorkCounters::quadratics},
                                             {"bounds", &WorkCounters::bounds},
                                             {"point pairs", &WorkCounters::point_pairs},
                                             {"distance queries", &WorkCounters::distance_queries},
                                             {"kinematics", &WorkCounters::kinematics},
                                             {"Jacobians", &WorkCounters::jacobians},
                                             {"linear solves", &WorkCounters::linear_solves},
                                             {"iterations", &WorkCounters::iterations}}};

/// Nothing where neither does such work.
void add_work_row(const MethodPairs& method, const WorkQuantity& work, double alpha,
                  ComparisonReport& report) {
  std::uint64_t before_sum = 0, after_sum = 0;
  std::vector<double> before, after;
  for (const RunPair& pair : method.solved) {
    if (!pair.before->work || !pair.after->work) continue;
    before_sum += (*pair.before->work).*work.count;
    after_sum += (*pair.after->work).*work.count;
    before.push_back(static_cast<double>((*pair.before->work).*work.count));
    after.push_back(static_cast<double>((*pair.after->work).*work.count));
  }
  if (before_sum + after_sum == 0) return;
  const PairedComparison found = compare_pairs(after, before);
  const double ratio = static_cast<double>(after_sum) / static_cast<double>(before_sum);
  ComparedRow row{.subject = method.variant,
                  .quantity = work.name,
                  .before = std::to_string(before_sum),
                  .after = std::to_string(after_sum),
                  .change = before_sum > 0 ? ratio_text(ratio) : "new",
                  .interval = fmt::format("more in {}, less in {}", found.b_less, found.a_less),
                  .p = p_text(found.sign_test_p),
                  .differs = before_sum != after_sum};
  const bool certain = !method.plans || found.sign_test_p < alpha;
  if (certain && ratio > 1 + kSameWork) row.finding = ComparisonFinding::kWorse;
  if (certain && ratio < 1 / (1 + kSameWork)) row.finding = ComparisonFinding::kBetter;
  report.rows.push_back(std::move(row));
}

ComparedRow time_row(const MethodPairs& method, const TimeQuantity& time, const PairedLogs& logs,
                     double confidence, bool comparable, const ComparisonSettings& settings) {
  constexpr int kResamples = 10'000;  // the interval reaches far into the tails
  const PairedComparison found =
      compare_pairs(logs.after, logs.before, {.confidence = confidence, .resamples = kResamples});
  const double ratio = std::exp(found.median);
  const Interval interval{std::exp(found.interval.lower), std::exp(found.interval.upper)};
  const ComparisonFinding finding = finding_of_ratio(ratio, interval, settings);
  const bool decided = comparable && logs.after.size() >= kFewestTimePairs;
  return {.subject = method.variant,
          .quantity = time.name,
          .before = time_text(std::exp(median(logs.before))),
          .after = time_text(std::exp(median(logs.after))),
          .change = ratio_text(ratio),
          .interval = interval_text(interval),
          .p = p_text(found.sign_test_p),
          .finding = decided ? finding : ComparisonFinding::kUndecided,
          .differs = finding != ComparisonFinding::kTie};
}

/// How many rows chance has a part in.
std::size_t uncertain_comparisons(const std::vector<MethodPairs>& methods) {
  std::size_t count = 0;
  for (const MethodPairs& method : methods) {
    if (method.plans) count += 1 + kWork.size();
    if (!method.solved.empty()) ++count;  // tip error
    for (const TimeQuantity& time : kTimes) {
      if (!logs_of(method.solved, time.seconds).before.empty()) ++count;
    }
  }
  return count;
}

std::size_t runs_in(const std::vector<TableRow>& rows) {
  return static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [](const TableRow& row) { return row.applicable; }));
}

void note_unpaired(const char* which, std::size_t runs, std::size_t paired,
                   ComparisonReport& report) {
  if (runs == paired) return;
  report.notes.push_back(fmt::format("{} of {} runs only in {}", runs - paired, runs, which));
}

}  // namespace

ComparisonReport compare_runs(const std::vector<TableRow>& all_before,
                              const std::vector<TableRow>& all_after,
                              const ComparisonSettings& settings) {
  const std::vector<TableRow> before = last_runs(all_before);
  const std::vector<TableRow> after = last_runs(all_after);
  const std::vector<MethodPairs> methods = pairs_of(before, after);
  if (methods.empty()) {
    throw InputError(
        "nothing to compare: no run has the same scenario file, method, parameters and "
        "seed in both");
  }
  const std::vector<std::string> against = reasons_against(methods);
  const double confidence = confidence_of_each(uncertain_comparisons(methods));
  ComparisonReport report;
  std::size_t paired = 0;
  bool few = false;
  for (const MethodPairs& method : methods) {
    paired += method.all.size();
    report.rows.push_back(success_row(method, 1 - confidence));
    if (method.solved.empty()) continue;
    report.rows.push_back(tip_error_row(method, confidence));
    for (const WorkQuantity& work : kWork) add_work_row(method, work, 1 - confidence, report);
    for (const TimeQuantity& time : kTimes) {
      const PairedLogs logs = logs_of(method.solved, time.seconds);
      if (logs.before.empty()) continue;
      report.rows.push_back(time_row(method, time, logs, confidence, against.empty(), settings));
      few = few || logs.before.size() < kFewestTimePairs;
    }
  }
  if (!against.empty()) {
    report.notes.push_back(fmt::format("times are not decided upon: {}", fmt::join(against, "; ")));
  }
  if (few) {
    report.notes.push_back(
        fmt::format("times of fewer than {} scenarios are not decided upon", kFewestTimePairs));
  }
  note_unpaired("OLD", runs_in(before), paired, report);
  note_unpaired("NEW", runs_in(after), paired, report);
  return report;
}

}  // namespace bqsa::harness
