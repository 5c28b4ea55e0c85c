/// @file
/// Convex solids as users describe them, and how to divide them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <variant>

#include "bqsa/envelope/convex_hull.hpp"

namespace bqsa {

// All in the frame W, lengths in metres.

struct Ball {
  Eigen::Vector3d center;
  double radius;
};

struct Box {
  Eigen::Vector3d center;
  Eigen::Vector3d half_lengths;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< columns are the edges' directions
};

/// Flat ends at `a` and `b`.
struct Cylinder {
  Eigen::Vector3d a, b;
  double radius;
};

/// All points within the radius of the segment from `a` to `b`, which may be one point.
struct Capsule {
  Eigen::Vector3d a, b;
  double radius;
};

using Solid = std::variant<Ball, Box, Cylinder, Capsule, ConvexHull>;

/// @throws std::invalid_argument if a length is not positive and finite, a position not finite, a
///   rotation not orthonormal and right-handed, or a hull empty
void check(const Solid& solid);

/// [m³]; 0 for a flat hull.
double volume(const Solid& solid);

/// The point of the solid that is furthest in the direction n.
Eigen::Vector3d support_point(const Solid& solid, const Eigen::Vector3d& n);

/// A solid, and how far beyond it points belong to it: what it replaces is within this distance of
/// it.
struct Part {
  Solid solid;
  double slack = 0;  ///< [m]
};

/// Whether `halves` makes two of it: not of a ball, which is its own least ellipsoid, nor of a
/// point.
bool divisible(const Solid& solid);

/// Two parts that together contain all points within `slack` of the solid, divided across
/// `direction` in the middle of its extent. Capsules and (if the direction is nearer to their axis
/// than to their radius) cylinders become shorter ones. Others become hulls, a cylinder one with 64
/// sides around it.
///
/// *What is lost of a hull*, by rounding and since its edges are those of the corners on the grid,
/// is added to the slack. With e the error of a corner's height above the plane, from both, a point
/// of the hull that is 2 e below the plane is in the hull of the lower part: it is a mixture of
/// corners below and points of edges that are 2 e below the plane, and of each such edge the lower
/// part has the lower end and either the upper one or a point further up. A point less than that
/// below the plane, moved by 2 e / (half the extent) of its way to the lowest point, becomes such a
/// one.
/// @throws std::invalid_argument for a solid that is not divisible, or does not extend along the
///   direction
std::array<Part, 2> halves(const Part& part, const Eigen::Vector3d& direction);

}  // namespace bqsa
