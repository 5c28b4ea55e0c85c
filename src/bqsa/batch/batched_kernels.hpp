/// @file
/// The batched segment test behind plain pointers: vector code is compiled once for each instruction
/// set and must not share inline functions with the rest of the program.
#pragma once

#include <cstdint>

namespace bqsa::batch {

/// One pass over all pairs; layouts as in obstacle_batch.hpp and batched_test.hpp.
template <typename Real>
struct Pass {
  const Real* coefficients;
  int obstacles;
  const Real* points;
  int links;   ///< one less than points
  Real reach;  ///< largest size of a coordinate
};

/// Masks of all pairs. False if a point is out of reach; the masks of its links then mean nothing.
bool hit_masks_plane(const Pass<double>& pass, std::uint16_t* masks);
bool hit_masks_plane(const Pass<float>& pass, std::uint16_t* masks);
bool hit_masks_space(const Pass<double>& pass, std::uint16_t* masks);
bool hit_masks_space(const Pass<float>& pass, std::uint16_t* masks);

/// Five masks a pair of block and link: categories 1 to 5. False as above.
bool category_masks_plane(const Pass<double>& pass, std::uint16_t* masks);
bool category_masks_plane(const Pass<float>& pass, std::uint16_t* masks);
bool category_masks_space(const Pass<double>& pass, std::uint16_t* masks);
bool category_masks_space(const Pass<float>& pass, std::uint16_t* masks);

/// Whether all points are within reach and all pairs free.
bool all_free_plane(const Pass<double>& pass);
bool all_free_plane(const Pass<float>& pass);
bool all_free_space(const Pass<double>& pass);
bool all_free_space(const Pass<float>& pass);

}  // namespace bqsa::batch
