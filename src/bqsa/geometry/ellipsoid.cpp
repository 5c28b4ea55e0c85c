#include "bqsa/geometry/ellipsoid.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace bqsa {
namespace {

/// Largest departure from orthonormality that passes for rounding.
constexpr double kRotationTolerance = 1e-9;

static_assert(std::numeric_limits<long double>::digits >= 64, "no type beyond double precision");

/// The triangular factor of diag(1/a) Rᵀ. Extended precision makes its rounding error that of one
/// final rounding to double, which the bound in rounding.hpp relies on.
template <int Dim>
Eigen::Matrix<double, Dim, Dim> triangular_unit_map(
    const Eigen::Matrix<double, Dim, 1>& semi_axes,
    const Eigen::Matrix<double, Dim, Dim>& rotation) {
  using Extended = Eigen::Matrix<long double, Dim, Dim>;
  const Extended full = semi_axes.template cast<long double>().cwiseInverse().asDiagonal() *
                        rotation.template cast<long double>().transpose();
  const Eigen::HouseholderQR<Extended> qr(full);
  Extended triangular = Extended::Zero();
  triangular.template triangularView<Eigen::Upper>() = qr.matrixQR();
  return triangular.template cast<double>();
}

}  // namespace

template <int Dim>
EllipsoidN<Dim>::EllipsoidN(const Vector& center, const Vector& semi_axes, const Matrix& rotation)
    : center_(center), semi_axes_(semi_axes), rotation_(rotation) {
  if (!center.allFinite()) throw std::invalid_argument("ellipsoid: the centre must be finite");
  if (!semi_axes.allFinite() || !(semi_axes.minCoeff() > 0)) {
    throw std::invalid_argument("ellipsoid: semi-axes must be positive and finite");
  }
  if (!rotation.isUnitary(kRotationTolerance) || !(rotation.determinant() > 0)) {
    throw std::invalid_argument("ellipsoid: the rotation must be orthonormal and right-handed");
  }
  unit_map_ = triangular_unit_map<Dim>(semi_axes_, rotation_);
}

template <int Dim>
typename EllipsoidN<Dim>::Matrix EllipsoidN<Dim>::quadratic_form() const {
  return unit_map_.transpose() * unit_map_;
}

Ellipse rotated_ellipse(const Eigen::Vector2d& center, const Eigen::Vector2d& semi_axes,
                        double angle) {
  return {center, semi_axes, Eigen::Rotation2Dd(angle).toRotationMatrix()};
}

Ellipsoid embedded(const Ellipse& ellipse) {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  rotation.topLeftCorner<2, 2>() = ellipse.rotation();
  const Eigen::Vector2d& a = ellipse.semi_axes();
  return {
      {ellipse.center().x(), ellipse.center().y(), 0.0}, {a.x(), a.y(), a.maxCoeff()}, rotation};
}

Ellipse planar_section(const Ellipsoid& ellipsoid) {
  return {ellipsoid.center().head<2>(), ellipsoid.semi_axes().head<2>(),
          ellipsoid.rotation().topLeftCorner<2, 2>()};
}

Ellipse shadow(const Ellipsoid& ellipsoid, const Eigen::Matrix<double, 2, 3>& selector) {
  if (!selector.transpose().isUnitary(kRotationTolerance)) {
    throw std::invalid_argument("shadow: the rows of the selector must be orthonormal");
  }
  const Eigen::Matrix<double, 2, 3> axes =
      selector * ellipsoid.rotation() * ellipsoid.semi_axes().asDiagonal();
  const Eigen::JacobiSVD<Eigen::Matrix<double, 2, 3>> svd(axes, Eigen::ComputeFullU);
  Eigen::Matrix2d rotation = svd.matrixU();
  if (rotation.determinant() < 0) rotation.col(1) = -rotation.col(1);
  return {selector * ellipsoid.center(), svd.singularValues(), rotation};
}

template class EllipsoidN<2>;
template class EllipsoidN<3>;

}  // namespace bqsa
