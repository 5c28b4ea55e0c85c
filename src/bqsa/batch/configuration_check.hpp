/// @file
/// Many configurations of one arm against one scene at a time, in float: what sampling planners and
/// checks of whole motions ask.
///
///     const ConfigurationCheck check(chain, shapes, radius);
///     ConfigurationArray configurations(chain.joints(), 1000);
///     for (int i = 0; i < 1000; ++i) configurations.set(i, q[i]);
///     std::vector<std::uint16_t> free(configurations.blocks());
///     check.certainly_free(configurations, free);
///     if (free[i / 16] >> i % 16 & 1) ...  // configuration i is free, without doubt
///
/// A vector holds the same number of several configurations; obstacles come one after another, and a
/// block of configurations is done as soon as none of it is free any more.
#pragma once

#include <cstdint>
#include <memory>
#include <numbers>
#include <span>
#include <variant>
#include <vector>

#include "bqsa/batch/arm_kernels.hpp"
#include "bqsa/batch/obstacle_batch.hpp"
#include "bqsa/kinematics/serial_chain.hpp"

namespace bqsa {

/// Joint angles of many configurations, rounded to float, in blocks of 16: joint j of configuration i
/// at [(i / 16 * joints + j) * 16 + i % 16]. The last block is filled up with zeros.
class ConfigurationArray {
 public:
  static constexpr int kBlock = 16;

  ConfigurationArray(int joints, int count);

  /// @param q  [rad]
  void set(int index, const JointVector& q);

  int joints() const { return joints_; }
  int count() const { return count_; }
  std::size_t blocks() const { return static_cast<std::size_t>((count_ + kBlock - 1) / kBlock); }
  const float* data() const { return angles_.data(); }

 private:
  int joints_, count_;
  std::vector<float> angles_;
};

/// Which configurations are certainly free.
///
/// *Free is certain*: all links keep `clearance` from all obstacles, in exact arithmetic. The obstacles
/// are grown by that distance (ellipsoid_around.hpp) and by what float needs
/// (single_precision.hpp), which includes the error of the end-points: with angles of at most A, offsets
/// included, cosines and sines that err by up to 6 eps (3 units in the last place, as Highway's
/// promise), eps = 2^-24, every joint adds
///
///     (8.5 + 2 A + 9.5) eps < (20 + 2 A) eps      (cosine and sine; angle; two turns of the frame)
///
/// to the error of the frame, r_j, and its row
///
///     (|a| + |d|) (r_j + 4 eps) + 2 eps S         (S: length of the arm)
///
/// to the error of the position, a few hundredths of a millimetre in the end. The base is the origin.
/// What is not certainly free need not hit: it may be closer than that, or beside a thin obstacle, for
/// which both growths are generous. Of a chain that is given by placements nothing is certain.
class ConfigurationCheck {
 public:
  /// @param shapes         in the plane `embedded` ellipses
  /// @param clearance      what links' axes have to keep from obstacles [m]
  /// @param largest_angle  configurations with a larger one, or with what is not a number, are never
  ///                       free; nor are those with one beyond what Highway promises for, 38,000
  ///                       less the largest offset [rad]
  /// @throws std::invalid_argument unless clearance and angle are finite and not negative
  ConfigurationCheck(const SerialChain& chain, std::span<const Ellipsoid> shapes, double clearance,
                     double largest_angle = 4 * std::numbers::pi);

  /// From now on the obstacle has this shape. Does not allocate.
  void set(int obstacle, const Ellipsoid& shape);

  /// Bit i % 16 of free[i / 16] is set if configuration i is certainly free. Does not allocate.
  /// @param free  as many as blocks; bits beyond the last configuration are 0
  void certainly_free(const ConfigurationArray& configurations,
                      std::span<std::uint16_t> free) const;

  /// Bound of the error of all end-points [m].
  double point_error() const { return point_error_; }

 private:
  using Obstacles = std::variant<ObstacleBatch<2, float>, ObstacleBatch<3, float>>;

  Eigen::Vector3d origin_;
  double clearance_;
  double point_error_;
  batch::Arm arm_;
  bool has_rows_;  ///< the chain, in Denavit-Hartenberg parameters
  Obstacles obstacles_;
};

}  // namespace bqsa
