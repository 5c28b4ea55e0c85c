/// @file
/// Solids as triangles, to be drawn.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "bqsa/envelope/solid.hpp"

namespace bqsa::harness::report {

/// A closed surface; round ones have corners on the surface, 32 around the axis.
struct SolidMesh {
  std::vector<Eigen::Vector3d> vertices;      ///< [m]
  std::vector<std::array<int, 3>> triangles;  ///< counterclockwise from outside
};

SolidMesh mesh_of(const Solid& solid);

}  // namespace bqsa::harness::report
