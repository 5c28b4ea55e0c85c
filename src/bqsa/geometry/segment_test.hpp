/// @file
/// "Does this link hit that obstacle?" as the sign pattern of one quadratic (paper, section 3.1).
///
/// A link is the segment P(t) = P1 + t (P2 - P1), t in [0, 1]; an obstacle is a solid ellipsoid
/// with unit map T and centre c. With u = T (P1 - c) and v = T (P2 - P1), the level of P(t) is
///
///     f(t) = alpha t² + beta t + gamma,   alpha = v·v,  beta = 2 u·v,  gamma = u·u - 1,
///
/// strictly convex for a link of positive length, negative inside. Two forms of the same test:
///
/// * the *parameter form* works on alpha, beta, gamma, like the paper's Eqs. (19)-(22), but in t
///   instead of x and therefore without its vertical-link defect (see paper_form.hpp);
/// * the *polar form* (Joachimsthal) works on S11 = f(0), S22 = f(1) and S12 = u1·u2 - 1, the
///   product of both end-points. It is the same quadratic (Delta/4 = S12² - S11 S22), needs no division and
///   no special case, and shares each end-point between two links: 9 multiplications a pair in the
///   plane, 14 in space.
///
/// Touching counts as a hit, everywhere. Everything here is templated on the scalar, so that an
/// instrumented scalar can count multiplications.
#pragma once

#include <Eigen/Core>

#include "bqsa/geometry/ellipsoid.hpp"

namespace bqsa {

/// How a link lies to an obstacle: the five quadratic categories of the paper's Fig. 3.
enum class Category {
  kNoCollision1 = 1,  ///< the link's line does not enter the ellipsoid (Delta <= 0)
  kNoCollision2 = 2,  ///< the line enters it, beyond either end of the link
  kCrossing = 3,      ///< both ends outside, the link enters and leaves (or touches) in between
  kOneEndInside = 4,  ///< exactly one end inside or on the surface
  kContained = 5,     ///< both ends inside or on the surface
};

/// Categories 3, 4 and 5.
constexpr bool is_hit(Category category) { return category >= Category::kCrossing; }

/// The parameter form: coefficients of f(t), dimensionless.
template <typename Scalar>
struct ParameterForm {
  Scalar alpha, beta, gamma;
};

/// The polar form: S11 = f(0), S22 = f(1), S12 = f(0) + f'(0)/2, dimensionless.
template <typename Scalar>
struct PolarForm {
  Scalar s11, s12, s22;
};

/// u = T (p - c): the point as the ellipsoid sees it, |u| = 1 on the surface. Uses only the upper
/// triangle of T.
template <typename Scalar, int Dim>
Eigen::Matrix<Scalar, Dim, 1> unit_point(const Eigen::Matrix<Scalar, Dim, Dim>& unit_map,
                                         const Eigen::Matrix<Scalar, Dim, 1>& center,
                                         const Eigen::Matrix<Scalar, Dim, 1>& p) {
  const Eigen::Matrix<Scalar, Dim, 1> w = p - center;
  Eigen::Matrix<Scalar, Dim, 1> u;
  for (int row = 0; row < Dim; ++row) {
    u(row) = unit_map(row, row) * w(row);
    for (int col = row + 1; col < Dim; ++col) u(row) += unit_map(row, col) * w(col);
  }
  return u;
}

template <int Dim>
Eigen::Matrix<double, Dim, 1> unit_point(const EllipsoidN<Dim>& ellipsoid,
                                         const Eigen::Matrix<double, Dim, 1>& p) {
  return unit_point<double, Dim>(ellipsoid.unit_map(), ellipsoid.center(), p);
}

/// Scalar product, written out: Eigen's own would load in pairs what was just stored one by one,
/// and wait for it.
template <typename Scalar, int Dim>
Scalar inner(const Eigen::Matrix<Scalar, Dim, 1>& a, const Eigen::Matrix<Scalar, Dim, 1>& b) {
  Scalar sum = a(0) * b(0);
  for (int k = 1; k < Dim; ++k) sum += a(k) * b(k);
  return sum;
}

/// Parameter form of the link from u1 to u2, both given by `unit_point`.
template <typename Scalar, int Dim>
ParameterForm<Scalar> parameter_form(const Eigen::Matrix<Scalar, Dim, 1>& u1,
                                     const Eigen::Matrix<Scalar, Dim, 1>& u2) {
  Eigen::Matrix<Scalar, Dim, 1> v;
  for (int k = 0; k < Dim; ++k) v(k) = u2(k) - u1(k);
  const Scalar half_beta = inner(u1, v);
  return {inner(v, v), half_beta + half_beta, inner(u1, u1) - Scalar(1)};
}

/// Polar form of the link from u1 to u2, both given by `unit_point`.
template <typename Scalar, int Dim>
PolarForm<Scalar> polar_form(const Eigen::Matrix<Scalar, Dim, 1>& u1,
                             const Eigen::Matrix<Scalar, Dim, 1>& u2) {
  return {inner(u1, u1) - Scalar(1), inner(u1, u2) - Scalar(1), inner(u2, u2) - Scalar(1)};
}

template <int Dim>
PolarForm<double> polar_form(const EllipsoidN<Dim>& ellipsoid,
                             const Eigen::Matrix<double, Dim, 1>& p1,
                             const Eigen::Matrix<double, Dim, 1>& p2) {
  return polar_form<double, Dim>(unit_point(ellipsoid, p1), unit_point(ellipsoid, p2));
}

/// Whether the link meets the solid ellipsoid (categories 3 to 5).
template <typename Scalar>
bool hits(const PolarForm<Scalar>& f) {
  const Scalar zero(0);
  return f.s11 <= zero || f.s22 <= zero || (f.s12 < zero && f.s12 * f.s12 >= f.s11 * f.s22);
}

/// Category by the polar form. The order of the questions makes the five complete and disjoint.
template <typename Scalar>
Category category(const PolarForm<Scalar>& f) {
  const Scalar zero(0);
  const bool start_inside = f.s11 <= zero;
  const bool end_inside = f.s22 <= zero;
  if (start_inside && end_inside) return Category::kContained;
  if (start_inside || end_inside) return Category::kOneEndInside;
  const Scalar s12_squared = f.s12 * f.s12;
  const Scalar s11_s22 = f.s11 * f.s22;
  if (f.s12 < zero && s12_squared >= s11_s22) return Category::kCrossing;
  return s12_squared <= s11_s22 ? Category::kNoCollision1 : Category::kNoCollision2;
}

/// Category by the parameter form, with the paper's own criteria: f and f' at both ends, and Delta.
template <typename Scalar>
Category category(const ParameterForm<Scalar>& f) {
  const Scalar zero(0);
  const bool start_inside = f.gamma <= zero;
  const bool end_inside = f.alpha + f.beta + f.gamma <= zero;
  if (start_inside && end_inside) return Category::kContained;
  if (start_inside || end_inside) return Category::kOneEndInside;
  const Scalar delta = f.beta * f.beta - Scalar(4) * f.alpha * f.gamma;
  const bool vertex_within = f.beta < zero && f.alpha + f.alpha + f.beta > zero;
  if (vertex_within && delta >= zero) return Category::kCrossing;
  return delta <= zero ? Category::kNoCollision1 : Category::kNoCollision2;
}

/// Parameter t* in [0, 1] of the link's deepest point in the ellipsoid's own metric: the clamped
/// vertex of f. It comes free of charge with the quadratic and is not the closest point.
/// A link of zero length gives 0.
template <typename Scalar>
Scalar vertex(const PolarForm<Scalar>& f) {
  const Scalar towards = f.s11 - f.s12;                // -beta / 2
  const Scalar curvature = towards + (f.s22 - f.s12);  // alpha
  if (!(towards > Scalar(0))) return Scalar(0);
  return towards < curvature ? towards / curvature : Scalar(1);
}

/// `vertex` of the parameter form.
template <typename Scalar>
Scalar vertex(const ParameterForm<Scalar>& f) {
  const Scalar towards = -f.beta;
  const Scalar curvature = f.alpha + f.alpha;
  if (!(towards > Scalar(0))) return Scalar(0);
  return towards < curvature ? towards / curvature : Scalar(1);
}

}  // namespace bqsa
