/// @file
/// What writing and reading measurements have to agree on.
#pragma once

namespace bqsa::harness {

inline constexpr const char* kMeasurementsSchema = "bqsa-measurements/1";

/// Ends the names of entries by the paper's protocol.
inline constexpr const char* kPaperEnd = "/paper";

/// Of files from before batched code.
inline constexpr const char* kUnknownInstructionSet = "unknown";

inline constexpr double kNanosecond = 1e-9;  ///< unit of times in the file [s]

}  // namespace bqsa::harness
