/// @file
/// What a comparison of old and new results found, and how it is printed.
#pragma once

#include <string>
#include <vector>

#include "harness/statistics/estimates.hpp"

namespace bqsa::harness {

enum class ComparisonFinding {
  kTie,
  kBetter,
  kWorse,      ///< a regression
  kUndecided,  ///< times that cannot be compared, or too few of them
};

/// One quantity of one method or benchmark.
struct ComparedRow {
  std::string subject;   ///< method or benchmark
  std::string quantity;  ///< `success`, `quadratics`, `tick median`, ...
  std::string before;
  std::string after;
  std::string change;    ///< `x 1.23`, `1 lost, 0 won`
  std::string interval;  ///< of the change
  std::string p;         ///< that so much comes by chance
  ComparisonFinding finding = ComparisonFinding::kTie;
  bool differs = false;  ///< shown even if nothing was found
};

struct ComparisonReport {
  std::vector<ComparedRow> rows;
  std::vector<std::string> notes;  ///< a line each

  int count(ComparisonFinding finding) const;
};

struct ComparisonSettings {
  /// New time over old: a time is worse if its ratio is above this with confidence, better below its
  /// inverse. Two runs of the very same program often differ "significantly", by a few per cent.
  double time_threshold = 1.10;
};

/// Of everything in a report that chance has a part in: with so many comparisons, the probability that
/// any of them is called worse or better by chance alone is at most 5 % (Bonferroni).
double confidence_of_each(std::size_t comparisons);

/// By a ratio of times and its interval.
ComparisonFinding finding_of_ratio(double ratio, const Interval& interval,
                                   const ComparisonSettings& settings);

/// Plain text: rows of what differs, or all, the notes, and a line of counts.
std::string render_comparison(const ComparisonReport& report, bool all);

/// A time with three digits and its unit, ns to s.
std::string time_text(double seconds);

std::string ratio_text(double ratio);
std::string interval_text(const Interval& interval);
std::string p_text(double p);

}  // namespace bqsa::harness
