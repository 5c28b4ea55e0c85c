#include "bqsa/neighbourhood/box_search.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bqsa/neighbourhood/box_search.cpp"
#include <hwy/foreach_target.h>
// Last, as it is compiled once for each instruction set.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace bqsa {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Bit i tells whether box i of the group meets the query. Rounding is the caller's affair.
HWY_INLINE std::uint32_t meeting(const BoxGroup& group, const BoxQuery& query) {
  const hn::CappedTag<float, kBoxGroup> d;
  constexpr std::size_t kLanes = hn::MaxLanes(d);
  const auto distance = hn::Set(d, query.distance);
  std::uint32_t bits = 0;
  for (std::size_t lane = 0; lane < kBoxGroup; lane += kLanes) {
    auto meets = hn::FirstN(d, kLanes);
    for (int axis = 0; axis < 3; ++axis) {
      const auto stretch = hn::Load(d, group.stretch[axis] + lane);
      const auto low = hn::NegMulAdd(distance, stretch, hn::Load(d, group.low[axis] + lane));
      const auto high = hn::MulAdd(distance, stretch, hn::Load(d, group.high[axis] + lane));
      meets = hn::And(meets, hn::And(hn::Le(low, hn::Set(d, query.high[axis])),
                                     hn::Ge(high, hn::Set(d, query.low[axis]))));
    }
    std::uint8_t packed[8] = {};
    hn::StoreMaskBits(d, meets, packed);
    const auto lanes = static_cast<std::uint32_t>(packed[0] | packed[1] << 8);
    bits |= (lanes & ((std::uint32_t{1} << kLanes) - 1)) << lane;
  }
  return bits;
}

/// Depth first: on each level a group, and which of its boxes are still to be opened.
BoxesFound search(const BoxLevels& levels, const BoxQuery& query, std::int32_t* found,
                  std::size_t capacity) {
  BoxesFound result{0, true, 0};
  if (levels.count == 0) return result;
  const int top = levels.count - 1;
  std::int32_t group[BoxLevels::kMax];
  std::uint32_t open[BoxLevels::kMax];
  int level = top;
  group[level] = 0;
  open[level] = meeting(levels.groups[level][0], query);
  result.asked += kBoxGroup;
  while (level <= top) {
    if (open[level] == 0) {
      ++level;
      continue;
    }
    const auto lane = static_cast<std::int32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(open[level]));
    open[level] &= open[level] - 1;
    const std::int32_t box = group[level] * kBoxGroup + lane;
    if (level > 0) {
      --level;
      group[level] = box;
      open[level] = meeting(levels.groups[level][box], query);
      result.asked += kBoxGroup;
    } else if (result.count < capacity) {
      found[result.count++] = box;
    } else {
      result.all = false;
      return result;
    }
  }
  return result;
}

}  // namespace HWY_NAMESPACE
}  // namespace bqsa
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bqsa {

HWY_EXPORT(search);

BoxesFound search_boxes(const BoxLevels& levels, const BoxQuery& query, std::int32_t* found,
                        std::size_t capacity) {
  return HWY_DYNAMIC_DISPATCH(search)(levels, query, found, capacity);
}

}  // namespace bqsa
#endif
