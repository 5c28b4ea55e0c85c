/// @file
/// How often the batched test answers wrongly, by exact arithmetic, on ordinary and on adversarial
/// pairs.
#pragma once

#include <cstdint>
#include <string_view>

namespace bqsa::harness {

/// What is special about the links of a family.
enum class PairFamily {
  kRandom,        ///< nothing
  kVertical,      ///< along the last axis of W
  kNearVertical,  ///< the same, tilted by 1e-12
  kZeroLength,
  kContained,  ///< both ends inside
  kTangent,    ///< half touch to within a few units in the last place, half miss by up to 1 %
  kFar,        ///< 10 m to 1 km long, semi-axes 2 cm to 2 m
};

inline constexpr PairFamily kPairFamilies[] = {PairFamily::kRandom,       PairFamily::kVertical,
                                               PairFamily::kNearVertical, PairFamily::kZeroLength,
                                               PairFamily::kContained,    PairFamily::kTangent,
                                               PairFamily::kFar};

std::string_view name_of(PairFamily family);

/// Answers of all instruction sets of the processor. The reference works in 113 bits from centre,
/// semi-axes and rotation, and shares no code with the test.
struct BatchErrors {
  std::int64_t pairs = 0;
  std::int64_t hits = 0;          ///< by the reference
  std::int64_t in_band = 0;       ///< nothing is promised of them
  std::int64_t missed = 0;        ///< hits called free, by one instruction set or more
  std::int64_t false_alarms = 0;  ///< free pairs called hits

  BatchErrors& operator+=(const BatchErrors& more);
};

/// Of `bqsa::hit_masks` in double: right if the ellipsoid 1e-9 smaller and the one 1e-9 larger are both hit
/// or both free; else the pair is in the band.
/// @param dimension  2 or 3
BatchErrors batch_errors_in_double(PairFamily family, int dimension, std::int64_t pairs,
                                   std::uint64_t seed);

/// The same in float: every hit, touching or not, must be found; what the obstacle grown for float
/// (single_precision.hpp), and grown by as much again, does not meet must be free. In between is the
/// band.
BatchErrors batch_errors_in_float(PairFamily family, int dimension, std::int64_t pairs,
                                  std::uint64_t seed);

}  // namespace bqsa::harness
