// Compiled once for each instruction set; dispatched once a pass.

#include "bqsa/batch/batched_kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bqsa/batch/batched_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "bqsa/batch/segment_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bqsa::batch::HWY_NAMESPACE {
namespace {

constexpr int kBlock = 16;

template <typename Real>
using Vectors = hn::CappedTag<Real, kBlock>;

/// Coefficients of an obstacle.
constexpr int rows(int dim) { return dim == 2 ? 5 : 9; }

template <int Dim, typename Real>
bool within_reach(const Pass<Real>& pass) {
  const Vectors<Real> d;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  const int numbers = Dim * (pass.links + 1);
  const auto reach = hn::Set(d, pass.reach);
  auto within = hn::Le(hn::Zero(d), hn::Zero(d));
  int i = 0;
  for (; i + lanes <= numbers; i += lanes) {
    within = hn::And(within, hn::Le(hn::Abs(hn::LoadU(d, pass.points + i)), reach));
  }
  bool rest_within = true;
  for (; i < numbers; ++i) {
    rest_within &= -pass.reach <= pass.points[i] && pass.points[i] <= pass.reach;
  }
  return rest_within && hn::AllTrue(d, within);
}

/// Runs `of_link(first obstacle in the block, block, link, u, v)` on all pairs, block by block,
/// vector by vector, link by link; after a vector's last link `stop()` may end it.
template <int Dim, typename Real, class OfLink, class Stop>
HWY_INLINE void for_all_pairs(const Pass<Real>& pass, const OfLink& of_link, const Stop& stop) {
  const Vectors<Real> d;
  using V = hn::Vec<Vectors<Real>>;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  const V one = hn::Set(d, Real(1));
  for (int block = 0; block * kBlock < pass.obstacles; ++block) {
    const int filled = HWY_MIN(kBlock, pass.obstacles - block * kBlock);
    const Real* coefficients =
        pass.coefficients + static_cast<std::ptrdiff_t>(block) * kBlock * rows(Dim);
    for (int first = 0; first < filled; first += lanes) {
      const auto map = unit_map<Dim, V>(
          [&](int row) { return hn::Load(d, coefficients + row * kBlock + first); });
      const Real* point = pass.points;
      const auto next_point = [&] {
        const auto u = unit_point(
            map, [&](int axis) { return hn::Set(d, point[axis]); }, one);
        point += Dim;
        return u;
      };
      auto u = next_point();
      int link = 0;
      for (; link + 2 <= pass.links; link += 2) {  // by two, so that nothing need be moved
        const auto v = next_point();
        of_link(first, block, link, u, v);
        u = next_point();
        of_link(first, block, link + 1, v, u);
      }
      if (link < pass.links) of_link(first, block, link, u, next_point());
      if (stop()) return;
    }
  }
}

/// Bits of the obstacles from `first` on, into a mask whose earlier bits are written.
HWY_INLINE void put(unsigned some, int first, std::uint16_t* mask) {
  const unsigned earlier = first == 0 ? 0U : *mask;
  *mask = static_cast<std::uint16_t>(earlier | some << first);
}

/// The same for `lanes` bits that are to be inverted.
HWY_INLINE void put_inverted(unsigned some, int lanes, int first, std::uint16_t* mask) {
  put(some ^ ((1U << lanes) - 1), first, mask);
}

template <int Dim, typename Real>
bool hit_masks(const Pass<Real>& pass, std::uint16_t* masks) {
  const Vectors<Real> d;
  const auto one = hn::Set(d, Real(1));
  for_all_pairs<Dim>(
      pass,
      [&](int first, int block, int link, const auto& u, const auto& v) {
        const auto free = signs(d, free_sign(u, v, one));
        put_inverted(bits(d, free), static_cast<int>(hn::Lanes(d)), first,
                     masks + static_cast<std::ptrdiff_t>(block) * pass.links + link);
      },
      [] { return false; });
  return within_reach<Dim>(pass);
}

template <int Dim, typename Real>
bool category_masks(const Pass<Real>& pass, std::uint16_t* masks) {
  const Vectors<Real> d;
  const auto one = hn::Set(d, Real(1));
  const auto zero = hn::Zero(d);
  for_all_pairs<Dim>(
      pass,
      [&](int first, int block, int link, const auto& u, const auto& v) {
        const auto s12 = polar(u, v, one);
        const auto line = discriminant(u, v, s12);
        const auto start_out = signs(d, u.level);
        const auto end_out = signs(d, v.level);
        const auto out = hn::And(start_out, end_out);
        const auto between_free = signs(d, hn::Or(s12, line));
        const auto beyond = hn::And(between_free, hn::Gt(line, zero));
        std::uint16_t* mask = masks + 5 * (static_cast<std::ptrdiff_t>(block) * pass.links + link);
        put(bits(d, hn::And(out, hn::AndNot(beyond, between_free))), first, mask);
        put(bits(d, hn::And(out, beyond)), first, mask + 1);
        put(bits(d, hn::AndNot(between_free, out)), first, mask + 2);
        put(bits(d, hn::Xor(start_out, end_out)), first, mask + 3);
        put(bits(d, hn::Not(hn::Or(start_out, end_out))), first, mask + 4);
      },
      [] { return false; });
  return within_reach<Dim>(pass);
}

template <int Dim, typename Real>
bool all_free(const Pass<Real>& pass) {
  if (!within_reach<Dim>(pass)) return false;
  const Vectors<Real> d;
  const auto one = hn::Set(d, Real(1));
  auto free = hn::Set(d, Real(-1));
  bool all = true;
  for_all_pairs<Dim>(
      pass,
      [&](int, int, int, const auto& u, const auto& v) {
        free = hn::And(free, free_sign(u, v, one));
      },
      [&] {
        all = hn::AllTrue(d, signs(d, free));
        return !all;
      });
  return all;
}

bool hit_masks_plane_double(const Pass<double>& pass, std::uint16_t* masks) {
  return hit_masks<2>(pass, masks);
}
bool hit_masks_plane_float(const Pass<float>& pass, std::uint16_t* masks) {
  return hit_masks<2>(pass, masks);
}
bool hit_masks_space_double(const Pass<double>& pass, std::uint16_t* masks) {
  return hit_masks<3>(pass, masks);
}
bool hit_masks_space_float(const Pass<float>& pass, std::uint16_t* masks) {
  return hit_masks<3>(pass, masks);
}

bool category_masks_plane_double(const Pass<double>& pass, std::uint16_t* masks) {
  return category_masks<2>(pass, masks);
}
bool category_masks_plane_float(const Pass<float>& pass, std::uint16_t* masks) {
  return category_masks<2>(pass, masks);
}
bool category_masks_space_double(const Pass<double>& pass, std::uint16_t* masks) {
  return category_masks<3>(pass, masks);
}
bool category_masks_space_float(const Pass<float>& pass, std::uint16_t* masks) {
  return category_masks<3>(pass, masks);
}

bool all_free_plane_double(const Pass<double>& pass) { return all_free<2>(pass); }
bool all_free_plane_float(const Pass<float>& pass) { return all_free<2>(pass); }
bool all_free_space_double(const Pass<double>& pass) { return all_free<3>(pass); }
bool all_free_space_float(const Pass<float>& pass) { return all_free<3>(pass); }

}  // namespace
}  // namespace bqsa::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bqsa::batch {

HWY_EXPORT(hit_masks_plane_double);
HWY_EXPORT(hit_masks_plane_float);
HWY_EXPORT(hit_masks_space_double);
HWY_EXPORT(hit_masks_space_float);
HWY_EXPORT(category_masks_plane_double);
HWY_EXPORT(category_masks_plane_float);
HWY_EXPORT(category_masks_space_double);
HWY_EXPORT(category_masks_space_float);
HWY_EXPORT(all_free_plane_double);
HWY_EXPORT(all_free_plane_float);
HWY_EXPORT(all_free_space_double);
HWY_EXPORT(all_free_space_float);

bool hit_masks_plane(const Pass<double>& pass, std::uint16_t* masks) {
  return HWY_DYNAMIC_DISPATCH(hit_masks_plane_double)(pass, masks);
}
bool hit_masks_plane(const Pass<float>& pass, std::uint16_t* masks) {
  return HWY_DYNAMIC_DISPATCH(hit_masks_plane_float)(pass, masks);
}
bool hit_masks_space(const Pass<double>& pass, std::uint16_t* masks) {
  return HWY_DYNAMIC_DISPATCH(hit_masks_space_double)(pass, masks);
}
bool hit_masks_space(const Pass<float>& pass, std::uint16_t* masks) {
  return HWY_DYNAMIC_DISPATCH(hit_masks_space_float)(pass, masks);
}

bool category_masks_plane(const Pass<double>& pass, std::uint16_t* masks) {
  return HWY_DYNAMIC_DISPATCH(category_masks_plane_double)(pass, masks);
}
bool category_masks_plane(const Pass<float>& pass, std::uint16_t* masks) {
  return HWY_DYNAMIC_DISPATCH(category_masks_plane_float)(pass, masks);
}
bool category_masks_space(const Pass<double>& pass, std::uint16_t* masks) {
  return HWY_DYNAMIC_DISPATCH(category_masks_space_double)(pass, masks);
}
bool category_masks_space(const Pass<float>& pass, std::uint16_t* masks) {
  return HWY_DYNAMIC_DISPATCH(category_masks_space_float)(pass, masks);
}

bool all_free_plane(const Pass<double>& pass) {
  return HWY_DYNAMIC_DISPATCH(all_free_plane_double)(pass);
}
bool all_free_plane(const Pass<float>& pass) {
  return HWY_DYNAMIC_DISPATCH(all_free_plane_float)(pass);
}
bool all_free_space(const Pass<double>& pass) {
  return HWY_DYNAMIC_DISPATCH(all_free_space_double)(pass);
}
bool all_free_space(const Pass<float>& pass) {
  return HWY_DYNAMIC_DISPATCH(all_free_space_float)(pass);
}

}  // namespace bqsa::batch
#endif
