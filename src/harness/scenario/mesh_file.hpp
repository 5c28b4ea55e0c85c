/// @file
/// Triangle meshes as users have them: STL, OBJ, PLY, Collada and what else Assimp reads.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bqsa/envelope/convex_hull.hpp"

namespace bqsa::harness {

/// A connected piece of a mesh, taken as the solid convex hull of its vertices.
struct MeshPart {
  ConvexHull hull;  ///< lengths as in the file, of Collada in metres; flat if the vertices are

  /// Volume that the triangles enclose; none unless they are a closed surface, each edge in two
  /// triangles of the same sense. Where it is less than the hull's, the part is not convex.
  std::optional<double> volume;
};

/// The parts of a mesh, in the order of their first vertices. Triangles are connected by corners in
/// the same place, or nearer than 1e-6 of the largest coordinate to the first corner there; polygons are triangulated, points and lines left out, the places of a scene's
/// nodes applied. Since a part counts as solid as its hull, triangles may leave holes, turn either
/// way or share an edge by threes.
///
/// Assimp keeps coordinates in single precision, and so does what is read. It reads in a process of
/// its own, so that a file that crashes it is an error as others.
///
/// @param name  of the file, for messages; its ending tells the format
/// @param text  its bytes; files that it names in turn (materials, textures) are not looked for
/// @throws InputError naming the file if its ending is unknown, it cannot be read, or has no
///   triangle, coordinates that are not finite, more than 2e6 triangles or more than 1000 parts
std::vector<MeshPart> read_mesh(const std::string& name, const std::string& text);

/// Whether files of this ending state their unit, so that what is read is in metres: Collada.
bool states_unit(const std::string& name);

}  // namespace bqsa::harness
