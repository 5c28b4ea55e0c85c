/// @file
/// Which boxes meet a box, by vector instructions, in a tree of groups of boxes.
#pragma once

#include <cstddef>
#include <cstdint>

namespace bqsa {

/// Boxes that are asked together.
inline constexpr int kBoxGroup = 16;

/// Boxes that grow with the distance asked for: of axis a, [low - d stretch, high + d stretch]. Of each a
/// lane; lanes without a box hold an empty one.
struct alignas(64) BoxGroup {
  float low[3][kBoxGroup];      ///< [m]
  float high[3][kBoxGroup];     ///< [m]
  float stretch[3][kBoxGroup];  ///< [-]
};

/// A tree without pointers: box i of a level holds all boxes of group i of the level below.
struct BoxLevels {
  static constexpr int kMax = 8;  ///< enough for 16^8 boxes
  const BoxGroup* groups[kMax];   ///< of a level; the last one has a single group
  int count;                      ///< of levels; 0 if there are no boxes
};

/// What is looked for: boxes that meet this one when they are asked for a distance.
struct BoxQuery {
  float low[3], high[3];  ///< [m]
  float distance;         ///< d, positive [m]
};

struct BoxesFound {
  std::size_t count;    ///< of those written
  bool all;             ///< false if there are more than fitted
  std::uint64_t asked;  ///< boxes of all levels that were compared
};

/// Writes the indices of the boxes of the lowest level that meet the query, not in order.
BoxesFound search_boxes(const BoxLevels& levels, const BoxQuery& query, std::int32_t* found,
                        std::size_t capacity);

}  // namespace bqsa
