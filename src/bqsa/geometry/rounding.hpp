/// @file
/// How far rounding can move the segment test: which of its answers are certain in double
/// precision.
///
/// "Exact" means the ellipsoid {p : |diag(1/a) Rᵀ (p - c)| <= 1} of the stored centre, semi-axes
/// and rotation, and the stored end-points. With eps = 2^-53, w = p - c and T_k the columns of the
/// unit map, the computed u = T w differs from the exact one (up to one common turn, which no
/// scalar product sees) by at most
///
///     e = 6 eps sum_k |T_k| |w_k|     (w: 1 eps; T, rounded once from extended precision: 1 + 0.1
///     eps;
///                                      a product and two sums: 3 eps; rest: higher orders)
///
/// *Polar form.* S_ij = u_i·u_j - 1 takes a product, two sums (3 eps |u_i| |u_j|) and one
/// subtraction (eps |S_ij|), so that
///
///     d_ij = |u_i| e_j + |u_j| e_i + e_i e_j + 4 eps |u_i| |u_j| + eps,
///
/// and the sign of S12² - S11 S22, compared after two rounded products, is certain when its size
/// exceeds
///
///     2 |S12| d12 + d12² + |S11| d22 + |S22| d11 + d11 d22 + eps (S12² + |S11 S22|).
///
/// *Parameter form.* v = u2 - u1 carries e_v = e1 + e2 + eps |v|, and errors follow in the same
/// way. Its band is wider: f(1) = alpha + beta + gamma cancels when the second end lies much nearer
/// to the obstacle than the link is long, and a slope of a link of zero length is never certain.
///
/// Outside the band the category is right; inside it the link touches to within rounding. For a
/// link as long as the obstacle the band is about 1e-15 semi-axes wide; it widens with the square
/// of the distance of the end-points, measured in the shortest semi-axis. Results too small or too
/// large for a normal double (semi-axes or distances beyond 1e±70 m) are not covered.
#pragma once

#include <cmath>
#include <limits>

#include "bqsa/geometry/segment_test.hpp"

namespace bqsa {

/// Bounds on the rounding error of each part of a polar form, dimensionless.
struct PolarRounding {
  double s11, s12, s22, discriminant;
};

/// Bounds on the rounding error of each part of a parameter form, dimensionless.
struct ParameterRounding {
  double start_value, end_value;  ///< of f(0) and f(1)
  double start_slope, end_slope;  ///< of f'(0) and f'(1)
  double discriminant;
};

namespace rounding {

inline constexpr double kEps = std::numeric_limits<double>::epsilon() / 2;
/// Covers that the bounds are themselves evaluated on rounded values.
inline constexpr double kHigherOrders = 1.01;

/// Length of a vector and a bound on the error of the vector.
struct Length {
  double length, error;
};

template <int Dim>
Length of_unit_point(const EllipsoidN<Dim>& ellipsoid, const Eigen::Matrix<double, Dim, 1>& p) {
  const Eigen::Matrix<double, Dim, 1> w = p - ellipsoid.center();
  const double columns = ellipsoid.unit_map().colwise().norm().dot(w.cwiseAbs());
  return {unit_point(ellipsoid, p).norm(), 6 * kEps * columns};
}

/// Error of a scalar product.
inline double of_product(const Length& a, const Length& b) {
  return kHigherOrders * (a.length * b.error + b.length * a.error + a.error * b.error +
                          3 * kEps * a.length * b.length);
}

/// Error of a scalar product less one: d_ij of the file comment.
inline double of_level(const Length& a, const Length& b) {
  return of_product(a, b) + kHigherOrders * kEps * (a.length * b.length + 1);
}

/// Error of x² - y z, its two products rounded, for errors dx, dy, dz of x, y, z.
inline double of_discriminant(double x, double dx, double y, double dy, double z, double dz) {
  return kHigherOrders * (2 * std::abs(x) * dx + dx * dx + std::abs(y) * dz + std::abs(z) * dy +
                          dy * dz + kEps * (x * x + std::abs(y * z)));
}

}  // namespace rounding

template <int Dim>
PolarRounding polar_rounding(const EllipsoidN<Dim>& ellipsoid,
                             const Eigen::Matrix<double, Dim, 1>& p1,
                             const Eigen::Matrix<double, Dim, 1>& p2) {
  const rounding::Length u1 = rounding::of_unit_point(ellipsoid, p1);
  const rounding::Length u2 = rounding::of_unit_point(ellipsoid, p2);
  const double d11 = rounding::of_level(u1, u1);
  const double d12 = rounding::of_level(u1, u2);
  const double d22 = rounding::of_level(u2, u2);
  const PolarForm<double> f = polar_form(ellipsoid, p1, p2);
  return {d11, d12, d22, rounding::of_discriminant(f.s12, d12, f.s11, d11, f.s22, d22)};
}

template <int Dim>
ParameterRounding parameter_rounding(const EllipsoidN<Dim>& ellipsoid,
                                     const Eigen::Matrix<double, Dim, 1>& p1,
                                     const Eigen::Matrix<double, Dim, 1>& p2) {
  const Eigen::Matrix<double, Dim, 1> point1 = unit_point(ellipsoid, p1);
  const Eigen::Matrix<double, Dim, 1> point2 = unit_point(ellipsoid, p2);
  const rounding::Length u1 = rounding::of_unit_point(ellipsoid, p1);
  const rounding::Length u2 = rounding::of_unit_point(ellipsoid, p2);
  const double length = (point2 - point1).norm();
  const rounding::Length v{length, u1.error + u2.error + rounding::kEps * length};

  const ParameterForm<double> f = parameter_form<double, Dim>(point1, point2);
  const double d_alpha = rounding::of_product(v, v);
  const double d_beta = 2 * rounding::of_product(u1, v);
  const double d_gamma = rounding::of_level(u1, u1);
  const double sums = 2 * rounding::kEps * (f.alpha + std::abs(f.beta) + std::abs(f.gamma));
  return {d_gamma, d_alpha + d_beta + d_gamma + sums, d_beta, 2 * d_alpha + d_beta + sums,
          rounding::of_discriminant(f.beta, d_beta, 4 * f.alpha, 4 * d_alpha, f.gamma, d_gamma)};
}

/// Whether the category of `f` is that of exact arithmetic. Once the discriminant is certainly
/// positive and both ends are outside, S12² exceeds d12², so that the sign of S12 is certain too.
inline bool is_certain(const PolarForm<double>& f, const PolarRounding& d) {
  if (std::abs(f.s11) <= d.s11 || std::abs(f.s22) <= d.s22) return false;
  if (f.s11 < 0 || f.s22 < 0) return true;
  return std::abs(f.s12 * f.s12 - f.s11 * f.s22) > d.discriminant;
}

/// Whether "hit" or "free" is the answer of exact arithmetic. More often so than the category: a
/// short link far away is certainly free, whether or not its line enters the obstacle.
inline bool is_hit_certain(const PolarForm<double>& f, const PolarRounding& d) {
  if (f.s11 < -d.s11 || f.s22 < -d.s22) return true;
  return is_certain(f, d) || (f.s11 > d.s11 && f.s22 > d.s22 && f.s12 > d.s12);
}

/// Whether the category of `f` is that of exact arithmetic.
inline bool is_certain(const ParameterForm<double>& f, const ParameterRounding& d) {
  const double end_value = f.alpha + f.beta + f.gamma;
  if (std::abs(f.gamma) <= d.start_value || std::abs(end_value) <= d.end_value) return false;
  if (f.gamma < 0 || end_value < 0) return true;
  const double delta = f.beta * f.beta - 4 * f.alpha * f.gamma;
  if (std::abs(delta) <= d.discriminant) return false;
  const double end_slope = f.alpha + f.alpha + f.beta;
  return delta < 0 || (std::abs(f.beta) > d.start_slope && std::abs(end_slope) > d.end_slope);
}

/// Whether "hit" or "free" is the answer of exact arithmetic.
inline bool is_hit_certain(const ParameterForm<double>& f, const ParameterRounding& d) {
  const double end_value = f.alpha + f.beta + f.gamma;
  if (f.gamma < -d.start_value || end_value < -d.end_value) return true;
  const bool outside = f.gamma > d.start_value && end_value > d.end_value;
  const bool turned_away = f.beta > d.start_slope || f.alpha + f.alpha + f.beta < -d.end_slope;
  return is_certain(f, d) || (outside && turned_away);
}

}  // namespace bqsa
