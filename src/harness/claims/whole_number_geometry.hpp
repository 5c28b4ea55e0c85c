/// @file
/// Segments and ellipsoids in whole numbers, where every question has an exact answer.
#pragma once

#include <array>
#include <random>

#include "bqsa/geometry/paper_form.hpp"
#include "bqsa/geometry/segment_test.hpp"

namespace bqsa::harness::claims {

__extension__ typedef __int128 Whole;  // the alias form does not silence -Wpedantic

template <int Dim>
using WholeVector = std::array<Whole, Dim>;

/// The solid ellipsoid {p : |L⁻¹ (p - c)| <= 1} of a lower triangular L of small whole numbers, its
/// diagonal positive. Up to scale and rounding every ellipsoid is one.
template <int Dim>
struct WholeEllipsoid {
  std::array<WholeVector<Dim>, Dim> L;
  WholeVector<Dim> center;
};

/// L⁻¹ (p - c) times det L, by forward substitution. In these coordinates the ellipsoid is the ball of
/// radius det L.
template <int Dim>
WholeVector<Dim> ball_point(const WholeEllipsoid<Dim>& ellipsoid, const WholeVector<Dim>& p) {
  Whole determinant = 1;
  for (int row = 0; row < Dim; ++row) determinant *= ellipsoid.L[row][row];
  WholeVector<Dim> u{};
  for (int row = 0; row < Dim; ++row) {
    Whole rest = determinant * (p[row] - ellipsoid.center[row]);
    for (int col = 0; col < row; ++col) rest -= ellipsoid.L[row][col] * u[col];
    u[row] = rest / ellipsoid.L[row][row];  // leaves no remainder: det L L⁻¹ is whole
  }
  return u;
}

template <int Dim>
Whole ball_radius(const WholeEllipsoid<Dim>& ellipsoid) {
  Whole determinant = 1;
  for (int row = 0; row < Dim; ++row) determinant *= ellipsoid.L[row][row];
  return determinant;
}

template <int Dim>
Whole product(const WholeVector<Dim>& a, const WholeVector<Dim>& b) {
  Whole sum = 0;
  for (int k = 0; k < Dim; ++k) sum += a[k] * b[k];
  return sum;
}

/// How a segment lies to a ball around 0, told by distances: no quadratic is formed.
struct BallPosition {
  int ends_inside;      ///< or on the surface: 0 to 2
  bool meets;           ///< the segment meets the solid ball
  bool touches;         ///< meets it only on its surface
  bool line_enters;     ///< the segment's line enters the inside of the ball
  bool end_on_surface;  ///< of either end

  /// The category that this is by definition.
  Category category() const {
    if (ends_inside == 2) return Category::kContained;
    if (ends_inside == 1) return Category::kOneEndInside;
    if (meets) return Category::kCrossing;
    return line_enters ? Category::kNoCollision2 : Category::kNoCollision1;
  }
};

template <int Dim>
BallPosition ball_position(const WholeVector<Dim>& u1, const WholeVector<Dim>& u2, Whole radius) {
  WholeVector<Dim> v{};
  for (int k = 0; k < Dim; ++k) v[k] = u2[k] - u1[k];
  const Whole r2 = radius * radius;
  const Whole first = product<Dim>(u1, u1), second = product<Dim>(u2, u2);
  const Whole length2 = product<Dim>(v, v), along = product<Dim>(u1, v);
  const Whole area2 = first * length2 - along * along;  // area2 / length2: distance² of the line
  const bool foot_between = along < 0 && along + length2 > 0;
  const Whole nearest = area2 - r2 * length2;  // sign of the line's distance less the radius
  const bool meets = first <= r2 || second <= r2 || (foot_between && nearest <= 0);
  const bool inside = first < r2 || second < r2 || (foot_between && nearest < 0);
  return {.ends_inside = (first <= r2) + (second <= r2),
          .meets = meets,
          .touches = meets && !inside,
          .line_enters = length2 > 0 && nearest < 0,
          .end_on_surface = first == r2 || second == r2};
}

/// The library's own polar form, for numbers without rounding.
template <int Dim>
PolarForm<Whole> polar_form_of(const WholeVector<Dim>& u1, const WholeVector<Dim>& u2,
                               Whole radius) {
  const Whole r2 = radius * radius;
  return {product<Dim>(u1, u1) - r2, product<Dim>(u1, u2) - r2, product<Dim>(u2, u2) - r2};
}

/// Polar form of the projections on the plane of coordinates k and l: of the segment, and of the
/// ellipsoid, whose shadow has the matrix of rows and columns k and l of L Lᵀ (Lemma 1).
inline PolarForm<Whole> shadow_polar_form(const WholeEllipsoid<3>& ellipsoid, int k, int l,
                                          const WholeVector<3>& p1, const WholeVector<3>& p2) {
  const auto covariance = [&](int i, int j) { return product<3>(ellipsoid.L[i], ellipsoid.L[j]); };
  const Whole kk = covariance(k, k), kl = covariance(k, l), ll = covariance(l, l);
  const Whole determinant = kk * ll - kl * kl;
  const auto level = [&](const WholeVector<3>& a, const WholeVector<3>& b) {
    const Whole ak = a[k] - ellipsoid.center[k], al = a[l] - ellipsoid.center[l];
    const Whole bk = b[k] - ellipsoid.center[k], bl = b[l] - ellipsoid.center[l];
    return ak * (ll * bk - kl * bl) + al * (kk * bl - kl * bk) - determinant;
  };
  return {level(p1, p1), level(p1, p2), level(p2, p2)};
}

/// The ellipse in the paper's six coefficients.
inline Conic<Whole> conic_of(const WholeEllipsoid<2>& ellipse) {
  const Whole kk = product<2>(ellipse.L[0], ellipse.L[0]);
  const Whole kl = product<2>(ellipse.L[0], ellipse.L[1]);
  const Whole ll = product<2>(ellipse.L[1], ellipse.L[1]);
  const Whole x = ellipse.center[0], y = ellipse.center[1];
  const Whole A = ll, B = -2 * kl, C = kk;
  return {.A = A,
          .B = B,
          .C = C,
          .D = -(2 * A * x + B * y),
          .E = -(B * x + 2 * C * y),
          .F = A * x * x + B * x * y + C * y * y - (kk * ll - kl * kl)};
}

/// Whole numbers from -half_width to half_width.
template <int Dim>
WholeVector<Dim> random_point(std::mt19937_64& generator, int half_width) {
  const auto range = 2 * static_cast<std::uint64_t>(half_width) + 1;
  WholeVector<Dim> point;
  for (Whole& coordinate : point) {
    coordinate = static_cast<Whole>(generator() % range) - half_width;
  }
  return point;
}

/// Around the origin, of entries up to `size`.
template <int Dim>
WholeEllipsoid<Dim> random_ellipsoid(std::mt19937_64& generator, int size) {
  WholeEllipsoid<Dim> ellipsoid{};
  for (int row = 0; row < Dim; ++row) {
    const WholeVector<Dim> entries = random_point<Dim>(generator, size);
    for (int col = 0; col < row; ++col) ellipsoid.L[row][col] = entries[col];
    ellipsoid.L[row][row] = 1 + static_cast<Whole>(generator() % static_cast<std::uint64_t>(size));
  }
  return ellipsoid;
}

}  // namespace bqsa::harness::claims
