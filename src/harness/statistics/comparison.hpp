/// @file
/// Whether two samples differ: paired differences and the test of Mann and Whitney. Pure functions.
#pragma once

#include <span>

#include "harness/statistics/estimates.hpp"

namespace bqsa::harness {

/// What is left when the same problem is measured in two ways: of a_i - b_i over all i.
struct PairedComparison {
  int a_less = 0;
  int equal = 0;
  int b_less = 0;
  double median = 0;   ///< of the differences
  Interval interval;   ///< bootstrap interval of the median
  double sign_test_p;  ///< two-sided, exact, equal pairs left out; 1 if all are equal

  /// A tie unless the interval says otherwise.
  bool is_tie() const { return interval.contains(0); }
};

/// For ratios, give it logarithms.
/// @param a, b  of equal length, not empty
PairedComparison compare_pairs(std::span<const double> a, std::span<const double> b,
                               const Bootstrap& bootstrap = {});

struct MannWhitney {
  double u;  ///< pairs (a_i, b_j) with a_i > b_j; equal ones count one half
  double p;  ///< two-sided
};

/// Whether values of a tend to be larger or smaller than those of b. Exact for up to 400 pairs
/// without equal values, else by the normal approximation with corrections for continuity and equal
/// values (Mann and Whitney 1947).
/// @param a, b  not empty
MannWhitney mann_whitney(std::span<const double> a, std::span<const double> b);

}  // namespace bqsa::harness
