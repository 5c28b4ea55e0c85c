/// @file
/// What stands between a reactive method and the arm: false and late readings of the joints.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "bqsa/method.hpp"

namespace bqsa::harness {

struct Disturbance {
  double joint_noise = 0;  ///< standard deviation of each joint's reading at each tick [rad]
  int latency_ticks = 0;   ///< age of a reading, 0 or 1

  bool on() const { return joint_noise > 0 || latency_ticks > 0; }
};

/// The joint sensors of a run, and the arm's servo loop that is closed over the same sensors.
///
/// At tick k the method is told r = q_(k-1-latency) + n_k (not before the start), with normal noise
/// n_k that is new for each joint and tick. Its answer is a set-point: the servos move the joints
/// until the sensors, still wrong by n_k, show it, that is to q_k = answer - n_k. Without latency
/// this is the same as executing the answer as a velocity command, q_k = q_(k-1) + (answer - r).
class JointSensors {
 public:
  /// The noise depends on the seed and the problem's name, not on the method.
  JointSensors(const Disturbance& disturbance, std::uint64_t seed, const std::string& problem);

  /// What the method is told at the tick that follows the last row; draws n_k.
  /// @param executed  rows from the start on
  JointVector reading(const std::vector<JointVector>& executed);

  /// Where the arm goes, of as many joints as were read last.
  JointVector executed(const JointVector& answer) const { return answer - noise_; }

 private:
  double normal();

  Disturbance disturbance_;
  std::mt19937_64 generator_;
  JointVector noise_;
};

/// What is added to the name of a variant: `+noise=0.001+seed=1+latency`; empty if nothing disturbs.
/// The seed is named with noise only, since nothing else depends on it, and if it is given.
std::string suffix_of(const Disturbance& disturbance, std::optional<std::uint64_t> seed);

}  // namespace bqsa::harness
