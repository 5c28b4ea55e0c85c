/// @file
/// What the detectors are measured on: arms among obstacles, made beforehand from a seed.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "baselines/closest/test_point_layout.hpp"
#include "bqsa/geometry/ellipsoid.hpp"

namespace bqsa::harness {

/// How much there is to detect, in the letters of the paper's section 3.4.
struct WorkloadSize {
  int dimension = 2;  ///< 2 or 3
  int links = 9;      ///< n
  int obstacles = 3;  ///< k
  baselines::TestPointCounts test_points = {.link = 15,
                                            .obstacle = 40};  ///< N a link, M an obstacle

  int pairs() const { return links * obstacles; }                              ///< nk
  int point_pairs() const { return test_points.link * test_points.obstacle; }  ///< NM

  bool operator==(const WorkloadSize& other) const {
    return dimension == other.dimension && links == other.links && obstacles == other.obstacles &&
           test_points.link == other.test_points.link &&
           test_points.obstacle == other.test_points.obstacle;
  }
};

/// A size with this nk: n is the largest divisor of nk up to 10.
/// @param point_pairs  NM, split so that points lie about equally dense on link and obstacle
WorkloadSize workload_size(int dimension, int pairs, int point_pairs);

/// An arm in many poses, so that no branch predictor learns the answers, among obstacles, of which a
/// fair share of the links hits some.
struct Workload {
  WorkloadSize size;
  std::vector<Eigen::Matrix3Xd>
      poses;  ///< O_1 .. O_{n+1}, a column each, in W [m]; z = 0 in the plane
  std::vector<Ellipsoid> obstacles;  ///< in the plane `embedded` ellipses
};

/// The same for all sizes up to the counts, on all machines.
Workload make_workload(const WorkloadSize& size, std::uint64_t seed);

}  // namespace bqsa::harness
