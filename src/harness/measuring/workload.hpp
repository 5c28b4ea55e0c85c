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

/// A size with exactly this nk and NM: n is the largest divisor of nk up to 10, and N the divisor of
/// NM with which points lie most nearly as dense on links as on obstacles, which misses least.
/// @throws InputError unless dimension is 2 or 3 and both others are positive
WorkloadSize workload_size(int dimension, int pairs, int point_pairs);

/// Of every link of a workload [m].
inline constexpr double kLinkLength = 0.3;

/// An arm in many poses, so that no answer is always the same, among obstacles.
struct Workload {
  WorkloadSize size;

  /// O_1 .. O_{n+1}, a column each, in W [m]; z = 0 in the plane.
  std::vector<Eigen::Matrix3Xd> poses;

  std::vector<Ellipsoid> obstacles;  ///< in the plane `embedded` ellipses
};

/// Links are in a disk or ball, which they fill about evenly whatever their number; obstacles have their
/// centres in its middle and semi-axes of 5 to 25 cm. About every eighth pair is a hit in the plane, and
/// every eleventh in space, for every n and k, more or less if there are but few obstacles. (Such a crowd
/// suits no broadphase, which can leave out free pairs only, and only those whose boxes are apart.)
/// Poses are as many as make 1024 links, and at least 32.
///
/// The same on all machines; poses and obstacles do not depend on the numbers of test points, and those
/// of a smaller n or k are the first ones of a larger.
Workload make_workload(const WorkloadSize& size, std::uint64_t seed);

}  // namespace bqsa::harness
