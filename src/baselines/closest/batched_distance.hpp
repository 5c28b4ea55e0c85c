/// @file
/// Exact distances of many segments to many solid ellipsoids, with vector instructions.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "baselines/closest/point_arrays.hpp"
#include "bqsa/geometry/ellipsoid.hpp"

namespace bqsa::baselines {

/// Ellipsoids side by side, in blocks of as many as the widest vector has doubles. The last block is
/// filled up with the last ellipsoid.
class EllipsoidBlocks {
 public:
  static constexpr int kBlock = 8;
  /// Numbers an ellipsoid: centre, rotation by columns, squared semi-axes, their reciprocals, and the
  /// largest semi-axis.
  static constexpr int kRows = 19;

  /// All semi-axes must be positive.
  explicit EllipsoidBlocks(std::span<const Ellipsoid> shapes);

  /// Ellipsoid j moves. Does not allocate.
  void set(int j, const Ellipsoid& shape);

  int count() const { return static_cast<int>(shapes_.size()); }
  int blocks() const { return (count() + kBlock - 1) / kBlock; }
  const Ellipsoid& operator[](int j) const { return shapes_[static_cast<std::size_t>(j)]; }

  /// Block after block, row after row, ellipsoid after ellipsoid.
  const double* data() const { return numbers_.data(); }

 private:
  std::vector<Ellipsoid> shapes_;
  std::vector<double> numbers_;
};

/// Where `segment_distances` writes, block-major: what belongs to segment i and ellipsoid j is at
/// `index(i, j)`. What fills up the last block is written too.
struct DistanceTable {
  DistanceTable(int segment_count, const EllipsoidBlocks& ellipsoids)
      : segments(segment_count),
        distance(static_cast<std::size_t>(segment_count * ellipsoids.blocks()) *
                 EllipsoidBlocks::kBlock),
        t(distance.size()) {}

  std::size_t index(int i, int j) const {
    constexpr int kBlock = EllipsoidBlocks::kBlock;
    return (static_cast<std::size_t>(j / kBlock) * static_cast<std::size_t>(segments) +
            static_cast<std::size_t>(i)) *
               kBlock +
           static_cast<std::size_t>(j % kBlock);
  }

  int segments;
  std::vector<double> distance;  ///< 0 where they meet, touching included [m]
  std::vector<double> t;  ///< of the segment's closest point, or of its deepest one: 0 start, 1 end
};

/// Distances of the segments from `starts` to `ends`, as many, to all ellipsoids: those of
/// `segment_distance`, whose dual problem is solved for a vector of ellipsoids at a time. The segments
/// of a chain with the end-points x, y, z are `{x, y, z, n}` and `{x + 1, y + 1, z + 1, n}`.
///
/// An answer is taken only if the closest points that it names, and the plane between them, prove it to
/// within 1e-11 of the lengths in play; what does not converge in the common loop is asked of
/// `segment_distance`. Does not allocate.
void segment_distances(const PointArrays& starts, const PointArrays& ends,
                       const EllipsoidBlocks& ellipsoids, DistanceTable& out);

}  // namespace bqsa::baselines
