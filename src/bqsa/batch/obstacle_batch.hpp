/// @file
/// Obstacles laid out for the batched segment test (batched_test.hpp): many at a time in one vector.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <span>

#include "bqsa/geometry/ellipsoid.hpp"

namespace bqsa {

/// What is known of the points that a batch will be asked about, all in W.
struct Workspace {
  /// No coordinate of a point is larger than this in size [m]. The batched test looks: links at a point
  /// further out, or at one that is not a number, count as hits.
  double reach = 1e6;

  /// No link is longer than this [m]. A promise of the caller's, which only float relies on.
  double link_length = std::numeric_limits<double>::infinity();

  /// Points are no further than this from where they should be [m], before they are rounded to float.
  /// Only for float.
  double point_error = 0;
};

/// Structure of arrays. Obstacles come in blocks of 16; a block holds row after row of 16 coefficients,
/// those of the affine map u = T p + k that sends an obstacle to the unit ball (segment_test.hpp):
///
///     space: T00 T01 T02 T11 T12 T22 k0 k1 k2,     plane: T00 T01 T11 k0 k1,     k = -T c,
///
/// T upper triangular and k computed in extended precision, each rounded once. The last block is
/// filled up with obstacles that nothing hits. In space an obstacle takes 72 bytes in double, 36 in
/// float.
///
/// In double obstacles are as they are, and answers are those of the scalar test but for rounding.
/// In float they are a little larger (single_precision.hpp), so that no hit is ever called free.
/// An obstacle so thin or so far away that its coefficients could overflow the test is one that
/// everything hits.
template <int Dim, typename Real>
class ObstacleBatch {
 public:
  static constexpr int kBlock = 16;                  ///< obstacles a block
  static constexpr int kRows = Dim == 2 ? 5 : 9;     ///< coefficients an obstacle
  static constexpr std::size_t kAlignment = 64;      ///< of every row [bytes]
  static constexpr int kBlockSize = kBlock * kRows;  ///< numbers a block

  /// Room for `size` obstacles, at first ones that nothing hits.
  /// @throws std::invalid_argument if the size is negative, or the workspace has no positive reach and
  ///   link length or a negative point error
  ObstacleBatch(int size, const Workspace& workspace);

  /// @throws std::invalid_argument as above
  ObstacleBatch(std::span<const EllipsoidN<Dim>> shapes, const Workspace& workspace);

  /// From now on obstacle `index` has this shape, as one that moves has it at every tick. Does not
  /// allocate.
  void set(int index, const EllipsoidN<Dim>& shape);

  int size() const { return size_; }  ///< obstacles
  int blocks() const { return (size_ + kBlock - 1) / kBlock; }
  const Workspace& workspace() const { return workspace_; }

  /// Of `blocks()` blocks, as in the class comment; 64-byte aligned.
  const Real* coefficients() const { return coefficients_.get(); }

 private:
  struct Free {
    void operator()(Real* memory) const;
  };

  void write(int index, const Real (&row)[kRows]);

  int size_;
  Workspace workspace_;
  std::unique_ptr<Real[], Free> coefficients_;
};

}  // namespace bqsa
