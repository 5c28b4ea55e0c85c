/// @file
/// The ellipse as the paper writes it: six conic coefficients (paper, Eq. 2).
#pragma once

#include "bqsa/geometry/ellipsoid.hpp"

namespace bqsa {

/// G(x, y) = A x² + B xy + C y² + D x + E y + F, negative inside the ellipse.
/// A, C > 0 and 4AC > B². Templated so that an instrumented scalar can count operations.
template <typename Scalar>
struct Conic {
  Scalar A, B, C;  ///< [1/m²]
  Scalar D, E;     ///< [1/m]
  Scalar F;        ///< [-]
};

/// The coefficients of an ellipse, scaled so that G equals Ellipse::level.
Conic<double> conic_from_ellipse(const Ellipse& ellipse);

/// The ellipse of given coefficients; any positive multiple of them gives the same ellipse.
/// @throws std::invalid_argument if they do not describe a real ellipse that is negative inside
Ellipse ellipse_from_conic(const Conic<double>& conic);

}  // namespace bqsa
