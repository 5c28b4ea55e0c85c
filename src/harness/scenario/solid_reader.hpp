/// @file
/// The keys of obstacles that are solids: box, cylinder, capsule, mesh and points.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bqsa/envelope/solid.hpp"
#include "harness/scenario/units.hpp"
#include "harness/scenario/waypoint_file.hpp"
#include "harness/scenario/yaml_value.hpp"

namespace bqsa::harness {

/// A solid as its keys describe it, in W.
struct SolidDescription {
  std::vector<Solid> parts;                   ///< convex; together the solid
  std::optional<double> hull_over_mesh = {};  ///< LedgerEntry::hull_over_mesh
};

/// Reads a solid of one of these kinds. Of points and of each part of a mesh that hangs together the
/// convex hull counts; it may be flat, and is then a plate of 0.02 mm, but not a line or a point, and has at most 2000 corners, those
/// of a mesh's parts at most 10,000. Files have at most 16 MiB and a point set at most 100,000
/// points.
SolidDescription read_solid(const YamlValue& value, std::string_view kind, const Units& units,
                            NamedFiles& files);

}  // namespace bqsa::harness
