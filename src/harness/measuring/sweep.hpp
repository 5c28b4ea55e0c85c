/// @file
/// Times of detectors (or control steps) over a range of sizes, and what they say: ratios, exponents,
/// crossovers. The unit of all intervals is the process: within one, blocks of all contestants are
/// interleaved in random order; between processes, memory layout and machine may differ.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/measuring/workload.hpp"
#include "harness/statistics/estimates.hpp"
#include "harness/statistics/fits.hpp"

namespace bqsa::harness {

/// The quantity along a sweep's axis.
enum class SweepAxis {
  kPointPairs,  ///< NM, test points of a link times those of an obstacle
  kPairs,       ///< nk, links times obstacles
};

/// That of a sweep by its name: `..._nm` or `..._nk`.
SweepAxis axis_of(std::string_view sweep_name);

/// One contestant's times.
struct Series {
  std::string name;  ///< of the detector or method

  /// Of one pass over all nk pairs, or one control step, [size][process]: in a
  /// typical round of the process (contest.hpp), processor time of the thread [s]. At a size that was left out for this series
  /// there is no process.
  std::vector<std::vector<double>> seconds;

  /// The paper's protocol: mean of 100 single passes by the wall clock, in the first process, [size];
  /// empty if it was not measured, not a number at sizes left out [s].
  std::vector<double> paper_seconds;
  std::vector<int> paper_passes = {};  ///< how many they were, [size]

  bool measured(std::size_t size) const { return !seconds[size].empty(); }

  /// The median over processes at a size that was measured [s].
  double median(std::size_t size) const;
};

struct Sweep {
  std::string name;  ///< one of sweep_names() (run_sweep.hpp)
  SweepAxis axis;
  std::vector<WorkloadSize> sizes;
  std::vector<Series> series;

  /// The quantity of the axis at a size.
  double at(std::size_t size) const;
  /// @return null if there is no such series
  const Series* find(std::string_view name) const;
};

/// A number with its 95 % interval over processes (Student's t of the processes' own estimates; needs
/// at least two, else the interval is the whole range). All that follows needs the series named to be
/// there, and those of a pair to come from the same processes.
struct Estimate {
  double value;
  Interval interval;
};

/// Time at one size where it was measured: geometric mean over processes [s].
Estimate time_of(const Sweep& sweep, std::string_view name, std::size_t size);

/// Time of a over time of b at one size where both were measured: geometric mean over processes of the
/// ratios within each.
Estimate time_ratio(const Sweep& sweep, std::string_view a, std::string_view b, std::size_t size);

/// The same of times that were taken together, one of each a process.
Estimate time_ratio(const std::vector<double>& a, const std::vector<double>& b);

/// The slope of log(time) against log(axis) from the size `from` on, at least three sizes measured.
Estimate time_exponent(const Sweep& sweep, std::string_view name, std::size_t from = 0);

/// The size from which on exponents are shown: the larger half, in which what any pass costs does not
/// matter.
std::size_t exponents_from(const Sweep& sweep);

/// time = intercept + slope x axis, weighted by 1/time², so that small sizes count as much as large. At
/// least three sizes measured.
struct LinearTime {
  Estimate intercept;  ///< [s]
  Estimate slope;      ///< [s per unit of the axis]
  double r_squared;    ///< of the medians over processes, unweighted
};
LinearTime linear_time(const Sweep& sweep, std::string_view name);

/// Where a, growing along the axis, starts to take longer than b and goes on to: log(ratio) linear in
/// log(axis) between the sizes at which both were measured; geometric mean over processes. Nothing if
/// in some process b still takes as long at the last size. If in some process a takes longer from the
/// first size on, the value is 0, and the upper bound that size or the largest crossover found.
std::optional<Estimate> crossover(const Sweep& sweep, std::string_view a, std::string_view b);

}  // namespace bqsa::harness
