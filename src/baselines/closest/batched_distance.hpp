/// @file
/// Exact distances of many segments to many solid ellipsoids, with vector instructions.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "baselines/closest/point_arrays.hpp"
#include "bqsa/geometry/ellipsoid.hpp"

namespace bqsa::baselines {

/// Ellipsoids laid out for vector instructions: side by side, in blocks of eight. The last block is
/// filled up with the last ellipsoid.
class EllipsoidBlocks {
 public:
  explicit EllipsoidBlocks(std::span<const Ellipsoid> shapes);

  /// Ellipsoid j moves. Does not allocate.
  void set(int j, const Ellipsoid& shape);

  int count() const { return static_cast<int>(shapes_.size()); }
  int blocks() const;
  const Ellipsoid& operator[](int j) const { return shapes_[static_cast<std::size_t>(j)]; }

  /// As the kernel reads them (distance_kernel.hpp).
  const double* data() const { return numbers_.data(); }

 private:
  std::vector<Ellipsoid> shapes_;
  std::vector<double> numbers_;
};

/// Distances of all segments to all ellipsoids, block by block: what belongs to segment i and ellipsoid j
/// is at `index(i, j)`.
struct DistanceTable {
  DistanceTable(int segment_count, const EllipsoidBlocks& ellipsoids);

  std::size_t index(int i, int j) const;

  int segments;
  std::vector<double> distance;  ///< 0 where they meet, touching included, and only there [m]
  std::vector<double> t;  ///< of the segment's closest point, or of its deepest: 0 start, 1 end
};

/// Distances of the segments from `starts` to `ends`, of which there are as many, to all ellipsoids: the
/// answers of `segment_distance`, whose dual problem is solved for a vector of ellipsoids at a time. The
/// links of a chain with the n + 1 end-points x, y, z go from {x, y, z, n} to {x + 1, y + 1, z + 1, n}.
///
/// An answer is taken only if the closest points found and the plane between them prove it, to within
/// 1e-10 of the distance and the largest semi-axis; on eggs it comes to 1e-11. What does not converge in
/// the common loop (needles and sheets, next to touching) is asked of `segment_distance`. Does not
/// allocate.
void segment_distances(const PointArrays& starts, const PointArrays& ends,
                       const EllipsoidBlocks& ellipsoids, DistanceTable& out);

}  // namespace bqsa::baselines
