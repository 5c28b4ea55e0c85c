#include "bqsa/neighbourhood/box_tree.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace bqsa {
namespace {

constexpr float kLargest = std::numeric_limits<float>::max();
constexpr float kInfinite = std::numeric_limits<float>::infinity();

/// Part of a single-precision number that covers its rounding and that of one more operation.
constexpr double kRounding = 0x1p-21;

float rounded_down(double value) {
  if (std::isinf(value) && value > 0) return kInfinite;
  if (value > kLargest) return kLargest;
  if (value < -kLargest) return -kInfinite;
  const auto nearest = static_cast<float>(value);
  return nearest > value ? std::nextafter(nearest, -kInfinite) : nearest;
}

float rounded_up(double value) { return -rounded_down(-value); }

/// Every third bit of the result is one of the 21 of `cell`.
std::uint64_t spread(std::uint64_t cell) {
  cell = (cell | cell << 32) & 0x1f00000000ffffU;
  cell = (cell | cell << 16) & 0x1f0000ff0000ffU;
  cell = (cell | cell << 8) & 0x100f00f00f00f00fU;
  cell = (cell | cell << 4) & 0x10c30c30c30c30c3U;
  return (cell | cell << 2) & 0x1249249249249249U;
}

/// Numbers of the boxes along a Morton curve of 2^21 cells an axis.
std::vector<std::int32_t> along_curve(std::span<const GrowingBox> boxes) {
  const auto center = [](const GrowingBox& box) -> Eigen::Vector3d {
    // Of a box without end the origin stands for the centre.
    const Eigen::Vector3d middle = 0.5 * (box.low.cast<double>() + box.high.cast<double>());
    return middle.allFinite() ? middle : Eigen::Vector3d::Zero();
  };
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = -low;
  for (const GrowingBox& box : boxes) {
    low = low.cwiseMin(center(box));
    high = high.cwiseMax(center(box));
  }
  constexpr double kCells = 0x1fffff;
  const double scale = kCells / std::max((high - low).maxCoeff(), 1e-300);
  std::vector<std::pair<std::uint64_t, std::int32_t>> keys;
  keys.reserve(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Eigen::Vector3d cell = (scale * (center(boxes[i]) - low)).cwiseMin(kCells);
    const auto bits = [&cell](int axis) { return spread(static_cast<std::uint64_t>(cell(axis))); };
    keys.emplace_back(bits(0) | bits(1) << 1 | bits(2) << 2, static_cast<std::int32_t>(i));
  }
  std::ranges::sort(keys);
  std::vector<std::int32_t> order;
  order.reserve(keys.size());
  for (const auto& [code, number] : keys) order.push_back(number);
  return order;
}

void write(const GrowingBox& box, std::size_t lane, BoxGroup& group) {
  for (int axis = 0; axis < 3; ++axis) {
    group.low[axis][lane] = box.low(axis);
    group.high[axis][lane] = box.high(axis);
    group.stretch[axis][lane] = box.stretch(axis);
  }
}

GrowingBox read(const BoxGroup& group, std::size_t lane) {
  GrowingBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.low(axis) = group.low[axis][lane];
    box.high(axis) = group.high[axis][lane];
    box.stretch(axis) = group.stretch[axis][lane];
  }
  return box;
}

const GrowingBox kEmpty{Eigen::Vector3f::Constant(kInfinite), Eigen::Vector3f::Constant(-kInfinite),
                        Eigen::Vector3f::Zero()};

GrowingBox around_all(const BoxGroup& group) {
  GrowingBox all = kEmpty;
  for (std::size_t lane = 0; lane < kBoxGroup; ++lane) {
    const GrowingBox box = read(group, lane);
    all.low = all.low.cwiseMin(box.low);
    all.high = all.high.cwiseMax(box.high);
    all.stretch = all.stretch.cwiseMax(box.stretch);
  }
  return all;
}

/// The boxes `box_at(0)` to `box_at(count - 1)`, in groups.
template <typename BoxAt>
std::vector<BoxGroup> grouped(std::size_t count, const BoxAt& box_at) {
  std::vector<BoxGroup> groups((count + kBoxGroup - 1) / kBoxGroup);
  for (std::size_t i = 0; i < groups.size() * kBoxGroup; ++i) {
    write(i < count ? box_at(i) : kEmpty, i % kBoxGroup, groups[i / kBoxGroup]);
  }
  return groups;
}

}  // namespace

GrowingBox GrowingBox::around(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                              const Eigen::Vector3d& stretch) {
  GrowingBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.low(axis) = rounded_down(low(axis));
    box.high(axis) = rounded_up(high(axis));
    // More than it is by what rounding may take from d times it. Finite: with d = 0 it must give 0.
    box.stretch(axis) = std::min(rounded_up((1 + 2 * kRounding) * stretch(axis)), kLargest);
  }
  return box;
}

double GrowingBox::gap(const Eigen::Vector3d& p1, const Eigen::Vector3d& p2, double d) const {
  constexpr double kSmall = 1e-15;
  double widest = -std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double growth = d * stretch(axis);
    const double below = low(axis) - growth - std::max(p1(axis), p2(axis));
    const double above = std::min(p1(axis), p2(axis)) - (high(axis) + growth);
    const double lengths = std::max(std::abs(p1(axis)), std::abs(p2(axis))) + growth;
    widest = std::max(widest, std::max(below, above) - kSmall * lengths);
  }
  return widest - kSmall * std::abs(widest);
}

BoxTree::BoxTree(std::span<const GrowingBox> boxes, std::span<const std::int32_t> ids) {
  assert(boxes.size() == ids.size());
  if (boxes.empty()) return;
  const std::vector<std::int32_t> order = along_curve(boxes);
  ids_.reserve(order.size());
  for (const std::int32_t i : order) ids_.push_back(ids[static_cast<std::size_t>(i)]);
  groups_.push_back(grouped(
      boxes.size(), [&](std::size_t i) { return boxes[static_cast<std::size_t>(order[i])]; }));
  while (groups_.back().size() > 1) {
    const std::vector<BoxGroup>& below = groups_.back();
    groups_.push_back(
        grouped(below.size(), [&below](std::size_t i) { return around_all(below[i]); }));
  }
  assert(groups_.size() <= BoxLevels::kMax);
}

BoxesFound BoxTree::search(const Eigen::Vector3d& p1, const Eigen::Vector3d& p2, double margin,
                           double d, std::span<std::int32_t> positions) const {
  assert(d > 0);
  BoxLevels levels{};
  levels.count = static_cast<int>(groups_.size());
  for (std::size_t level = 0; level < groups_.size(); ++level) {
    levels.groups[level] = groups_[level].data();
  }
  BoxQuery query{};
  for (int axis = 0; axis < 3; ++axis) {
    const double low = std::min(p1(axis), p2(axis)) - margin;
    const double high = std::max(p1(axis), p2(axis)) + margin;
    // Finite, as an infinite query would meet lanes without a box.
    query.low[axis] = std::max(rounded_down(low - kRounding * std::abs(low)), -kLargest);
    query.high[axis] = std::min(rounded_up(high + kRounding * std::abs(high)), kLargest);
  }
  query.distance = std::min(rounded_up(d), kLargest);
  return search_boxes(levels, query, positions.data(), positions.size());
}

GrowingBox BoxTree::box(std::int32_t position) const {
  const auto i = static_cast<std::size_t>(position);
  return read(groups_.front()[i / kBoxGroup], i % kBoxGroup);
}

std::size_t BoxTree::bytes() const {
  std::size_t sum = ids_.size() * sizeof(std::int32_t);
  for (const std::vector<BoxGroup>& level : groups_) sum += level.size() * sizeof(BoxGroup);
  return sum;
}

}  // namespace bqsa
