/// @file
/// All the ways to tell which links hit which obstacles, behind one interface, so that they are
/// measured on the same inputs by the same loop.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "harness/measuring/workload.hpp"

namespace bqsa::harness {

/// A detector with everything prepared that does not depend on the pose, and, as the paper assumes for
/// both sides, with the positions of end-points and test points and the coefficients of ellipses known.
class Detection {
 public:
  virtual ~Detection() = default;

  /// Writes at hit[j * n + i] whether link i hits obstacle j in this pose, both counted from 0: 1 or 0.
  /// The only virtual call of a pass over all nk pairs. Does not allocate, libraries excepted.
  virtual void detect(int pose, std::span<std::uint8_t> hit) = 0;
};

/// Test points that are closer than this are a hit [m].
inline constexpr double kTestPointMargin = 0.02;

/// What a detector's answers are worth; `verify_detector` holds it to that.
enum class Accuracy {
  kExact,            ///< those of the reference, but for touching to within rounding
  kLibrary,          ///< the same, but for touching to within the library's tolerance
  kSinglePrecision,  ///< the same, of a library that computes in single precision
  kSampled,  ///< hits are what has test points closer than the margin, at least, and nothing
             ///< further away than that: misses hits between its test points
  kPaper,    ///< exact but for links that are vertical, or nearly so
  kPaperConservative,  ///< never free where the reference finds a hit, but for links that look
                       ///< vertical, or nearly so, in one of the projections
  kConservative,  ///< never free where the reference finds a hit, and exact beyond a band around that
};

struct Detector {
  std::string_view name;   ///< as in `--detector`, tables and files: `test_points`
  std::string_view label;  ///< as in figures: `test points`
  std::string_view what;   ///< one sentence
  Accuracy accuracy;
  bool in_plane;  ///< can be prepared for workloads of dimension 2
  bool in_space;  ///< and of dimension 3

  /// Multiplications a pair of link and obstacle, counted by the rule of the paper's section 3.4: the
  /// quadratic and its discriminant, or all pairs of test points (verified by an instrumented scalar).
  /// The paper's forms make 7 more for its criteria at the ends of the link, which that rule leaves out.
  /// Not a number for libraries and iterations.
  double (*multiplications)(const WorkloadSize& size);

  bool is_for(int dimension) const { return dimension == 2 ? in_plane : in_space; }

  /// The workload must outlive the detection, and be of a dimension that the detector is for.
  std::unique_ptr<Detection> (*prepare)(const Workload& workload);
};

/// All detectors: the forms of BQSA, the test points, the exact distance, FCL, libccd and Bullet.
std::span<const Detector> detectors();

/// @throws InputError that lists the names
const Detector& detector_named(std::string_view name);

}  // namespace bqsa::harness
