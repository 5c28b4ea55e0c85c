#include "harness/log_histogram.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bqsa::harness {

void LogHistogram::add_all(const LogHistogram& other) {
  for (const auto& [bin, count] : other.counts_) counts_[bin] += count;
}

std::int64_t LogHistogram::total() const {
  std::int64_t sum = 0;
  for (const auto& [bin, count] : counts_) sum += count;
  return sum;
}

double LogHistogram::quantile(double share) const {
  const double rank = std::ceil(share * static_cast<double>(total()));
  std::int64_t below = 0;
  for (const auto& [bin, count] : counts_) {
    below += count;
    if (static_cast<double>(below) >= rank) return middle_of(bin);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

int LogHistogram::bin_of(double value_in_units) {
  if (!(value_in_units >= 1)) return 0;
  const double bin = 1 + std::floor(kBinsPerOctave * std::log2(value_in_units));
  return static_cast<int>(std::min(bin, static_cast<double>(kLastBin)));
}

double LogHistogram::middle_of(int bin) {
  return bin <= 0 ? 0 : std::exp2((bin - 0.5) / kBinsPerOctave);
}

}  // namespace bqsa::harness
