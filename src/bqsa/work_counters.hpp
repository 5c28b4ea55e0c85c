/// @file
/// What a method did, in exact counts.
#pragma once

#include <cstdint>

namespace bqsa {

/// Work done since `prepare`, in exact counts. Claims of complexity are compared with these.
struct WorkCounters {
  std::uint64_t quadratics = 0;        ///< segment-ellipsoid quadratics evaluated (all purposes)
  std::uint64_t bounds = 0;            ///< bounding boxes compared, to leave out pairs far apart
  std::uint64_t point_pairs = 0;       ///< test-point pairs compared
  std::uint64_t distance_queries = 0;  ///< exact or library distance queries
  std::uint64_t kinematics = 0;        ///< forward kinematics of the whole chain
  std::uint64_t jacobians = 0;         ///< Jacobians of one point
  std::uint64_t linear_solves = 0;     ///< decompositions of a task matrix
  std::uint64_t iterations = 0;  ///< steps of the method's own search; BQSA: clamping turns tried

  bool operator==(const WorkCounters&) const = default;
  WorkCounters operator+(const WorkCounters& other) const {
    WorkCounters sum = *this;
    sum.quadratics += other.quadratics;
    sum.bounds += other.bounds;
    sum.point_pairs += other.point_pairs;
    sum.distance_queries += other.distance_queries;
    sum.kinematics += other.kinematics;
    sum.jacobians += other.jacobians;
    sum.linear_solves += other.linear_solves;
    sum.iterations += other.iterations;
    return sum;
  }
};

}  // namespace bqsa
