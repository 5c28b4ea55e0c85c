/// @file
/// A double that counts the multiplications and divisions done with it.
///
/// The counting rule: every `*` and `*=` of two scalars is one multiplication, products with a
/// constant included; sums, differences, negations and comparisons are free. Code that wants a
/// product with 2 for free writes it as a sum.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace bqsa::harness {

class CountingScalar {
 public:
  CountingScalar() = default;
  CountingScalar(double value) : value_(value) {}  // implicit, as Eigen expects of a scalar

  double value() const { return value_; }

  CountingScalar& operator+=(const CountingScalar& b) { return *this = *this + b; }
  CountingScalar& operator-=(const CountingScalar& b) { return *this = *this - b; }
  CountingScalar& operator*=(const CountingScalar& b) { return *this = *this * b; }

  friend CountingScalar operator+(const CountingScalar& a, const CountingScalar& b) {
    return a.value_ + b.value_;
  }
  friend CountingScalar operator-(const CountingScalar& a, const CountingScalar& b) {
    return a.value_ - b.value_;
  }
  friend CountingScalar operator-(const CountingScalar& a) { return -a.value_; }
  friend CountingScalar operator*(const CountingScalar& a, const CountingScalar& b) {
    ++multiplication_count;
    return a.value_ * b.value_;
  }
  friend CountingScalar operator/(const CountingScalar& a, const CountingScalar& b) {
    ++division_count;
    return a.value_ / b.value_;
  }
  friend auto operator<=>(const CountingScalar&, const CountingScalar&) = default;

  static std::uint64_t multiplications() { return multiplication_count; }
  static std::uint64_t divisions() { return division_count; }
  static void reset() { multiplication_count = division_count = 0; }

 private:
  double value_ = 0;
  inline static std::uint64_t multiplication_count = 0;
  inline static std::uint64_t division_count = 0;
};

}  // namespace bqsa::harness

/// @cond
template <>
struct Eigen::NumTraits<bqsa::harness::CountingScalar> : Eigen::NumTraits<double> {
  using Real = bqsa::harness::CountingScalar;
  using NonInteger = bqsa::harness::CountingScalar;
  using Nested = bqsa::harness::CountingScalar;
  using Literal = double;
  // NOLINTNEXTLINE(readability-identifier-naming): the name that Eigen asks for
  enum { RequireInitialization = 1 };
};
/// @endcond
