#include "bqsa/kinematics/sine_cosine.hpp"

#include <cmath>

// This file is compiled once for each instruction set; between HWY_BEFORE_NAMESPACE and
// HWY_AFTER_NAMESPACE are only plain numbers and Highway's own types.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bqsa/kinematics/sine_cosine.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace bqsa::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Products and sums are never fused (the file is compiled with -ffp-contract=off), so that all
// instruction sets round alike.
using Tag = hn::CappedTag<double, 8>;
using V = hn::Vec<Tag>;
constexpr Tag kTag;

V constant(double value) { return hn::Set(kTag, value); }

/// c0 + c1 z + ... + c5 z^5 (Estrin).
V polynomial(V z, V z2, double c0, double c1, double c2, double c3, double c4, double c5) {
  const V low = constant(c0) + z * constant(c1);
  const V middle = constant(c2) + z * constant(c3);
  const V high = constant(c4) + z * constant(c5);
  return low + z2 * (middle + z2 * high);
}

/// Lane by lane, zero where i + lane >= count. Not by a masked load: without masks in hardware it needs
/// aligned numbers.
V load(const double* numbers, int i, int count) {
  return hn::IfThenElseZero(hn::FirstN(kTag, static_cast<std::size_t>(count - i)),
                            hn::LoadU(kTag, numbers + i));
}

/// False, and nothing said about what is stored, if an angle is larger than 1e5 or no number.
bool sine_cosine(const double* q, const double* offset, int count, double* sine, double* cosine) {
  // k below has at most 16 bits, and its products with the 33-bit parts of pi/2 are exact.
  constexpr double kLargest = 1e5;
  constexpr double kHalfPi1 = 1.57079632673412561417e+00;
  constexpr double kHalfPi2 = 6.07710050630396597660e-11;
  constexpr double kHalfPi3 = 2.02226624879595063154e-21;
  constexpr double kTwoOverPi = 6.36619772367581382433e-01;
  constexpr double kRounder = 0x1.8p52;  // adding it rounds to a whole number, in the low bits

  const hn::RebindToUnsigned<Tag> bits;
  const auto one = hn::Set(bits, 1);
  const auto two = hn::Set(bits, 2);
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(kTag))) {
    const V x = load(q, i, count) + load(offset, i, count);
    if (!hn::AllTrue(kTag, hn::Abs(x) <= constant(kLargest))) return false;
    const V rounded = x * constant(kTwoOverPi) + constant(kRounder);
    const V k = rounded - constant(kRounder);
    const V r = ((x - k * constant(kHalfPi1)) - k * constant(kHalfPi2)) - k * constant(kHalfPi3);

    // fdlibm's k_sin.c and k_cos.c
    const V z = r * r;
    const V z2 = z * z;
    const V s = r + r * z *
                        polynomial(z, z2, -1.66666666666666324348e-01, 8.33333333332248946124e-03,
                                   -1.98412698298579493134e-04, 2.75573137070700676789e-06,
                                   -2.50507602534068634195e-08, 1.58969099521155010221e-10);
    const V half = constant(0.5) * z;
    const V near_one = constant(1) - half;
    const V c =
        near_one + (((constant(1) - near_one) - half) +
                    z2 * polynomial(z, z2, 4.16666666666666019037e-02, -1.38888888888741095749e-03,
                                    2.48015872894767294178e-05, -2.75573143513906633035e-07,
                                    2.08757232129817482790e-09, -1.13596475577881948265e-11));

    // In odd quadrants the two change places; then bit 1 of the quadrant is the sign.
    const auto quadrant = hn::BitCast(bits, rounded);
    const auto even = hn::RebindMask(kTag, (quadrant & one) == hn::Zero(bits));
    const auto sign_of_sine = hn::ShiftLeft<62>(quadrant & two);
    const auto sign_of_cosine = hn::ShiftLeft<62>((quadrant + one) & two);
    hn::StoreU(hn::IfThenElse(even, s, c) ^ hn::BitCast(kTag, sign_of_sine), kTag, sine + i);
    hn::StoreU(hn::IfThenElse(even, c, s) ^ hn::BitCast(kTag, sign_of_cosine), kTag, cosine + i);
  }
  return true;
}

bool turn_slightly(const double* q_from, const double* q_to, int count, double largest,
                   double* sine, double* cosine) {
  const int lanes = static_cast<int>(hn::Lanes(kTag));
  for (int i = 0; i < count; i += lanes) {
    const V d = load(q_to, i, count) - load(q_from, i, count);
    if (!hn::AllTrue(kTag, hn::Abs(d) <= constant(largest))) return false;
  }
  for (int i = 0; i < count; i += lanes) {
    // sin d and 1 - cos d by their series; what they leave out is below 1e-17.
    const V d = load(q_to, i, count) - load(q_from, i, count);
    const V z = d * d;
    const V z2 = z * z;
    const V sin_d =
        d - d * z * (constant(1.0 / 6) - z * constant(1.0 / 120) + z2 * constant(1.0 / 5040));
    const V less = z * (constant(0.5) - z * constant(1.0 / 24) +
                        z2 * (constant(1.0 / 720) - z * constant(1.0 / 40320)));
    const V s = hn::LoadU(kTag, sine + i);
    const V c = hn::LoadU(kTag, cosine + i);
    hn::StoreU(s + (c * sin_d - s * less), kTag, sine + i);
    hn::StoreU(c - (s * sin_d + c * less), kTag, cosine + i);
  }
  return true;
}

}  // namespace bqsa::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bqsa {
namespace {

HWY_EXPORT(sine_cosine);
HWY_EXPORT(turn_slightly);

}  // namespace

void sine_cosine(const double* q, const Angles& offset, int count, Angles& sine, Angles& cosine) {
  if (HWY_DYNAMIC_DISPATCH(sine_cosine)(q, offset.data(), count, sine.data(), cosine.data()))
    return;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    sine[i] = std::sin(q[i] + offset[i]);
    cosine[i] = std::cos(q[i] + offset[i]);
  }
}

bool turn_slightly(const double* q_from, const double* q_to, int count, Angles& sine,
                   Angles& cosine) {
  return HWY_DYNAMIC_DISPATCH(turn_slightly)(q_from, q_to, count, kSlightTurn, sine.data(),
                                             cosine.data());
}

}  // namespace bqsa
#endif  // HWY_ONCE
