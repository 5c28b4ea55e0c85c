#include "baselines/closest/batched_test_points.hpp"

#include <algorithm>
#include <cassert>

#include "baselines/closest/test_point_kernel.hpp"

namespace bqsa::baselines {
namespace {

constexpr int kBlock = kPointBlock;

std::size_t size(int count) { return static_cast<std::size_t>(count); }

int in_blocks(int count) { return (count + kBlock - 1) / kBlock; }

}  // namespace

int PointGroups::groups() const { return points.count / count; }

PointBlocks::PointBlocks(Lanes lanes, int dimension, int groups, int count)
    : lanes_(lanes), dimension_(dimension), groups_(groups), count_(count) {
  assert(dimension == 2 || dimension == 3);
  assert(count > 0);
  numbers_.resize(size(blocks()) * size(rows()) * size(dimension) * kBlock);
}

int PointBlocks::blocks() const { return lanes_ == Lanes::kPoints ? groups_ : in_blocks(groups_); }

int PointBlocks::rows() const { return lanes_ == Lanes::kPoints ? in_blocks(count_) : count_; }

void PointBlocks::set(int g, const Eigen::Ref<const Eigen::MatrixX3d>& points) {
  assert(g >= 0 && g < groups_ && points.rows() == count_);
  const bool side_by_side = lanes_ == Lanes::kPoints;
  const int end = !side_by_side && g + 1 == groups_ ? blocks() * kBlock : g + 1;
  for (int group = g; group < end; ++group) {
    const int block = side_by_side ? group : group / kBlock;
    const int places = side_by_side ? rows() * kBlock : count_;
    for (int k = 0; k < places; ++k) {
      const int row = block * rows() + (side_by_side ? k / kBlock : k);
      const int lane = side_by_side ? k % kBlock : group % kBlock;
      for (int axis = 0; axis < dimension_; ++axis) {
        numbers_[(size(row) * size(dimension_) + size(axis)) * kBlock + size(lane)] =
            points(std::min(k, count_ - 1), axis);
      }
    }
  }
}

std::size_t PointBlocks::index(int g, int i, int n) const {
  if (lanes_ == Lanes::kPoints) return size(g) * size(n) + size(i);
  return (size(g / kBlock) * size(n) + size(i)) * kBlock + size(g % kBlock);
}

std::size_t least_needed(const PointBlocks& blocks, const PointGroups& others) {
  const std::size_t each = blocks.lanes() == PointBlocks::Lanes::kPoints ? 1 : kBlock;
  return size(blocks.blocks()) * size(others.groups()) * each;
}

void least_squared_distances(const PointBlocks& blocks, const PointGroups& others,
                             Rounding rounding, std::span<double> least) {
  assert(others.points.count % others.count == 0);
  assert(least.size() == least_needed(blocks, others));
  run_test_point_pass({.blocks = blocks.data(),
                       .dimension = blocks.dimension(),
                       .block_count = blocks.blocks(),
                       .rows = blocks.rows(),
                       .points = others.points,
                       .count = others.count,
                       .across = blocks.lanes() == PointBlocks::Lanes::kPoints,
                       .fused = rounding == Rounding::kFused,
                       .least = least.data()});
}

double work_a_pair(PointBlocks::Lanes lanes, int groups, int count, int others_count) {
  constexpr double kAcrossLanes = 4;  // for the least of all lanes
  if (lanes == PointBlocks::Lanes::kPoints) return others_count * in_blocks(count) + kAcrossLanes;
  return static_cast<double>(count * others_count * in_blocks(groups)) / groups;
}

}  // namespace bqsa::baselines
