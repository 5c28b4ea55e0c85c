/// @file
/// Least distances of many test points to many others, with vector instructions.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "baselines/closest/point_arrays.hpp"

namespace bqsa::baselines {

/// Groups of test points, as many each, laid out for vector instructions: a group belongs to a link or an
/// obstacle.
class PointBlocks {
 public:
  /// What lies side by side, eight at a time. The last eight are filled up with the last one.
  enum class Lanes {
    kPoints,  ///< points of one group: a block a group
    kGroups,  ///< points of eight groups: a block eight groups, nothing to be compared across lanes
  };

  /// @param dimension  2 or 3
  /// @param count      points a group
  PointBlocks(Lanes lanes, int dimension, int groups, int count);

  /// Group g is at these points, by rows [m]. Does not allocate.
  void set(int g, const Eigen::Ref<const Eigen::MatrixX3d>& points);

  Lanes lanes() const { return lanes_; }
  int dimension() const { return dimension_; }
  int groups() const { return groups_; }
  int blocks() const;
  int rows() const;  ///< of eight points, a block

  /// Where the least distance of group g to group i of n others is written.
  std::size_t index(int g, int i, int n) const;

  /// Block by block, row by row, coordinate by coordinate.
  const double* data() const { return numbers_.data(); }

 private:
  Lanes lanes_;
  int dimension_;
  int groups_;
  int count_;
  std::vector<double> numbers_;
};

/// Points to be compared with those of blocks, in groups of `count` that follow each other.
struct PointGroups {
  PointArrays points;
  int count;

  int groups() const;
};

/// How many numbers `least_squared_distances` writes.
std::size_t least_needed(const PointBlocks& blocks, const PointGroups& others);

/// How squared distances are rounded.
enum class Rounding {
  kFused,     ///< by multiply-adds: the fastest
  kAsScalar,  ///< after every operation, x before y before z: what scalar code finds, to the last bit
};

/// The least squared distance of any point of a group to any of another, for all pairs of groups [m²],
/// at blocks.index(). Does not allocate.
void least_squared_distances(const PointBlocks& blocks, const PointGroups& others,
                             Rounding rounding, std::span<double> least);

/// What a pair of groups takes with these lanes, about, in squared distances of a vector: to choose by.
/// @param others_count  points of each group that they are compared with
double work_a_pair(PointBlocks::Lanes lanes, int groups, int count, int others_count);

}  // namespace bqsa::baselines
