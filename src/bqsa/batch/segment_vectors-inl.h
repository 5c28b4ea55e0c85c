// The segment test in vectors of one instruction set; included by units that are compiled once for each.
//
// Levels are negated against segment_test.hpp: S_ij = 1 - u_i·u_j, so that touching, +0, has the sign of a
// hit, and a pair is free exactly if the sign bits say
//
//     S11 < 0  and  S22 < 0  and  (S12 < 0  or  S12² - S11 S22 < 0).

#if defined(BQSA_BATCH_SEGMENT_VECTORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BQSA_BATCH_SEGMENT_VECTORS_INL_H_
#undef BQSA_BATCH_SEGMENT_VECTORS_INL_H_
#else
#define BQSA_BATCH_SEGMENT_VECTORS_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace bqsa::batch::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Coefficients of an affine map to the unit ball, in the order of obstacle_batch.hpp.
template <int Dim, class V>
struct UnitMap;

template <class V>
struct UnitMap<2, V> {
  V t00, t01, t11, k0, k1;
};

template <class V>
struct UnitMap<3, V> {
  V t00, t01, t02, t11, t12, t22, k0, k1, k2;
};

/// A point as obstacles see it, and its negated level.
template <int Dim, class V>
struct UnitPoint;

template <class V>
struct UnitPoint<2, V> {
  V u0, u1, level;
};

template <class V>
struct UnitPoint<3, V> {
  V u0, u1, u2, level;
};

/// `coefficient(row)` is the vector of that row.
template <class V, class Coefficient>
HWY_INLINE UnitMap<2, V> unit_map_plane(const Coefficient& coefficient) {
  return {coefficient(0), coefficient(1), coefficient(2), coefficient(3), coefficient(4)};
}

template <class V, class Coefficient>
HWY_INLINE UnitMap<3, V> unit_map_space(const Coefficient& coefficient) {
  return {coefficient(0), coefficient(1), coefficient(2), coefficient(3), coefficient(4),
          coefficient(5), coefficient(6), coefficient(7), coefficient(8)};
}

template <int Dim, class V, class Coefficient>
HWY_INLINE UnitMap<Dim, V> unit_map(const Coefficient& coefficient) {
  if constexpr (Dim == 2) {
    return unit_map_plane<V>(coefficient);
  } else {
    return unit_map_space<V>(coefficient);
  }
}

/// 1 - u·v.
template <class V>
HWY_INLINE V polar(const UnitPoint<2, V>& u, const UnitPoint<2, V>& v, V one) {
  return hn::NegMulAdd(u.u0, v.u0, hn::NegMulAdd(u.u1, v.u1, one));
}

template <class V>
HWY_INLINE V polar(const UnitPoint<3, V>& u, const UnitPoint<3, V>& v, V one) {
  return hn::NegMulAdd(u.u0, v.u0, hn::NegMulAdd(u.u1, v.u1, hn::NegMulAdd(u.u2, v.u2, one)));
}

/// `coordinate(i)` is the vector of that coordinate of the points.
template <class V, class Coordinate>
HWY_INLINE UnitPoint<2, V> unit_point(const UnitMap<2, V>& map, const Coordinate& coordinate,
                                      V one) {
  const V x = coordinate(0), y = coordinate(1);
  UnitPoint<2, V> u;
  u.u0 = hn::MulAdd(map.t00, x, hn::MulAdd(map.t01, y, map.k0));
  u.u1 = hn::MulAdd(map.t11, y, map.k1);
  u.level = polar(u, u, one);
  return u;
}

template <class V, class Coordinate>
HWY_INLINE UnitPoint<3, V> unit_point(const UnitMap<3, V>& map, const Coordinate& coordinate,
                                      V one) {
  const V x = coordinate(0), y = coordinate(1), z = coordinate(2);
  UnitPoint<3, V> u;
  u.u0 = hn::MulAdd(map.t00, x, hn::MulAdd(map.t01, y, hn::MulAdd(map.t02, z, map.k0)));
  u.u1 = hn::MulAdd(map.t11, y, hn::MulAdd(map.t12, z, map.k1));
  u.u2 = hn::MulAdd(map.t22, z, map.k2);
  u.level = polar(u, u, one);
  return u;
}

/// S12² - S11 S22 of the link from u to v, for its S12.
template <int Dim, class V>
HWY_INLINE V discriminant(const UnitPoint<Dim, V>& u, const UnitPoint<Dim, V>& v, V s12) {
  return hn::NegMulAdd(u.level, v.level, hn::Mul(s12, s12));
}

/// The sign bit is set where the link from u to v is free; other bits mean nothing.
template <int Dim, class V>
HWY_INLINE V free_sign(const UnitPoint<Dim, V>& u, const UnitPoint<Dim, V>& v, V one) {
  const V s12 = polar(u, v, one);
  return hn::And(hn::And(u.level, v.level), hn::Or(s12, discriminant(u, v, s12)));
}

/// Lanes whose sign bit is set, NaNs included.
template <class D, class V>
HWY_INLINE hn::Mask<D> signs(D d, V v) {
#if HWY_TARGET == HWY_SCALAR
  const hn::RebindToSigned<D> integers;
  return hn::RebindMask(d, hn::Lt(hn::BitCast(integers, v), hn::Zero(integers)));
#else
  (void)d;
  return hn::MaskFromVec(v);  // on x86 no other bit is looked at
#endif
}

/// The same as bits, lane 0 first. For at most 16 lanes.
template <class D, class M>
HWY_INLINE unsigned bits(D d, M mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  return bytes[0] | static_cast<unsigned>(bytes[1]) << 8;
}

}  // namespace bqsa::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // BQSA_BATCH_SEGMENT_VECTORS_INL_H_
