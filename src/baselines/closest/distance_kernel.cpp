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

constexpr int kMaxSteps = 16;
constexpr double kEnough = 3e-6;   // step that may be left, of l + a_min²: errors are its square
constexpr double kProven = 1e-10;  // gap between the bounds, of the lengths in play
constexpr double kSmallest = 1e-300;  // distance of what does not meet [m]

using Tag = hn::CappedTag<double, kEllipsoidBlock>;
using Vec = hn::Vec<Tag>;
using Lanes = hn::Mask<Tag>;

struct Vec3 {
  Vec x, y, z;
};

HWY_INLINE Vec dot(const Vec3& a, const Vec3& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}

/// Coordinate by coordinate.
HWY_INLINE Vec3 times(const Vec3& a, const Vec3& b) {
  return {hn::Mul(a.x, b.x), hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)};
}

HWY_INLINE Vec3 scaled(const Vec3& a, Vec s) {
  return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
}

/// a + s b
HWY_INLINE Vec3 along(const Vec3& a, Vec s, const Vec3& b) {
  return {hn::MulAdd(s, b.x, a.x), hn::MulAdd(s, b.y, a.y), hn::MulAdd(s, b.z, a.z)};
}

HWY_INLINE Vec unit_clamp(Vec t) {
  return hn::Min(hn::Max(t, hn::Zero(Tag())), hn::Set(Tag(), 1.0));
}

/// A segment p + t d against a vector of ellipsoids, each in its axes.
struct Pairs {
  Vec3 p, d;
  Vec3 squares;  // a²
  Vec largest;   // semi-axis
  Vec without;   // 1 for a segment without length, which makes divisors of 0, else 0
  Vec deepest;   // t of the deepest point
  Lanes meet;
};

/// What belongs to one multiplier l, in the letters of the scalar routine, but free of divisions: the
/// weights w are multiplied by det = (a_1² + l) (a_2² + l) (a_3² + l), points of the segment by `whole`.
struct DualPoint {
  Vec whole;       // dᵀ w d; of det
  Vec t;           // of whole
  Vec3 x, m, n;    // the point at t, w x, and A w x; of whole, m and n of det too
  Vec secular;     // S; of scale²
  Vec scale;       // det whole
  Vec turn;        // mᵀ w d, 0 where t is at an end; of det scale
  Vec half_slope;  // -S' / 2; of det whole scale²
};

/// How far the search has come.
struct Search {
  Vec l;
  DualPoint point;
  Vec root;  // of point.secular
  Vec step;  // that Newton's method takes from l
  bool enough;
};

HWY_INLINE Vec3 load(const double* row) {
  constexpr std::ptrdiff_t kNext = kEllipsoidBlock;
  return {hn::LoadU(Tag(), row), hn::LoadU(Tag(), row + kNext), hn::LoadU(Tag(), row + 2 * kNext)};
}

/// Decides whether they meet, and starts the search at the l of the deepest point, were its nearest point
/// on the ellipsoid on the way to the centre: true of spheres.
HWY_INLINE void start(const DistancePass& pass, int segment, const double* ellipsoids, Pairs& pairs,
                      Search& search) {
  const Tag tag;
  constexpr std::ptrdiff_t kThreeRows = 3 * kEllipsoidBlock;
  const Vec3 center = load(ellipsoids);
  const Vec3 axis_x = load(ellipsoids + kThreeRows);
  const Vec3 axis_y = load(ellipsoids + 2 * kThreeRows);
  const Vec3 axis_z = load(ellipsoids + 3 * kThreeRows);
  pairs.squares = load(ellipsoids + 4 * kThreeRows);
  const Vec3 reciprocals = load(ellipsoids + 5 * kThreeRows);
  pairs.largest = hn::LoadU(tag, ellipsoids + 6 * kThreeRows);

  const PointArrays& a = *pass.starts;
  const PointArrays& b = *pass.ends;
  const double x = b.x[segment] - a.x[segment];
  const double y = b.y[segment] - a.y[segment];
  const double z = b.z[segment] - a.z[segment];
  const Vec3 from = {hn::Sub(hn::Set(tag, a.x[segment]), center.x),
                     hn::Sub(hn::Set(tag, a.y[segment]), center.y),
                     hn::Sub(hn::Set(tag, a.z[segment]), center.z)};
  const Vec3 by = {hn::Set(tag, x), hn::Set(tag, y), hn::Set(tag, z)};
  pairs.p = {dot(axis_x, from), dot(axis_y, from), dot(axis_z, from)};
  pairs.d = {dot(axis_x, by), dot(axis_y, by), dot(axis_z, by)};
  pairs.without = hn::Set(tag, x == 0 && y == 0 && z == 0 ? 1.0 : 0.0);

  const Vec3 e = times(reciprocals, pairs.d);
  const Vec whole = hn::Add(dot(e, pairs.d), pairs.without);
  pairs.deepest = unit_clamp(hn::Neg(hn::Div(dot(e, pairs.p), whole)));
  const Vec3 point = along(pairs.p, pairs.deepest, pairs.d);
  const Vec3 m = times(reciprocals, point);
  const Vec secular = dot(m, point);
  const Vec one = hn::Set(tag, 1.0);
  pairs.meet = hn::Le(secular, one);
  search.enough = false;
  search.l =
      hn::Mul(hn::Sub(hn::Sqrt(secular), one), hn::Sqrt(hn::Div(dot(point, point), dot(m, m))));
}

HWY_INLINE DualPoint at(Vec l, const Pairs& pairs) {
  const Vec x = hn::Add(pairs.squares.x, l);
  const Vec y = hn::Add(pairs.squares.y, l);
  const Vec z = hn::Add(pairs.squares.z, l);
  const Vec3 w = {hn::Mul(y, z), hn::Mul(x, z), hn::Mul(x, y)};
  const Vec3 e = times(w, pairs.d);
  DualPoint point;
  point.whole = hn::Add(dot(e, pairs.d), pairs.without);
  const Vec unclamped = hn::Neg(dot(e, pairs.p));
  point.t = hn::Min(hn::Max(unclamped, hn::Zero(Tag())), point.whole);
  point.x = along(scaled(pairs.p, point.whole), point.t, pairs.d);
  point.m = times(w, point.x);
  point.n = times(pairs.squares, point.m);
  const Vec3 parts = times(point.n, point.m);
  point.secular = hn::Add(parts.x, hn::Add(parts.y, parts.z));
  point.scale = hn::Mul(point.whole, hn::Mul(x, w.x));
  point.turn = hn::IfThenElseZero(hn::Eq(point.t, unclamped), dot(point.m, e));
  const Vec of_free_t = hn::Mul(hn::Mul(l, point.turn), point.turn);
  point.half_slope = hn::MulAdd(point.whole, dot(parts, w), of_free_t);
  return point;
}

/// A step of Newton's method on S^(-1/2): S (sqrt(S) - 1) / (-S' / 2), in which the scales cancel.
HWY_INLINE void look(const Pairs& pairs, Search& search) {
  const Tag tag;
  search.point = at(search.l, pairs);
  const DualPoint& point = search.point;
  search.root = hn::Sqrt(point.secular);
  const Vec excess = hn::Sub(search.root, point.scale);
  search.step = hn::Div(hn::Mul(excess, point.secular), point.half_slope);
  const Vec thinnest = hn::Min(pairs.squares.x, hn::Min(pairs.squares.y, pairs.squares.z));
  const Vec small = hn::Mul(hn::Set(tag, kEnough), hn::Add(search.l, thinnest));
  search.enough = hn::AllTrue(tag, hn::Or(pairs.meet, hn::Le(hn::Abs(search.step), small)));
}

HWY_INLINE void go_on(Search& search) {
  const Vec least = hn::Mul(search.l, hn::Set(Tag(), 0.125));
  search.l = hn::Max(hn::Add(search.l, search.step), least);
}

/// The distance of x to the surface point A m / |A^(1/2) m| is too large, by the square of the last step.
/// The plane across m, which has the segment and the ellipsoid on its two sides, proves it. t moves along
/// with the last step.
/// @return the lanes in which it is proven
HWY_INLINE Lanes answer(const Pairs& pairs, const Search& search, double* distance, double* t) {
  const Tag tag;
  const DualPoint& point = search.point;
  const Vec inverse = hn::Div(hn::Set(tag, 1.0), hn::Mul(point.whole, search.root));
  const Vec inverse_whole = hn::Mul(inverse, search.root);
  const Vec inverse_root = hn::Mul(inverse, point.whole);
  const Vec3 x = scaled(point.x, inverse_whole);
  const Vec3 apart = along(x, hn::Neg(inverse_root), point.n);
  const Vec high = hn::Sqrt(dot(apart, apart));
  const Vec here = hn::Mul(point.t, inverse_whole);
  const Vec moved = hn::Mul(hn::Mul(point.turn, search.step), hn::Mul(inverse_whole, inverse_root));
  hn::StoreU(hn::IfThenZeroElse(pairs.meet, hn::Max(high, hn::Set(tag, kSmallest))), tag, distance);
  hn::StoreU(hn::IfThenElse(pairs.meet, pairs.deepest, unit_clamp(hn::Add(here, moved))), tag, t);

  const Vec slope = dot(point.m, pairs.d);  // 0 but for rounding where t is free
  const Vec to_start = hn::Neg(hn::Mul(here, slope));
  const Vec to_end = hn::NegMulAdd(here, slope, slope);
  const Vec least = hn::Add(dot(point.m, x), hn::Min(to_start, to_end));
  const Vec gap = hn::Sub(least, search.root);  // of |m|
  const Vec length = hn::Sqrt(dot(point.m, point.m));
  const Vec allowed = hn::Mul(hn::Set(tag, kProven), hn::Add(high, pairs.largest));
  return hn::Or(pairs.meet, hn::Le(hn::Mul(hn::Sub(high, allowed), length), gap));
}

constexpr auto kLanes = static_cast<std::ptrdiff_t>(hn::MaxLanes(Tag()));

/// Which segment is asked against which vector of ellipsoids. Their order is that of the answers, but
/// for vectors shorter than a block.
struct Place {
  int segment;
  std::ptrdiff_t block;
  std::ptrdiff_t lane;

  HWY_INLINE int first() const { return static_cast<int>(block * kEllipsoidBlock + lane); }

  HWY_INLINE void go_on(int segments) {
    if ((lane += kLanes) < kEllipsoidBlock) return;
    lane = 0;
    if (++segment < segments) return;
    segment = 0;
    ++block;
  }
};

/// So many searches side by side: each alone would wait for its own results most of the time.
template <int Together>
HWY_INLINE void solve(const DistancePass& pass, Place& next) {
  const Tag tag;
  Place places[Together];
  Pairs pairs[Together];
  Search searches[Together];
  for (int k = 0; k < Together; ++k) {
    places[k] = next;
    next.go_on(pass.starts->count);
    const double* const block =
        pass.ellipsoids + places[k].block * kEllipsoidRows * kEllipsoidBlock;
    start(pass, places[k].segment, block + places[k].lane, pairs[k], searches[k]);
  }
  for (int step = 0;; ++step) {
    bool enough = true;
    for (int k = 0; k < Together; ++k) {
      if (searches[k].enough) continue;
      look(pairs[k], searches[k]);
      enough = enough && searches[k].enough;
    }
    if (enough || step == kMaxSteps) break;
    for (int k = 0; k < Together; ++k) {
      if (!searches[k].enough) go_on(searches[k]);
    }
  }
  for (int k = 0; k < Together; ++k) {
    const Place& place = places[k];
    const std::ptrdiff_t at_pair =
        (place.block * pass.starts->count + place.segment) * kEllipsoidBlock + place.lane;
    const Lanes proven = answer(pairs[k], searches[k], pass.distance + at_pair, pass.t + at_pair);
    if (hn::AllTrue(tag, proven)) continue;
    uint8_t bits[8] = {};
    hn::StoreMaskBits(tag, hn::Not(proven), bits);
    pass.redo(pass.context, place.segment, place.first(), bits[0]);
  }
}

void distance_pass(const DistancePass& pass) {
  constexpr int kTogether = 4;
  std::ptrdiff_t left = kEllipsoidBlock / kLanes * pass.blocks * pass.starts->count;
  Place next = {0, 0, 0};
  for (; left >= kTogether; left -= kTogether) solve<kTogether>(pass, next);
  for (; left > 0; --left) solve<1>(pass, next);
}

}  // namespace bqsa::baselines::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bqsa::baselines {

HWY_EXPORT(distance_pass);

void run_distance_pass(const DistancePass& pass) { HWY_DYNAMIC_DISPATCH(distance_pass)(pass); }

}  // namespace bqsa::baselines
#endif
