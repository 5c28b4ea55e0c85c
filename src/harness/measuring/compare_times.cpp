#include "harness/measuring/compare_times.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "harness/input_error.hpp"
#include "harness/statistics/comparison.hpp"

namespace bqsa::harness {
namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return median_of(values);
}

/// Mean of the logarithms, and the variance of that mean.
struct LogMean {
  double mean = 0;
  double variance = 0;
  double freedom = 0;
};

LogMean log_mean(const std::vector<double>& seconds) {
  const auto n = static_cast<double>(seconds.size());
  LogMean log{.mean = 0, .variance = 0, .freedom = n - 1};
  for (const double time : seconds) log.mean += std::log(time) / n;
  for (const double time : seconds) {
    log.variance += std::pow(std::log(time) - log.mean, 2) / (n - 1) / n;
  }
  return log;
}

/// Of the ratio of geometric means, for logarithms of unequal variance (Welch 1947).
Interval welch_interval(const std::vector<double>& after, const std::vector<double>& before,
                        double confidence) {
  const LogMean a = log_mean(after);
  const LogMean b = log_mean(before);
  const double difference = a.mean - b.mean;
  const double variance = a.variance + b.variance;
  if (!(variance > 0)) return {std::exp(difference), std::exp(difference)};
  const double freedom =
      variance * variance /
      (a.variance * a.variance / a.freedom + b.variance * b.variance / b.freedom);
  const boost::math::students_t_distribution<> t(freedom);
  const double width = quantile(t, (1 + confidence) / 2) * std::sqrt(variance);
  return {std::exp(difference - width), std::exp(difference + width)};
}

ComparedRow compare(const BenchmarkTimes& before, const BenchmarkTimes& after, double confidence,
                    bool comparable, const ComparisonSettings& settings) {
  const double ratio = median(after.seconds) / median(before.seconds);
  ComparedRow row{.subject = before.name,
                  .quantity = "time",
                  .before = time_text(median(before.seconds)),
                  .after = time_text(median(after.seconds)),
                  .change = ratio_text(ratio),
                  .interval = "",
                  .p = "",
                  .finding = ComparisonFinding::kUndecided};
  const bool repeated = before.seconds.size() > 1 && after.seconds.size() > 1;
  if (!repeated) {
    row.differs = finding_of_ratio(ratio, {ratio, ratio}, settings) != ComparisonFinding::kTie;
    return row;
  }
  const Interval interval = welch_interval(after.seconds, before.seconds, confidence);
  row.interval = interval_text(interval);
  row.p = p_text(mann_whitney(after.seconds, before.seconds).p);
  const ComparisonFinding finding = finding_of_ratio(ratio, interval, settings);
  if (comparable) row.finding = finding;
  row.differs = finding != ComparisonFinding::kTie;
  return row;
}

std::vector<std::string> reasons_against(const BenchmarkFile& before, const BenchmarkFile& after) {
  std::set<std::string> reasons(before.against.begin(), before.against.end());
  reasons.insert(after.against.begin(), after.against.end());
  std::vector<std::string> all(reasons.begin(), reasons.end());
  if (before.machine != after.machine) {
    all.push_back(fmt::format("machines differ: {} and {}", before.machine, after.machine));
  }
  if (before.compiler != after.compiler) {
    all.push_back(fmt::format("compilers differ: {} and {}", before.compiler, after.compiler));
  }
  return all;
}

void note_unpaired(const char* which, std::size_t benchmarks, std::size_t paired,
                   ComparisonReport& report) {
  if (benchmarks == paired) return;
  report.notes.push_back(
      fmt::format("{} of {} benchmarks only in {}", benchmarks - paired, benchmarks, which));
}

}  // namespace

ComparisonReport compare_times(const BenchmarkFile& before, const BenchmarkFile& after,
                               const ComparisonSettings& settings) {
  std::map<std::string, const BenchmarkTimes*> partner;
  for (const BenchmarkTimes& benchmark : after.benchmarks) partner[benchmark.name] = &benchmark;
  std::vector<std::pair<const BenchmarkTimes*, const BenchmarkTimes*>> pairs;
  bool single = false;
  for (const BenchmarkTimes& benchmark : before.benchmarks) {
    const auto found = partner.find(benchmark.name);
    if (found == partner.end()) continue;
    pairs.emplace_back(&benchmark, found->second);
    single = single || std::min(benchmark.seconds.size(), found->second->seconds.size()) < 2;
  }
  if (pairs.empty()) throw InputError("nothing to compare: no benchmark is in both");

  const std::vector<std::string> against = reasons_against(before, after);
  const double confidence = confidence_of_each(pairs.size());
  ComparisonReport report;
  std::vector<double> ratios;
  for (const auto& [old, now] : pairs) {
    report.rows.push_back(compare(*old, *now, confidence, against.empty(), settings));
    ratios.push_back(median(now->seconds) / median(old->seconds));
  }
  report.notes.push_back(
      fmt::format("all times together: {} (median of the ratios)", ratio_text(median(ratios))));
  if (!against.empty()) {
    report.notes.push_back(fmt::format("times are not decided upon: {}", fmt::join(against, "; ")));
  }
  if (single) {
    report.notes.emplace_back(
        "times of a single repetition are not decided upon "
        "(--benchmark_repetitions=10)");
  }
  note_unpaired("OLD", before.benchmarks.size(), pairs.size(), report);
  note_unpaired("NEW", after.benchmarks.size(), pairs.size(), report);
  return report;
}

}  // namespace bqsa::harness
