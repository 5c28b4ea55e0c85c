/// @file
/// A solid as ellipsoids: one, or several where one would be too large; and what that costs.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "bqsa/envelope/solid.hpp"
#include "bqsa/geometry/ellipsoid.hpp"

namespace bqsa {

struct CoverSettings {
  double inflation = std::numeric_limits<double>::infinity();     ///< aimed at, at most [m]
  double volume_ratio = std::numeric_limits<double>::infinity();  ///< aimed at, at most [-]
  int max_ellipsoids = 1;
  double least_semi_axis = 0;  ///< no semi-axis is shorter; flat solids need it [m]
  double margin = 0;           ///< points this near to the solid are contained, too [m]
};

/// Ellipsoids that together contain every point of a solid, with their entry in the geometry
/// ledger.
struct Cover {
  std::vector<Ellipsoid> ellipsoids;

  /// No point of the ellipsoids is further from the solid [m]: a motion past the solid that keeps
  /// this clearance clears the ellipsoids, and a gap between two solids narrows by at most the sum
  /// of their inflations. Where the radius of links grows the ellipsoids, `largest_excess_around`
  /// (bqsa/batch/ellipsoid_around.hpp) comes on top.
  double inflation = 0;

  /// Volumes of all ellipsoids together, over that of the solid [-]. Infinite for a flat solid.
  double volume_ratio = 0;

  bool within_bounds =
      true;  ///< or max_ellipsoids, or a part that is not divisible or is in an ellipsoid with
             ///< least semi-axes alone, ended the division
};

/// Starts with one ellipsoid. While a bound is exceeded and another ellipsoid allowed, the one that
/// inflates most is replaced (if only the volume is too large: the one with most volume beyond its
/// part): its part of the solid is divided across the ellipsoid's longest axis, in the middle of
/// the part. Parts are solid, so that the pieces cover the inside and all of the surface.
/// Inflations are known to 1e-3 of the longest semi-axis.
///
/// @throws std::invalid_argument for a solid that `check` refuses, a flat one without a least
///   semi-axis, bounds that are not positive, a negative margin or less than one ellipsoid
Cover cover(const Solid& solid, const CoverSettings& settings = {});

}  // namespace bqsa
