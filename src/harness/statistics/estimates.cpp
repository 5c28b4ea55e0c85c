#include "harness/statistics/estimates.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "harness/generator/random_stream.hpp"

namespace bqsa::harness {

double quantile_of(std::span<const double> sorted, double share) {
  assert(!sorted.empty());
  const double rank = std::ceil(share * static_cast<double>(sorted.size()));
  return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

double median_of(std::span<const double> sorted) {
  assert(!sorted.empty());
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}

Interval wilson_interval(double successes, double runs) {
  if (!(runs > 0)) return {0, 1};
  constexpr double kZ = 1.959963984540054;  // of 95 %
  const double n = runs;
  const double share = successes / n;
  const double scale = 1 / (1 + kZ * kZ / n);
  const double middle = scale * (share + kZ * kZ / (2 * n));
  const double half = scale * kZ * std::sqrt(share * (1 - share) / n + kZ * kZ / (4 * n * n));
  return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

double shifted_geometric_mean(std::span<const double> values, int failures, double penalty,
                              double shift) {
  assert(failures > 0 || !values.empty());
  double sum = failures * std::log(penalty + shift);
  for (const double value : values) sum += std::log(value + shift);
  return std::exp(sum / (static_cast<double>(values.size()) + failures)) - shift;
}

Interval bootstrap_interval(std::span<const double> sample,
                            const std::function<double(std::span<const double>)>& statistic,
                            const Bootstrap& bootstrap) {
  assert(!sample.empty());
  RandomStream random{bootstrap.seed};
  const int last = static_cast<int>(sample.size()) - 1;
  std::vector<double> resample(sample.size());
  std::vector<double> statistics(static_cast<std::size_t>(bootstrap.resamples));
  for (double& value : statistics) {
    for (double& drawn : resample) drawn = sample[static_cast<std::size_t>(random.whole(0, last))];
    std::sort(resample.begin(), resample.end());
    value = statistic(resample);
  }
  std::sort(statistics.begin(), statistics.end());
  const double outside = (1 - bootstrap.confidence) / 2;
  return {quantile_of(statistics, outside), quantile_of(statistics, 1 - outside)};
}

}  // namespace bqsa::harness
