/// @file
/// The segment test (segment_test.hpp), polar form, of one chain's links against many obstacles at a
/// time, with the best vector instructions of the processor (instruction_set.hpp).
///
///     std::vector<Ellipsoid> shapes = ...;
///     const ObstacleBatch<3, float> obstacles(shapes, {.reach = 2, .link_length = 0.4});
///     std::vector<HitMask> masks(masks_needed(obstacles, links));
///     hit_masks<3, float>(obstacles, points, masks);  // points: x y z of O_1, x y z of O_2, ...
///     const bool hit = masks[(j / 16) * links + i] >> (j % 16) & 1;  // link i hits obstacle j
///
/// Link i joins points i and i + 1. Every end-point is mapped once for both its links: 14 multiply-adds
/// a pair in space, 9 in the plane. Links of zero length are tested like all others.
///
/// Touching counts as a hit, and where all intermediate results are representable, all instruction
/// sets decide it alike. Links that end beyond the workspace's reach, or in what is not a number, hit all
/// obstacles (as category 3). In float a true hit is never called free (single_precision.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "bqsa/batch/obstacle_batch.hpp"

namespace bqsa {

/// Bit j of the mask of block b and link i: obstacle 16 b + j. Bits beyond the last obstacle are 0.
using HitMask = std::uint16_t;

/// How all obstacles of a block lie to one link: bit j of the mask of a category (segment_test.hpp) is
/// set if obstacle j is in that category. Every obstacle is in exactly one; bits beyond the last are in
/// no mask of hits.
struct CategoryMasks {
  HitMask no_collision_1, no_collision_2, crossing, one_end_inside, contained;

  HitMask hits() const { return static_cast<HitMask>(crossing | one_end_inside | contained); }
};

/// Masks that all pairs take: block-major, block b and link i at [b * links + i].
template <int Dim, typename Real>
std::size_t masks_needed(const ObstacleBatch<Dim, Real>& obstacles, int links) {
  return static_cast<std::size_t>(obstacles.blocks()) * static_cast<std::size_t>(links);
}

/// Which links hit which obstacles. Does not allocate.
/// @param points  Dim coordinates of every end-point, one after another, at least two points [m]
/// @param masks   as many as `masks_needed`, all of them written
template <int Dim, typename Real>
void hit_masks(const ObstacleBatch<Dim, Real>& obstacles, std::span<const Real> points,
               std::span<HitMask> masks);

/// In which category every pair is. Points and places as above. Does not allocate.
template <int Dim, typename Real>
void category_masks(const ObstacleBatch<Dim, Real>& obstacles, std::span<const Real> points,
                    std::span<CategoryMasks> masks);

/// Whether any link hits any obstacle; stops at the first block with a hit. Does not allocate.
template <int Dim, typename Real>
bool any_hit(const ObstacleBatch<Dim, Real>& obstacles, std::span<const Real> points);

}  // namespace bqsa
