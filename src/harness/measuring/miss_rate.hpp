/// @file
/// How many collisions a detector misses: what has to stand beside its time, for a speed at equal
/// numbers of test points says nothing about equal safety.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "harness/measuring/detector.hpp"
#include "harness/statistics/estimates.hpp"

namespace bqsa::harness {

/// Which pairs of link and obstacle are asked about. Links are 0.3 m long, obstacles have semi-axes of 5
/// to 25 cm, as those of `make_workload`, whose pairs are of the first population.
enum class Population {
  /// Links of any place and direction: hits of every depth. What a random configuration has, as a planner
  /// asks about. Links wholly inside an obstacle, one hit in seventy in the plane, are missed however
  /// many points there are on its surface, unless the detector asks for them (`test_points_inside`).
  kAnywhere,

  /// Links that run into the obstacle, in any direction, in steps of `kSweepStep`: the last step in which
  /// they are still free, and the first in which they are not. The hits that a controller has to see,
  /// which asks at every step and acts on the first. Shallow, and therefore easier on test points: where
  /// link and surface touch they run side by side, within the margin of each other for longer.
  kFirstContact,
};

/// A link at 0.5 m/s, asked 100 times a second [m].
inline constexpr double kSweepStep = 0.005;

/// Answers of one detector to one population, against the judge's exact distance. Pairs that touch to
/// within 1 um are left out.
struct MissRate {
  std::string_view detector;
  WorkloadSize size;     ///< n = k = 1; its test points do not matter to other detectors
  int hits = 0;          ///< the link meets the solid ellipse or ellipsoid
  int missed = 0;        ///< of them: called free
  int free = 0;          ///< it does not
  int false_alarms = 0;  ///< of them: called hits
  int far = 0;           ///< of the free: further away than the margin of the test points
  int far_alarms = 0;    ///< of them: called hits

  double miss_rate() const;  ///< of the hits, 0 to 1
  double false_alarm_rate() const;
  double far_alarm_rate() const;
  Interval miss_interval() const;  ///< 95 %, Wilson, as if pairs were independent
  Interval false_alarm_interval() const;
  Interval far_alarm_interval() const;
};

/// Pairs drawn once, to ask any number of detectors.
class PairPopulation {
 public:
  /// 256 links around each of 256 obstacles; for kFirstContact only those that run into it, twice each.
  PairPopulation(Population population, int dimension, std::uint64_t seed);

  /// @param test_points  N and M
  MissRate ask(const Detector& detector, const baselines::TestPointCounts& test_points) const;

  int dimension() const { return dimension_; }

 private:
  /// Links around one obstacle.
  struct Group {
    Workload workload;              ///< n = k = 1, a pose a link
    std::vector<double> clearance;  ///< signed distance of each link [m]
  };

  int dimension_;
  std::vector<Group> groups_;
};

}  // namespace bqsa::harness
