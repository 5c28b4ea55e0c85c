// Compiled once for each instruction set; dispatched once a pass.

#include "bqsa/batch/arm_kernels.hpp"

#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bqsa/batch/arm_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <hwy/contrib/math/math-inl.h>

#include "bqsa/batch/segment_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bqsa::batch::HWY_NAMESPACE {
namespace {

constexpr std::ptrdiff_t kBlock = 16;

using Floats = hn::CappedTag<float, kBlock>;
using V = hn::Vec<Floats>;

/// End-points of all links of positive length, of as many configurations as a vector holds.
template <int Dim>
class EndPoints {
 public:
  void clear() { count_ = 0; }
  int count() const { return count_; }

  void add(const V (&p)[Dim]) {
    const Floats d;
    for (int k = 0; k < Dim; ++k) hn::Store(p[k], d, numbers_[count_][k]);
    ++count_;
  }

  V coordinate(int point, int axis) const { return hn::Load(Floats(), numbers_[point][axis]); }

 private:
  HWY_ALIGN float numbers_[Arm::kMaxJoints + 2][Dim][kBlock];
  int count_ = 0;
};

/// angles[16 j]: joint j of the vector's first configuration.
HWY_INLINE void forward(const Arm& arm, const float* angles, EndPoints<2>& points) {
  const Floats d;
  V x[2] = {hn::Set(d, arm.base[0][0]), hn::Set(d, arm.base[0][1])};
  V p[2] = {hn::Zero(d), hn::Zero(d)};
  points.clear();
  points.add(p);
  for (int j = 0; j < arm.joints; ++j) {
    const Arm::Row& row = arm.rows[j];
    const V a = hn::Set(d, row.a);
    if (arm.modified) {
      for (int k = 0; k < 2; ++k) p[k] = hn::MulAdd(a, x[k], p[k]);
    }
    const V angle = hn::Add(hn::LoadU(d, angles + kBlock * j), hn::Set(d, row.offset));
    const V c = hn::Cos(d, angle);
    const V s = hn::Sin(d, angle);
    const V x0 = hn::NegMulAdd(s, x[1], hn::Mul(c, x[0]));
    x[1] = hn::MulAdd(s, x[0], hn::Mul(c, x[1]));
    x[0] = x0;
    if (!arm.modified) {
      for (int k = 0; k < 2; ++k) p[k] = hn::MulAdd(a, x[k], p[k]);
    }
    if (row.ends_link) points.add(p);
  }
  if (arm.has_tool) {
    const V along = hn::Set(d, arm.tool[0]), across = hn::Set(d, arm.tool[1]);
    const V tip[2] = {hn::NegMulAdd(across, x[1], hn::MulAdd(along, x[0], p[0])),
                      hn::MulAdd(across, x[0], hn::MulAdd(along, x[1], p[1]))};
    points.add(tip);
  }
}

HWY_INLINE void forward(const Arm& arm, const float* angles, EndPoints<3>& points) {
  const Floats d;
  V x[3], y[3], z[3], p[3];
  for (int k = 0; k < 3; ++k) {
    x[k] = hn::Set(d, arm.base[0][k]);
    y[k] = hn::Set(d, arm.base[1][k]);
    z[k] = hn::Set(d, arm.base[2][k]);
    p[k] = hn::Zero(d);
  }
  points.clear();
  points.add(p);
  for (int j = 0; j < arm.joints; ++j) {
    const Arm::Row& row = arm.rows[j];
    const V ca = hn::Set(d, row.cos_alpha), sa = hn::Set(d, row.sin_alpha);
    const V along_x = hn::Set(d, row.a), along_z = hn::Set(d, row.d);
    const V angle = hn::Add(hn::LoadU(d, angles + kBlock * j), hn::Set(d, row.offset));
    const V c = hn::Cos(d, angle);
    const V s = hn::Sin(d, angle);
    for (int k = 0; k < 3; ++k) {
      if (arm.modified) {
        const V y1 = hn::MulAdd(sa, z[k], hn::Mul(ca, y[k]));
        z[k] = hn::NegMulAdd(sa, y[k], hn::Mul(ca, z[k]));
        p[k] = hn::MulAdd(along_z, z[k], hn::MulAdd(along_x, x[k], p[k]));
        y[k] = hn::NegMulAdd(s, x[k], hn::Mul(c, y1));
        x[k] = hn::MulAdd(s, y1, hn::Mul(c, x[k]));
      } else {
        const V x1 = hn::MulAdd(s, y[k], hn::Mul(c, x[k]));
        const V y1 = hn::NegMulAdd(s, x[k], hn::Mul(c, y[k]));
        p[k] = hn::MulAdd(along_x, x1, hn::MulAdd(along_z, z[k], p[k]));
        x[k] = x1;
        y[k] = hn::MulAdd(sa, z[k], hn::Mul(ca, y1));
        z[k] = hn::NegMulAdd(sa, y1, hn::Mul(ca, z[k]));
      }
    }
    if (row.ends_link) points.add(p);
  }
  if (arm.has_tool) {
    const V t0 = hn::Set(d, arm.tool[0]), t1 = hn::Set(d, arm.tool[1]);
    const V t2 = hn::Set(d, arm.tool[2]);
    for (int k = 0; k < 3; ++k) {
      p[k] = hn::MulAdd(t2, z[k], hn::MulAdd(t1, y[k], hn::MulAdd(t0, x[k], p[k])));
    }
    points.add(p);
  }
}

/// Sign bits are set where all angles are numbers of no more than the largest.
HWY_INLINE V in_range(const Arm& arm, const float* angles) {
  const Floats d;
  const V largest = hn::Set(d, arm.largest_angle);
  auto within = hn::Le(hn::Zero(d), largest);
  for (int j = 0; j < arm.joints; ++j) {
    within = hn::And(within, hn::Le(hn::Abs(hn::LoadU(d, angles + kBlock * j)), largest));
  }
  return hn::IfThenElseZero(within, hn::Set(d, -1.0F));
}

/// Sign bits stay set where all links are free.
template <int Dim>
HWY_INLINE V free_of_all(const ArmPass& pass, const EndPoints<Dim>& points, V free) {
  const Floats d;
  const V one = hn::Set(d, 1.0F);
  constexpr int kRows = Dim == 2 ? 5 : 9;
  for (int j = 0; j < pass.obstacles; ++j) {
    const float* coefficients = pass.coefficients + j / kBlock * kBlock * kRows + j % kBlock;
    const auto map =
        unit_map<Dim, V>([&](int row) { return hn::Set(d, coefficients[row * kBlock]); });
    const auto mapped = [&](int point) {
      return unit_point(
          map, [&](int axis) { return points.coordinate(point, axis); }, one);
    };
    auto u = mapped(0);
    int link = 0;
    for (; link + 2 < points.count(); link += 2) {  // by two, so that nothing need be moved
      const auto v = mapped(link + 1);
      free = hn::And(free, free_sign(u, v, one));
      u = mapped(link + 2);
      free = hn::And(free, free_sign(v, u, one));
    }
    if (link + 1 < points.count()) free = hn::And(free, free_sign(u, mapped(link + 1), one));
    if (hn::AllFalse(d, signs(d, free))) break;
  }
  return free;
}

template <int Dim>
void free_masks(const ArmPass& pass, std::uint16_t* free) {
  const Floats d;
  const auto lanes = static_cast<std::ptrdiff_t>(hn::Lanes(d));
  EndPoints<Dim> points;
  for (int block = 0; block < pass.blocks; ++block) {
    const float* angles = pass.angles + block * kBlock * pass.arm->joints;
    unsigned mask = 0;
    for (std::ptrdiff_t first = 0; first < kBlock; first += lanes) {
      forward(*pass.arm, angles + first, points);
      const V all = free_of_all(pass, points, in_range(*pass.arm, angles + first));
      mask |= bits(d, signs(d, all)) << first;
    }
    free[block] = static_cast<std::uint16_t>(mask);
  }
}

void free_masks_in_plane(const ArmPass& pass, std::uint16_t* free) { free_masks<2>(pass, free); }
void free_masks_in_space(const ArmPass& pass, std::uint16_t* free) { free_masks<3>(pass, free); }

}  // namespace
}  // namespace bqsa::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bqsa::batch {

HWY_EXPORT(free_masks_in_plane);
HWY_EXPORT(free_masks_in_space);

void free_masks_plane(const ArmPass& pass, std::uint16_t* free) {
  HWY_DYNAMIC_DISPATCH(free_masks_in_plane)(pass, free);
}
void free_masks_space(const ArmPass& pass, std::uint16_t* free) {
  HWY_DYNAMIC_DISPATCH(free_masks_in_space)(pass, free);
}

}  // namespace bqsa::batch
#endif
