/// @file
/// Obstacles as they are, where methods are told of ellipsoids around them.
#pragma once

#include <string>
#include <vector>

#include "bqsa/envelope/solid.hpp"
#include "bqsa/problem.hpp"

namespace bqsa::harness {

/// What the judge goes by. No method sees it.
struct TrueObstacle {
  std::string name;  ///< the user's; that of an ellipsoid around a solid may have a number behind

  /// Convex solids at t = 0 that are the obstacle together. None: it is the ellipsoid that methods
  /// are told of, neither more nor less.
  std::vector<Solid> parts = {};

  int first = 0;  ///< of the ellipsoids around it, an index into Problem::obstacles
  int count = 1;  ///< of these ellipsoids, one after the other

  bool is_ellipsoid() const { return parts.empty(); }
};

/// Of a problem whose obstacles are the ellipsoids that methods are told of.
std::vector<TrueObstacle> ellipsoids_as_told(const Problem& problem);

}  // namespace bqsa::harness
