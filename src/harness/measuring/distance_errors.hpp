/// @file
/// How far the batched exact distance is from one found by bisection in extended precision.
#pragma once

#include <cstdint>

namespace bqsa::harness {

struct DistanceErrors {
  std::int64_t pairs = 0;
  std::int64_t meeting = 0;  ///< by the reference
  std::int64_t disagreed =
      0;                ///< on whether they meet, touching to within 1e-9 of the semi-axes left out
  double distance = 0;  ///< largest error of a distance [m]
  double point = 0;     ///< of pairs that are apart: of the link's closest point [m]
};

/// Of `baselines::segment_distances` with each instruction set of the processor, links of up to half a metre
/// among eggs with semi-axes of 5 cm to 50 cm. The reference shares no code with it.
/// @param pairs  rounded up to a multiple of 256
DistanceErrors batched_distance_errors(std::int64_t pairs, std::uint64_t seed);

}  // namespace bqsa::harness
