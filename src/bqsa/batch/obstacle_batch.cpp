#include "bqsa/batch/obstacle_batch.hpp"

#include <cassert>
#include <cmath>
#include <new>
#include <optional>
#include <stdexcept>
#include <type_traits>

#include "bqsa/batch/single_precision.hpp"

namespace bqsa {
namespace {

/// Bound of |u| up to which S12² and S11 S22 stay far from overflow.
template <typename Real>
constexpr double kLargestUnitPoint = std::is_same_v<Real, float> ? 1e8 : 1e70;

void validate(int size, const Workspace& workspace) {
  if (size < 0) throw std::invalid_argument("obstacle batch: the size must not be negative");
  if (!(workspace.reach > 0) || !std::isfinite(workspace.reach)) {
    throw std::invalid_argument("workspace: the reach must be positive and finite");
  }
  if (!(workspace.link_length > 0)) {
    throw std::invalid_argument("workspace: the link length must be positive");
  }
  if (!(workspace.point_error >= 0)) {
    throw std::invalid_argument("workspace: the point error must not be negative");
  }
}

/// Largest |u| of any point within reach, or more.
template <int Dim>
double largest_unit_point(const EllipsoidN<Dim>& shape, double reach) {
  const typename EllipsoidN<Dim>::Matrix& T = shape.unit_map();
  return reach * T.colwise().norm().sum() + (T * shape.center()).norm();
}

}  // namespace

template <int Dim, typename Real>
void ObstacleBatch<Dim, Real>::Free::operator()(Real* memory) const {
  ::operator delete[](memory, std::align_val_t{kAlignment});
}

template <int Dim, typename Real>
ObstacleBatch<Dim, Real>::ObstacleBatch(int size, const Workspace& workspace)
    : size_(size), workspace_(workspace) {
  validate(size, workspace);
  const std::size_t numbers = static_cast<std::size_t>(blocks()) * kBlockSize;
  coefficients_.reset(
      static_cast<Real*>(::operator new[](numbers * sizeof(Real), std::align_val_t{kAlignment})));
  Real beyond_all[kRows] = {};  // T = 0 and |k| = 2: every point has the level of one outside
  beyond_all[kRows - Dim] = 2;
  for (int j = 0; j < blocks() * kBlock; ++j) write(j, beyond_all);
}

template <int Dim, typename Real>
ObstacleBatch<Dim, Real>::ObstacleBatch(std::span<const EllipsoidN<Dim>> shapes,
                                        const Workspace& workspace)
    : ObstacleBatch(static_cast<int>(shapes.size()), workspace) {
  for (int j = 0; j < size_; ++j) set(j, shapes[static_cast<std::size_t>(j)]);
}

template <int Dim, typename Real>
void ObstacleBatch<Dim, Real>::set(int index, const EllipsoidN<Dim>& shape) {
  assert(0 <= index && index < size_);
  Real row[kRows] = {};  // T = 0 and k = 0: everything is at the centre
  std::optional<EllipsoidN<Dim>> stored;
  if constexpr (std::is_same_v<Real, float>) {
    stored = grown_for_float(shape, workspace_);
  } else {
    stored = shape;
  }
  if (stored && largest_unit_point(*stored, workspace_.reach) < kLargestUnitPoint<Real>) {
    int next = 0;
    for (int i = 0; i < Dim; ++i) {
      for (int j = i; j < Dim; ++j) row[next++] = static_cast<Real>(stored->unit_map()(i, j));
    }
    for (int i = 0; i < Dim; ++i) {
      long double k = 0;
      for (int j = i; j < Dim; ++j) {
        k -= static_cast<long double>(stored->unit_map()(i, j)) * stored->center()(j);
      }
      row[next++] = static_cast<Real>(k);
    }
  }
  write(index, row);
}

template <int Dim, typename Real>
void ObstacleBatch<Dim, Real>::write(int index, const Real (&row)[kRows]) {
  Real* block = coefficients_.get() + static_cast<std::size_t>(index / kBlock) * kBlockSize;
  for (int r = 0; r < kRows; ++r) block[r * kBlock + index % kBlock] = row[r];
}

template class ObstacleBatch<2, double>;
template class ObstacleBatch<3, double>;
template class ObstacleBatch<2, float>;
template class ObstacleBatch<3, float>;

}  // namespace bqsa
