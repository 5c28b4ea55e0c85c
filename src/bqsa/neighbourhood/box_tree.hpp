/// @file
/// A tree over boxes that grow with the distance asked for.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "bqsa/neighbourhood/box_search.hpp"

namespace bqsa {

/// Where something is as long as distances up to d matter: of axis a, [low - d stretch, high + d stretch].
struct GrowingBox {
  Eigen::Vector3f low, high;  ///< [m]
  Eigen::Vector3f stretch;    ///< not negative [-]

  /// The least box in single precision that holds the one given for every d >= 0. Infinite numbers may be
  /// given; what lies beyond single precision becomes infinite.
  static GrowingBox around(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                           const Eigen::Vector3d& stretch);

  /// How far the segment from p1 to p2 is from the box for distance d, on the axis on which that is
  /// most; not positive if on every axis they overlap. No more than it is, in spite of rounding [m].
  double gap(const Eigen::Vector3d& p1, const Eigen::Vector3d& p2, double d) const;
};

/// Boxes in the order of a space-filling curve, in groups of 16, these again in groups of 16, and so on.
/// One group is searched by two or three vector instructions an axis, and to find what is near in a
/// scene of constant density takes groups of every level that are about as many for a thousand boxes as
/// for a million. 42 bytes a box.
class BoxTree {
 public:
  BoxTree() = default;

  /// @param ids  what the boxes belong to, returned by `id`
  BoxTree(std::span<const GrowingBox> boxes, std::span<const std::int32_t> ids);

  /// Writes the positions of all boxes that meet the box of the segment from p1 to p2, grown by `margin`
  /// [m] on all sides, when distances up to d > 0 matter. Never leaves one out, in spite of rounding.
  /// Does not allocate.
  BoxesFound search(const Eigen::Vector3d& p1, const Eigen::Vector3d& p2, double margin, double d,
                    std::span<std::int32_t> positions) const;

  std::int32_t id(std::int32_t position) const { return ids_[static_cast<std::size_t>(position)]; }
  GrowingBox box(std::int32_t position) const;

  std::size_t bytes() const;

 private:
  std::vector<std::vector<BoxGroup>> groups_;  ///< of every level, boxes first
  std::vector<std::int32_t> ids_;
};

}  // namespace bqsa
