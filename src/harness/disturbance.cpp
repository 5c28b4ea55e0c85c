#include "harness/disturbance.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bqsa::harness {
namespace {

/// std::seed_seq and std::mt19937_64 give the same numbers everywhere, unlike the distributions of
/// the standard library.
std::mt19937_64 generator_of(std::uint64_t seed, const std::string& problem) {
  std::vector<std::uint32_t> key = {static_cast<std::uint32_t>(seed),
                                    static_cast<std::uint32_t>(seed >> 32)};
  for (const char c : problem) key.push_back(static_cast<unsigned char>(c));
  std::seed_seq sequence(key.begin(), key.end());
  return std::mt19937_64(sequence);
}

}  // namespace

JointSensors::JointSensors(const Disturbance& disturbance, std::uint64_t seed,
                           const std::string& problem)
    : disturbance_(disturbance), generator_(generator_of(seed, problem)) {}

JointVector JointSensors::reading(const std::vector<JointVector>& executed) {
  const auto last = static_cast<int>(executed.size()) - 1;
  const JointVector& q =
      executed[static_cast<std::size_t>(std::max(last - disturbance_.latency_ticks, 0))];
  noise_.setZero(q.size());
  if (disturbance_.joint_noise > 0) {
    for (double& angle : noise_) angle = disturbance_.joint_noise * normal();
  }
  return q + noise_;
}

/// Box and Muller's transform of two even numbers, one in (0, 1], one in [0, 1).
double JointSensors::normal() {
  constexpr double kStep = 0x1p-53;
  const double radius = 1 - kStep * static_cast<double>(generator_() >> 11);
  const double turn = kStep * static_cast<double>(generator_() >> 11);
  return std::sqrt(-2 * std::log(radius)) * std::cos(2 * std::numbers::pi * turn);
}

std::string suffix_of(const Disturbance& disturbance, std::optional<std::uint64_t> seed) {
  std::string suffix;
  if (disturbance.joint_noise > 0) {
    suffix = fmt::format("+noise={}", disturbance.joint_noise);
    if (seed) suffix += fmt::format("+seed={}", *seed);
  }
  return disturbance.latency_ticks > 0 ? suffix + "+latency" : suffix;
}

}  // namespace bqsa::harness
