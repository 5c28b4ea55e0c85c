#include "baselines/closest/batched_distance.hpp"

#include <cassert>

#include "baselines/closest/distance_kernel.hpp"
#include "baselines/closest/segment_ellipsoid_distance.hpp"

namespace bqsa::baselines {
namespace {

constexpr int kBlock = kEllipsoidBlock;
constexpr int kRows = kEllipsoidRows;

std::size_t size(int count) { return static_cast<std::size_t>(count); }

struct Redo {
  const PointArrays& starts;
  const PointArrays& ends;
  const EllipsoidBlocks& ellipsoids;
  DistanceTable& out;
};

/// Asks the scalar routine.
void redo(void* context, int segment, int first, unsigned lanes) {
  const auto& [starts, ends, ellipsoids, out] = *static_cast<const Redo*>(context);
  const Eigen::Vector3d a(starts.x[segment], starts.y[segment], starts.z[segment]);
  const Eigen::Vector3d b(ends.x[segment], ends.y[segment], ends.z[segment]);
  for (int j = first; lanes != 0 && j < ellipsoids.count(); ++j, lanes >>= 1) {
    if ((lanes & 1u) == 0) continue;
    const SegmentDistance found = segment_distance(a, b, ellipsoids[j]);
    const std::size_t at = out.index(segment, j);
    out.distance[at] = found.distance;
    out.t[at] = found.s;
  }
}

}  // namespace

EllipsoidBlocks::EllipsoidBlocks(std::span<const Ellipsoid> shapes)
    : shapes_(shapes.begin(), shapes.end()), numbers_(size(blocks()) * kRows * kBlock) {
  for (int j = 0; j < count(); ++j) set(j, shapes_[size(j)]);
}

void EllipsoidBlocks::set(int j, const Ellipsoid& shape) {
  assert(j >= 0 && j < count());
  shapes_[size(j)] = shape;
  const Eigen::Vector3d squares = shape.semi_axes().cwiseAbs2();
  Eigen::Matrix<double, kRows, 1> rows;
  rows << shape.center(), shape.rotation().reshaped(), squares, squares.cwiseInverse(),
      shape.semi_axes().maxCoeff();
  const int end = j + 1 == count() ? blocks() * kBlock : j + 1;
  for (int column = j; column < end; ++column) {
    double* const block = &numbers_[size(column / kBlock) * kRows * kBlock];
    for (int row = 0; row < kRows; ++row) block[row * kBlock + column % kBlock] = rows(row);
  }
}

int EllipsoidBlocks::blocks() const { return (count() + kBlock - 1) / kBlock; }

DistanceTable::DistanceTable(int segment_count, const EllipsoidBlocks& ellipsoids)
    : segments(segment_count),
      distance(size(segment_count) * size(ellipsoids.blocks()) * kBlock),
      t(distance.size()) {}

std::size_t DistanceTable::index(int i, int j) const {
  return (size(j / kBlock) * size(segments) + size(i)) * kBlock + size(j % kBlock);
}

void segment_distances(const PointArrays& starts, const PointArrays& ends,
                       const EllipsoidBlocks& ellipsoids, DistanceTable& out) {
  assert(starts.count == ends.count && starts.count == out.segments);
  assert(out.distance.size() == size(out.segments) * size(ellipsoids.blocks()) * kBlock);
  Redo context{starts, ends, ellipsoids, out};
  run_distance_pass({.starts = &starts,
                     .ends = &ends,
                     .ellipsoids = ellipsoids.data(),
                     .blocks = ellipsoids.blocks(),
                     .distance = out.distance.data(),
                     .t = out.t.data(),
                     .redo = redo,
                     .context = &context});
}

}  // namespace bqsa::baselines
