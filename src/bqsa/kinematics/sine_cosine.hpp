/// @file
/// Sines and cosines of all joint angles at once, by the vector instructions of the processor.
#pragma once

#include <array>

namespace bqsa {

/// One number a joint, with room for as many joints as a chain can have.
inline constexpr int kMaxAngles = 16;
using Angles = std::array<double, kMaxAngles>;

/// Sine and cosine of the angles q[0] + offset[0] .. q[count - 1] + offset[count - 1].
///
/// Each is within 2.3e-16 of the true value of the rounded sum, one unit in the last place of 1: by
/// reduction to [-pi/4, pi/4] with pi/2 in three parts (Cody and Waite), then fdlibm's polynomials. The
/// answers are the same, bit for bit, on all processors, unless an angle exceeds 1e5 rad or is no number;
/// then the standard library gives them.
///
/// @param q  angles, with room for kMaxAngles of them [rad]
void sine_cosine(const double* q, const Angles& offset, int count, Angles& sine, Angles& cosine);

/// Largest turn of `turn_slightly` [rad].
inline constexpr double kSlightTurn = 0.0625;

/// Turns angles from q_from to q_to: at a third of the cost of `sine_cosine`, and with rounding errors
/// below 2.3e-16 of its own.
///
/// @param q_from, q_to  as q above; offsets need not be known
/// @param sine, cosine  at q_from on entry, at q_to after the call
/// @return false, and all is as it was, if an angle turns by more than kSlightTurn or is no number
bool turn_slightly(const double* q_from, const double* q_to, int count, Angles& sine,
                   Angles& cosine);

}  // namespace bqsa
