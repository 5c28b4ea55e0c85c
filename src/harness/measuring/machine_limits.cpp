#include "harness/measuring/machine_limits.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "harness/measuring/machine_limits.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace bqsa::harness {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Chains x <- x / 2 + 1 / 2. Twelve hide the latency of the slowest multiply-add of today (4 cycles, two a
/// cycle; where it takes two instructions, 8), and fit into the 16 registers of the smallest set.
template <typename T>
T multiply_adds(std::int64_t count) {
  const hn::ScalableTag<T> d;
  using V = hn::Vec<decltype(d)>;
  constexpr std::int64_t kChains = 12;
  volatile T opaque = T(0.5);  // or the compiler would find that all chains are one
  const auto some = [&opaque, d] { return hn::Set(d, opaque); };
  const V half = some();
  V a = some(), b = some(), c = some(), e = some(), f = some(), g = some();
  V h = some(), i = some(), j = some(), k = some(), l = some(), m = some();
  const auto a_round = kChains * static_cast<std::int64_t>(hn::Lanes(d));
  for (std::int64_t made = 0; made < count; made += a_round) {
    a = hn::MulAdd(a, half, half);
    b = hn::MulAdd(b, half, half);
    c = hn::MulAdd(c, half, half);
    e = hn::MulAdd(e, half, half);
    f = hn::MulAdd(f, half, half);
    g = hn::MulAdd(g, half, half);
    h = hn::MulAdd(h, half, half);
    i = hn::MulAdd(i, half, half);
    j = hn::MulAdd(j, half, half);
    k = hn::MulAdd(k, half, half);
    l = hn::MulAdd(l, half, half);
    m = hn::MulAdd(m, half, half);
  }
  const V sum = hn::Add(hn::Add(hn::Add(hn::Add(a, b), hn::Add(c, e)), hn::Add(hn::Add(f, g), h)),
                        hn::Add(hn::Add(i, j), hn::Add(hn::Add(k, l), m)));
  return hn::GetLane(hn::SumOfLanes(d, sum));
}

double multiply_adds_of_doubles(std::int64_t count) { return multiply_adds<double>(count); }
float multiply_adds_of_floats(std::int64_t count) { return multiply_adds<float>(count); }

double read_numbers(const double* HWY_RESTRICT values, std::size_t count) {
  const hn::ScalableTag<double> d;
  const std::size_t lanes = hn::Lanes(d);
  auto a = hn::Zero(d), b = a, c = a, e = a;
  for (std::size_t i = 0; i < count; i += 4 * lanes) {
    a = hn::Add(a, hn::Load(d, values + i));
    b = hn::Add(b, hn::Load(d, values + i + lanes));
    c = hn::Add(c, hn::Load(d, values + i + 2 * lanes));
    e = hn::Add(e, hn::Load(d, values + i + 3 * lanes));
  }
  return hn::GetLane(hn::SumOfLanes(d, hn::Add(hn::Add(a, b), hn::Add(c, e))));
}

}  // namespace HWY_NAMESPACE
}  // namespace bqsa::harness
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bqsa::harness {

HWY_EXPORT(multiply_adds_of_doubles);
HWY_EXPORT(multiply_adds_of_floats);
HWY_EXPORT(read_numbers);

double make_multiply_adds(std::int64_t count) {
  return HWY_DYNAMIC_DISPATCH(multiply_adds_of_doubles)(count);
}

float make_float_multiply_adds(std::int64_t count) {
  return HWY_DYNAMIC_DISPATCH(multiply_adds_of_floats)(count);
}

double read_all(const double* values, std::size_t count) {
  return HWY_DYNAMIC_DISPATCH(read_numbers)(values, count);
}

}  // namespace bqsa::harness
#endif
