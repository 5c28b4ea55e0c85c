/// @file
/// The ellipsoid of least volume around a solid: closed forms where there are any.
#pragma once

#include "bqsa/envelope/solid.hpp"
#include "bqsa/geometry/ellipsoid.hpp"

namespace bqsa {

/// The ellipsoid of least volume around the solid, its semi-axes grown to the least one asked for.
///
/// There is only one, so that it has the symmetries of the solid: their centre and axes are its own.
/// What remains is the choice of lengths:
///
/// - box of half lengths h: semi-axes sqrt(3) h.
/// - cylinder of radius r, half length l: sqrt(3/2) r across, sqrt(3) l along. (Semi-axes A, A, C
///   contain it if r²/A² + l²/C² <= 1; of those, A² C is least where the terms are 2/3 and 1/3.)
/// - capsule of radius r, half length l of the segment: with s = l + sqrt(l² + 3 r²)
///
///       A² = r² (1 + l/s),   C² = (l + s) (l + r²/s).
///
///   By support functions it is inside if A² (1 - x²) + C² x² >= (l x + r)² for the normals' cosines
///   0 <= x <= 1. With k = C² - A² - l² the difference of both sides is least at x = l r/k, and zero
///   there if A² = r² (1 + l²/k). A⁴ C² of these is least at k = l s.
/// - hull: least_ellipsoid.hpp, volume gap 1e-6.
///
/// *It contains the solid, in exact arithmetic.* Its centre and axes are rounded, so that the solid
/// lies within a distance delta of one placed exactly: the frame's departure from orthonormality
/// and 16 roundings, times the size and distance from the origin; for a hull its deviation. A ball
/// of that radius fits into the ellipsoid scaled by delta / (shortest semi-axis), so that the
/// ellipsoid scaled by one plus that contains both. `slack` adds to delta.
///
/// @param least_semi_axis  as in LeastEllipsoidSettings [m]
/// @param slack            distance from the solid within which points are to be contained, too [m]
/// @throws std::invalid_argument for a solid that `check` refuses, or a flat hull without a least
///   semi-axis
Ellipsoid least_ellipsoid_around(const Solid& solid, double least_semi_axis = 0, double slack = 0);

}  // namespace bqsa
