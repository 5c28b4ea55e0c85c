/// @file
/// Times of everything that tells whether links hit obstacles, beside what the machine can do at most: the sweep
/// `speed_pairs`. All are of 448 pairs, 7 links and 64 obstacles in space, in the cache but where a name says `far`.
#pragma once

#include <string_view>

#include "harness/measuring/contest.hpp"
#include "harness/measuring/miss_rate.hpp"
#include "harness/measuring/sweep.hpp"

namespace bqsa::harness {

inline constexpr std::string_view kSpeedOfPairs = "speed_pairs";

/// Multiply-adds of the polar form of a pair in space, end-points shared between links: what the peak is
/// taken for.
inline constexpr int kMultiplyAddsOfPair = 14;

/// Links and obstacles of the sweep.
inline constexpr WorkloadSize kSpeedSize{.dimension = 3, .links = 7, .obstacles = 64};

/// Obstacles of those series that are out of any cache.
inline constexpr int kFarObstacles = 1 << 21;

/// Series:
/// - `multiply_adds`, `multiply_adds_float`: as many as the pairs have, at the machine's peak; `read_far`: as many
///   bytes as the obstacles of `batch_far` have;
/// - `batch`, `batch_float`, `batch_far`, `batch_float_far`: the batched test, answers as masks;
/// - `single_call`: the polar form, every pair by a call of its own;
/// - `configurations`: one of 1024 configurations of an arm of 7 links, from its joint angles, in float;
/// - `test_points_12`, `test_points_safe`: vectorised, NM = 12 and that of safe_test_points();
/// - other detectors by their names.
/// @param sweep  named, empty
/// @throws std::runtime_error if answers are wrong
void measure_speed_of_pairs(const ContestSettings& settings, int verified_pairs, Sweep& sweep);

/// N and M of the smallest product, in steps of 100, at which test points miss at most 3 % of the first
/// contacts (miss_rate.hpp), the hits that are easiest for them; and what they miss. Always the same.
MissRate safe_test_points();

}  // namespace bqsa::harness
