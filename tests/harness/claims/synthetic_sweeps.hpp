/// @file
/// Sweeps with times that are known.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "harness/measuring/sweep.hpp"

namespace bqsa::harness::claims {

/// A series' name and its time at a point of the axis [s].
using KnownTime = std::pair<std::string, std::function<double(double)>>;

/// NM (or nk) = 1, 10, ... 10,000 in four processes, whose times differ by a common factor of up to
/// 1 + jitter for all series and by a tenth of that for each.
inline Sweep synthetic_sweep(const std::string& name, SweepAxis axis,
                             const std::vector<KnownTime>& times, double jitter = 1e-3) {
  Sweep sweep{name, axis, {}, {}};
  for (const auto& [series, time] : times) sweep.series.push_back({series, {}, {}, {}});
  for (int at = 1; at <= 10000; at *= 10) {
    WorkloadSize size{.dimension = 2, .links = 1, .obstacles = 1, .test_points = {1, 1}};
    (axis == SweepAxis::kPointPairs ? size.test_points.obstacle : size.obstacles) = at;
    sweep.sizes.push_back(size);
    for (std::size_t s = 0; s < times.size(); ++s) {
      std::vector<double> processes;
      for (int p = 0; p < 4; ++p) {
        const double own = 0.1 * static_cast<double>((p + 2 * static_cast<int>(s)) % 4);
        processes.push_back(times[s].second(at) * (1 + jitter * (p + own) / 4));
      }
      sweep.series[s].seconds.push_back(processes);
    }
  }
  return sweep;
}

/// The gate's self-test: what stands there is 1, `again` and `half_more`.
inline Sweep synthetic_gate(double again, double half_more, double jitter = 1e-3) {
  return synthetic_sweep("gate", SweepAxis::kPairs,
                         {{"once", [](double) { return 1.0; }},
                          {"once_again", [again](double) { return again; }},
                          {"half_more", [half_more](double) { return half_more; }}},
                         jitter);
}

}  // namespace bqsa::harness::claims
