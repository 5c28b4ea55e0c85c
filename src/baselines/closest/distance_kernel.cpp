// The dual problem of segment_ellipsoid_distance.hpp for a vector of ellipsoids at a time. A file that
// is compiled for several instruction sets includes nothing whose inline functions others use too.
#include "baselines/closest/distance_kernel.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "baselines/closest/distance_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace bqsa::baselines::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kBlock = 8;  // EllipsoidBlocks::kBlock and kRows
constexpr int kRows = 19;
constexpr int kMaxSteps = 16;
constexpr double kEnough = 1e-12;  // error that may be left, of the largest semi-axis
constexpr double kProven = 1e-11;  // gap between the bounds, of the lengths in play
constexpr double kTiny = 1e-300;

using Tag = hn::CappedTag<double, kBlock>;
using Vec = hn::Vec<Tag>;
using Lanes = hn::Mask<Tag>;

struct Vec3 {
  Vec x, y, z;
};

HWY_INLINE Vec dot(const Vec3& a, const Vec3& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}

HWY_INLINE Vec3 times(const Vec3& a, const Vec3& b) {
  return {hn::Mul(a.x, b.x), hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)};
}

/// a + s b
HWY_INLINE Vec3 along(const Vec3& a, Vec s, const Vec3& b) {
  return {hn::MulAdd(s, b.x, a.x), hn::MulAdd(s, b.y, a.y), hn::MulAdd(s, b.z, a.z)};
}

HWY_INLINE Vec unit_clamp(Vec t) {
  const Tag d;
  return hn::Min(hn::Max(t, hn::Zero(d)), hn::Set(d, 1.0));
}

/// The ellipsoids of a vector, as they lie in a block.
struct Ellipsoids {
  Vec3 center;
  Vec3 axis_x, axis_y, axis_z;  // in W
  Vec3 squares, reciprocals;
  Vec largest;  // semi-axis
};

HWY_INLINE Vec3 load3(const double* row) {
  const Tag d;
  return {hn::LoadU(d, row), hn::LoadU(d, row + kBlock), hn::LoadU(d, row + 2 * kBlock)};
}

HWY_INLINE Ellipsoids load(const double* block) {
  constexpr int kVector = 3 * kBlock;
  return {load3(block),
          load3(block + kVector),
          load3(block + 2 * kVector),
          load3(block + 3 * kVector),
          load3(block + 4 * kVector),
          load3(block + 5 * kVector),
          hn::LoadU(Tag(), block + 6 * kVector)};
}

/// What belongs to one multiplier l, in the letters of the scalar routine.
struct DualPoint {
  Vec t;
  Lanes free;
  Vec3 x, m, n;     // point of the segment, normal W x, and A W x
  Vec secular;      // S
  Vec turn_whole;   // turn / whole: how t moves with l
  Vec half_slope;   // -S' / 2
};

HWY_INLINE DualPoint at(Vec l, const Vec3& w, const Vec3& p, const Vec3& d, const Vec3& squares) {
  const Tag tag;
  const Vec3 e = times(w, d);
  const Vec whole = hn::Max(dot(e, d), hn::Set(tag, kTiny));
  const Vec inverse = hn::Div(hn::Set(tag, 1.0), whole);
  const Vec unclamped = hn::Neg(hn::Mul(dot(e, p), inverse));
  DualPoint point;
  point.t = unit_clamp(unclamped);
  point.free = hn::Eq(point.t, unclamped);
  point.x = along(p, point.t, d);
  point.m = times(w, point.x);
  point.n = times(squares, point.m);
  const Vec3 nm = times(point.n, point.m);
  point.secular = hn::Add(nm.x, hn::Add(nm.y, nm.z));
  const Vec turn = hn::IfThenElseZero(point.free, dot(point.m, e));
  point.turn_whole = hn::Mul(turn, inverse);
  point.half_slope = hn::MulAdd(hn::Mul(l, turn), point.turn_whole, dot(nm, w));
  return point;
}

/// 1 / (squares + l), by one division.
HWY_INLINE Vec3 weights(Vec l, const Vec3& squares) {
  const Vec x = hn::Add(squares.x, l), y = hn::Add(squares.y, l), z = hn::Add(squares.z, l);
  const Vec xy = hn::Mul(x, y);
  const Vec inverse = hn::Div(hn::Set(Tag(), 1.0), hn::Mul(xy, z));
  const Vec z_inverse = hn::Mul(z, inverse);
  return {hn::Mul(y, z_inverse), hn::Mul(x, z_inverse), hn::Mul(xy, inverse)};
}

HWY_INLINE void solve(const DistancePass& pass, const Ellipsoids& shapes, int i, int first,
                      double* distance, double* t) {
  const Tag tag;
  const Vec one = hn::Set(tag, 1.0);
  const Vec zero = hn::Zero(tag);
  const PointArrays& a = *pass.starts;
  const PointArrays& b = *pass.ends;
  const Vec3 from = {hn::Sub(hn::Set(tag, a.x[i]), shapes.center.x),
                     hn::Sub(hn::Set(tag, a.y[i]), shapes.center.y),
                     hn::Sub(hn::Set(tag, a.z[i]), shapes.center.z)};
  const Vec3 by = {hn::Set(tag, b.x[i] - a.x[i]), hn::Set(tag, b.y[i] - a.y[i]),
                   hn::Set(tag, b.z[i] - a.z[i])};
  const Vec3 p = {dot(shapes.axis_x, from), dot(shapes.axis_y, from), dot(shapes.axis_z, from)};
  const Vec3 d = {dot(shapes.axis_x, by), dot(shapes.axis_y, by), dot(shapes.axis_z, by)};
  const Vec3& squares = shapes.squares;

  const DualPoint deepest = at(zero, shapes.reciprocals, p, d, squares);
  const Lanes meet = hn::Le(deepest.secular, one);

  const Vec3 ax = times(squares, times(deepest.x, deepest.x));
  const Vec norm = hn::Sqrt(hn::Add(ax.x, hn::Add(ax.y, ax.z)));
  Vec l = hn::Max(hn::NegMulAdd(shapes.largest, shapes.largest, norm), zero);
#ifdef START
  START
#endif
  DualPoint point;
  Vec root, step, squared_length;
  Lanes done;
  for (int k = 0;; ++k) {
#ifdef COUNT
    COUNT
#endif
    point = at(l, weights(l, squares), p, d, squares);
    root = hn::Sqrt(point.secular);
    step = hn::Div(hn::Mul(hn::Sub(root, one), point.secular), point.half_slope);
    squared_length = dot(point.m, point.m);
    const Vec newton = hn::Max(hn::Add(l, step), hn::Mul(l, hn::Set(tag, 0.125)));
    // The error is about step² / (l + a_min²), and moves the surface by that times |m|.
    const Vec bound =
        hn::Mul(hn::Mul(hn::Set(tag, kEnough), shapes.largest),
                hn::Add(newton, hn::Min(squares.x, hn::Min(squares.y, squares.z))));
    const Vec squared = hn::Mul(step, step);
    done = hn::Or(meet, hn::Le(hn::Mul(hn::Mul(squared, squared), squared_length),
                               hn::Mul(bound, bound)));
    if (hn::AllTrue(tag, done) || k == kMaxSteps) break;
    l = newton;
  }

  // The plane across m has the segment and the ellipsoid on its two sides.
  const Vec length = hn::Sqrt(squared_length);
  const Vec slip = dot(point.m, d);
  const Vec before = hn::Neg(hn::Mul(point.t, slip));
  const Vec beyond = hn::NegMulAdd(point.t, slip, slip);
  const Vec least = hn::Add(dot(point.m, point.x), hn::Min(before, beyond));
  const Vec low = hn::Div(hn::Sub(least, root), length);
  const Vec inverse_root = hn::Div(one, root);
  const Vec3 apart = {hn::NegMulAdd(point.n.x, inverse_root, point.x.x),
                      hn::NegMulAdd(point.n.y, inverse_root, point.x.y),
                      hn::NegMulAdd(point.n.z, inverse_root, point.x.z)};
  const Vec high = hn::Sqrt(dot(apart, apart));
  const Lanes proven = hn::Or(meet, hn::Le(hn::Sub(high, low), hn::Mul(hn::Set(tag, kProven), hn::Add(high, shapes.largest))));
  hn::StoreU(hn::IfThenZeroElse(meet, hn::Max(high, hn::Set(tag, kTiny))), tag, distance);
  hn::StoreU(hn::IfThenElse(meet, deepest.t, unit_clamp(hn::MulAdd(point.turn_whole, step, point.t))), tag, t);
  if (!hn::AllTrue(tag, proven)) {
    uint8_t bits[8] = {};
    hn::StoreMaskBits(tag, hn::Not(proven), bits);
    pass.redo(pass.context, i, first, bits[0]);
  }
}

void distance_pass(const DistancePass& pass) {
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag()));
  const int segments = pass.starts->count;
  for (int block = 0; block < pass.blocks; ++block) {
    for (int lane = 0; lane < kBlock; lane += kLanes) {
      const Ellipsoids shapes = load(pass.ellipsoids + block * kRows * kBlock + lane);
      for (int i = 0; i < segments; ++i) {
        const int at_pair = (block * segments + i) * kBlock + lane;
        solve(pass, shapes, i, block * kBlock + lane, pass.distance + at_pair, pass.t + at_pair);
      }
    }
  }
}

}  // namespace bqsa::baselines::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bqsa::baselines {

HWY_EXPORT(distance_pass);

void run_distance_pass(const DistancePass& pass) { HWY_DYNAMIC_DISPATCH(distance_pass)(pass); }

}  // namespace bqsa::baselines
#endif
