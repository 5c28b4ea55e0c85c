/// @file
/// How far an envelope reaches beyond what it envelopes.
#pragma once

#include "bqsa/envelope/solid.hpp"
#include "bqsa/geometry/ellipsoid.hpp"

namespace bqsa {

/// The largest distance of a point of the ellipsoid from the solid, from above: at most `accuracy`
/// too much [m]. 0 if the ellipsoid lies within the solid.
///
/// For convex bodies it is the largest h_E(n) - h_K(n) over unit vectors n, h being support
/// functions. Branch and bound over the sphere of normals, in triangles: with v any point of K,
/// here the one furthest along the middle of the triangle, g(n) = h_E(n) - n·v is no less than the
/// difference, convex and homogeneous, so that within the triangle g is at most the largest of its
/// corners' values, divided by the plane's distance from the origin if that is positive.
///
/// @param accuracy  positive [m]; not reached if that would take more than 2e5 triangles
double largest_inflation(const Ellipsoid& ellipsoid, const Solid& solid, double accuracy);

}  // namespace bqsa
