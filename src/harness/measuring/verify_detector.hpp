/// @file
/// Whether a detector's answers are right: asked before any of its times is worth anything.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/measuring/detector.hpp"

namespace bqsa::harness {

/// How all links lie to all obstacles, in the first poses of a workload, by the judge's exact distance,
/// which shares no code with any detector.
struct ReferenceAnswers {
  int poses;  ///< that were asked

  /// Signed distance of link i and obstacle j in pose p at [(p k + j) n + i] [m].
  std::vector<double> clearance;
};

/// @param pairs_at_most  ask whole poses as long as there are no more pairs, one pose in any case
ReferenceAnswers reference_answers(const Workload& workload, int pairs_at_most = 50'000);

/// A detector's answers against the reference, and those of test points against the test points, all
/// pairs of which are tried. Left out are pairs for which its accuracy promises
/// nothing: those within the `touching_band`, and for the paper's forms links that are
/// vertical to within `kVertical`.
struct Verification {
  int hits = 0;          ///< by the reference
  int missed = 0;        ///< of them
  int free = 0;          ///< by the reference
  int false_alarms = 0;  ///< of them
  int far_alarms = 0;    ///< of the false alarms: further away than `kTestPointMargin`
  int overlooked = 0;    ///< called free though test points are closer than the margin
  int touching = 0;      ///< left out
  int vertical = 0;      ///< left out
};

/// @param reference  of this workload, or of one that differs from it in test points only
Verification verify_detector(const Detector& detector, const Workload& workload,
                             const ReferenceAnswers& reference);

/// How far from touching answers are promised to be right [m].
struct TouchingBand {
  double hits;  ///< how deep a hit must be
  double free;  ///< how far apart the others must be
};
TouchingBand touching_band(Accuracy accuracy);

/// |x_{i+1} - x_i| below which a link counts as vertical to the paper's forms [m]: there rounding can
/// move their answers by more than the touching band.
inline constexpr double kVertical = 1e-5;

/// What the detector promised and did not keep, as `ccd_mpr: missed 3 of 120 hits`; empty if it did.
/// Test points may miss what none of them is near, but not what one is, and nothing further away than
/// their margin is a hit to them. A workload without a single hit or without a single free pair shows
/// nothing and is not accepted.
std::string broken_promise(const Detector& detector, const Verification& verification);

}  // namespace bqsa::harness
