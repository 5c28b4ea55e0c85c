/// @file
/// Solid ellipses and ellipsoids: the shapes that envelope every obstacle (paper, section 2.1).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace bqsa {

/// The solid ellipsoid {p : |T (p - c)| <= 1} in Dim = 2 or 3 dimensions, frame W, lengths in
/// metres.
///
/// T maps the ellipsoid to the unit ball and is upper triangular: T = O diag(1/a) Rᵀ for semi-axes
/// a, rotation R and some orthogonal O. The quadratic form of the paper's Eq. (2) is Q = TᵀT. A
/// triangular T costs 3 multiplications a point in the plane and 6 in space.
template <int Dim>
class EllipsoidN {
  static_assert(Dim == 2 || Dim == 3);

 public:
  using Vector = Eigen::Matrix<double, Dim, 1>;
  using Matrix = Eigen::Matrix<double, Dim, Dim>;

  /// @param center     centre c in W [m]
  /// @param semi_axes  half lengths of the axes, all positive [m]
  /// @param rotation   columns are the directions of the axes in W; orthonormal, right-handed
  /// @throws std::invalid_argument naming the offending argument
  EllipsoidN(const Vector& center, const Vector& semi_axes,
             const Matrix& rotation = Matrix::Identity());

  const Vector& center() const { return center_; }
  const Vector& semi_axes() const { return semi_axes_; }
  const Matrix& rotation() const { return rotation_; }

  /// The upper triangular T of the class comment [1/m].
  const Matrix& unit_map() const { return unit_map_; }

  /// The quadratic form Q = R diag(1/a²) Rᵀ [1/m²].
  Matrix quadratic_form() const;

  /// |T (p - c)|² - 1: negative inside the ellipsoid, 0 on its surface, positive outside.
  /// It orders points but is not a distance.
  double level(const Vector& p) const { return (unit_map_ * (p - center_)).squaredNorm() - 1; }

  /// Support function: the largest nᵀ(p - c) over the ellipsoid, sqrt(nᵀ Q⁻¹ n) [m for a unit n].
  double support(const Vector& n) const {
    return (semi_axes_.asDiagonal() * (rotation_.transpose() * n)).norm();
  }

 private:
  Vector center_;
  Vector semi_axes_;
  Matrix rotation_;
  Matrix unit_map_;
};

using Ellipse = EllipsoidN<2>;
using Ellipsoid = EllipsoidN<3>;

/// An ellipse with axes turned by `angle` [rad] from those of W.
Ellipse rotated_ellipse(const Eigen::Vector2d& center, const Eigen::Vector2d& semi_axes,
                        double angle);

/// The ellipse as an ellipsoid whose third semi-axis, along z, is max(a, b). Anything in the plane
/// z = 0 meets the ellipsoid exactly when it meets the ellipse, and by mirror symmetry its nearest
/// point on the ellipsoid lies in that plane too.
Ellipsoid embedded(const Ellipse& ellipse);

/// The ellipse in which an ellipsoid made by `embedded` meets the plane z = 0.
Ellipse planar_section(const Ellipsoid& ellipsoid);

/// Shadow of an ellipsoid on a plane (paper, Lemma 1): the orthogonal projection onto the plane
/// spanned by the two orthonormal rows of `selector`, in the coordinates selector * p. Its matrix
/// is (S Q⁻¹ Sᵀ)⁻¹; computed from the singular values of S R diag(a), which keeps thin shapes
/// accurate.
/// @throws std::invalid_argument if the rows are not orthonormal
Ellipse shadow(const Ellipsoid& ellipsoid, const Eigen::Matrix<double, 2, 3>& selector);

}  // namespace bqsa
