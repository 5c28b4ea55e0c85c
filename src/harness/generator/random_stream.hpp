/// @file
/// Random numbers that are the same on every machine.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <numbers>

namespace bqsa::harness {

/// A stream of random numbers: SplitMix64 (Steele, Lea, Flood: Fast splittable pseudorandom number
/// generators, OOPSLA 2014) with transforms of its own, since those of the standard library differ
/// from one library to the next.
class RandomStream {
 public:
  /// Streams of different keys have nothing in common; those of equal keys are equal. A single key
  /// is the published generator's seed.
  RandomStream(std::initializer_list<std::uint64_t> keys) {
    for (const std::uint64_t key : keys) state_ = mixed(state_) ^ key;
  }

  /// All 64 bits.
  std::uint64_t bits() { return mixed(state_ += kGamma); }

  /// In [low, high), a multiple of (high - low) 2⁻⁵³ above low.
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(bits() >> 11U) * 0x1p-53);
  }

  /// In [low, high), with a uniform logarithm.
  double log_uniform(double low, double high) {
    return low * std::exp(uniform(0, std::log(high / low)));
  }

  /// A whole number from low to high, both included.
  int whole(int low, int high) {
    return low + static_cast<int>(std::floor(uniform(0, high - low + 1)));
  }

  bool chance(double probability) { return uniform(0, 1) < probability; }

  /// Uniform on the unit sphere, or for dimension 2 on the unit circle in the plane z = 0.
  Eigen::Vector3d direction(int dimension) {
    const double z = dimension == 2 ? 0 : uniform(-1, 1);
    const double angle = uniform(-std::numbers::pi, std::numbers::pi);
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }

  /// A quaternion (w, x, y, z) of a uniform rotation (Shoemake: Uniform random rotations, 1992).
  Eigen::Vector4d quaternion() {
    const double part = uniform(0, 1);
    const double a = uniform(-std::numbers::pi, std::numbers::pi);
    const double b = uniform(-std::numbers::pi, std::numbers::pi);
    const double r = std::sqrt(1 - part);
    const double s = std::sqrt(part);
    return {s * std::cos(b), r * std::sin(a), r * std::cos(a), s * std::sin(b)};
  }

 private:
  static constexpr std::uint64_t kGamma = 0x9e3779b97f4a7c15;

  static constexpr std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111eb;
    return z ^ (z >> 31U);
  }

  std::uint64_t state_ = 0;
};

}  // namespace bqsa::harness
