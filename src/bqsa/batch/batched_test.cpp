#include "bqsa/batch/batched_test.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <type_traits>

#include "bqsa/batch/batched_kernels.hpp"

namespace bqsa {
namespace {

static_assert(sizeof(CategoryMasks) == 5 * sizeof(HitMask) &&
              std::is_standard_layout_v<CategoryMasks>);

/// The workspace's reach, rounded towards 0.
template <typename Real>
Real reach_of(const Workspace& workspace) {
  const auto reach = static_cast<Real>(workspace.reach);
  return static_cast<double>(reach) <= workspace.reach ? reach : std::nextafter(reach, Real(0));
}

template <int Dim, typename Real>
batch::Pass<Real> pass_over(const ObstacleBatch<Dim, Real>& obstacles,
                            std::span<const Real> points) {
  assert(points.size() >= 2 * Dim && points.size() % Dim == 0);
  return {obstacles.coefficients(), obstacles.size(), points.data(),
          static_cast<int>(points.size()) / Dim - 1, reach_of<Real>(obstacles.workspace())};
}

/// Calls `of(block and link, obstacles of the block)` for all links with an end out of reach.
template <int Dim, typename Real, typename Of>
void for_links_out_of_reach(const ObstacleBatch<Dim, Real>& obstacles,
                            const batch::Pass<Real>& pass, const Of& of) {
  const auto within = [&pass](int point) {
    const Real* p = pass.points + static_cast<std::ptrdiff_t>(point) * Dim;
    return std::all_of(p, p + Dim, [&pass](Real x) { return std::abs(x) <= pass.reach; });
  };
  for (int link = 0; link < pass.links; ++link) {
    if (within(link) && within(link + 1)) continue;
    for (int block = 0; block < obstacles.blocks(); ++block) {
      const int count = std::min(obstacles.size() - block * obstacles.kBlock, obstacles.kBlock);
      of(static_cast<std::size_t>(block) * static_cast<std::size_t>(pass.links) +
             static_cast<std::size_t>(link),
         static_cast<HitMask>((1U << count) - 1));
    }
  }
}

}  // namespace

template <int Dim, typename Real>
void hit_masks(const ObstacleBatch<Dim, Real>& obstacles, std::span<const Real> points,
               std::span<HitMask> masks) {
  const batch::Pass<Real> pass = pass_over(obstacles, points);
  assert(masks.size() == masks_needed(obstacles, pass.links));
  const bool within_reach = Dim == 2 ? batch::hit_masks_plane(pass, masks.data())
                                     : batch::hit_masks_space(pass, masks.data());
  if (within_reach) return;
  for_links_out_of_reach(obstacles, pass,
                         [&masks](std::size_t pair, HitMask all) { masks[pair] = all; });
}

template <int Dim, typename Real>
void category_masks(const ObstacleBatch<Dim, Real>& obstacles, std::span<const Real> points,
                    std::span<CategoryMasks> masks) {
  const batch::Pass<Real> pass = pass_over(obstacles, points);
  assert(masks.size() == masks_needed(obstacles, pass.links));
  HitMask* first = masks.empty() ? nullptr : &masks.front().no_collision_1;
  const bool within_reach = Dim == 2 ? batch::category_masks_plane(pass, first)
                                     : batch::category_masks_space(pass, first);
  if (within_reach) return;
  for_links_out_of_reach(obstacles, pass, [&masks](std::size_t pair, HitMask all) {
    masks[pair] = CategoryMasks{};
    masks[pair].crossing = all;
  });
}

template <int Dim, typename Real>
bool any_hit(const ObstacleBatch<Dim, Real>& obstacles, std::span<const Real> points) {
  const batch::Pass<Real> pass = pass_over(obstacles, points);
  if (pass.obstacles == 0) return false;
  return !(Dim == 2 ? batch::all_free_plane(pass) : batch::all_free_space(pass));
}

#define BQSA_INSTANTIATE(Dim, Real)                                                    \
  template void hit_masks(const ObstacleBatch<Dim, Real>&, std::span<const Real>,      \
                          std::span<HitMask>);                                         \
  template void category_masks(const ObstacleBatch<Dim, Real>&, std::span<const Real>, \
                               std::span<CategoryMasks>);                              \
  template bool any_hit(const ObstacleBatch<Dim, Real>&, std::span<const Real>);

BQSA_INSTANTIATE(2, double)
BQSA_INSTANTIATE(3, double)
BQSA_INSTANTIATE(2, float)
BQSA_INSTANTIATE(3, float)
#undef BQSA_INSTANTIATE

}  // namespace bqsa
