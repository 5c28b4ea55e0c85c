/// @file
/// Counts of values on a logarithmic scale, so that runs can be pooled without keeping each value.
#pragma once

#include <cstdint>
#include <map>

namespace bqsa::harness {

/// Bin 0 holds the values below 1 unit, bin i from 1 on those in [2^((i-1)/16), 2^(i/16)) units: 16
/// bins to the octave, each 4.4 % wide. Whole numbers up to 22 have a bin each.
class LogHistogram {
 public:
  static constexpr int kBinsPerOctave = 16;
  static constexpr int kLastBin = 64 * kBinsPerOctave;  ///< holds all above too

  void add(double value_in_units) { ++counts_[bin_of(value_in_units)]; }
  void add_bin(int bin, std::int64_t count) { counts_[bin] += count; }
  void add_all(const LogHistogram& other);

  std::int64_t total() const;
  const std::map<int, std::int64_t>& counts() const { return counts_; }

  /// The smallest value that at least this share of the values does not exceed, to half a bin
  /// (2.2 %): the geometric middle of its bin, 0 for bin 0, not a number if there are no values.
  double quantile(double share) const;

  /// Bin of a value; 0 for one that is negative or not a number.
  static int bin_of(double value_in_units);
  static double middle_of(int bin);

 private:
  std::map<int, std::int64_t> counts_;
};

}  // namespace bqsa::harness
