#include "bqsa/batch/single_precision.hpp"

#include <algorithm>
#include <cmath>

namespace bqsa {
namespace {

constexpr double kEps = 0x1p-24;
constexpr double kLargestShrinking = 0.75;  // of sigma: beyond it nothing useful is left

}  // namespace

template <int Dim>
std::optional<EllipsoidN<Dim>> grown_for_float(const EllipsoidN<Dim>& shape,
                                               const Workspace& workspace) {
  using Vector = typename EllipsoidN<Dim>::Vector;
  const double longest = shape.semi_axes().maxCoeff();
  const double reach = workspace.reach;
  const double eta = workspace.point_error;
  const double link = std::min(workspace.link_length, 2 * std::sqrt(Dim) * reach);
  const double least = std::max({std::cbrt(3 * kEps * link * link * longest),
                                 std::sqrt((12 * kEps * reach + eta) * longest),
                                 std::sqrt(8 * kEps) * link, 200 * kEps * reach, 5 * eta});
  const Vector axes = shape.semi_axes().cwiseMax(least);

  // |T_j|, from T = diag(1/a) Rᵀ up to a turn, which no length sees.
  const Vector inverse = axes.cwiseInverse();
  const double columns =
      (inverse.asDiagonal() * shape.rotation().transpose()).colwise().norm().sum();
  const double center =
      (inverse.asDiagonal() * (shape.rotation().transpose() * shape.center())).norm();
  const double e = 6 * kEps * (reach * columns + center) + eta * inverse.maxCoeff();
  const double length = link * inverse.maxCoeff() + 2 * e;
  const double needed = kEps * (28 + 3 * length * length);
  if (!(needed < 1)) return std::nullopt;
  const double sigma = 1 - std::sqrt(1 - needed) + e;
  if (!(sigma < kLargestShrinking)) return std::nullopt;
  return EllipsoidN<Dim>(shape.center(), axes / (1 - sigma), shape.rotation());
}

template std::optional<Ellipse> grown_for_float<2>(const Ellipse&, const Workspace&);
template std::optional<Ellipsoid> grown_for_float<3>(const Ellipsoid&, const Workspace&);

}  // namespace bqsa
