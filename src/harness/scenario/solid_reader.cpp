#include "harness/scenario/solid_reader.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

#include "harness/numeric_csv.hpp"
#include "harness/scenario/mesh_file.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t kMaxFileBytes = std::size_t{1} << 24;
constexpr std::size_t kMaxPoints = 100'000;

/// Each question of the judge looks at all corners, and each division of the solid at all edges.
constexpr std::size_t kMaxCorners = 2'000;
constexpr std::size_t kMaxCornersInAll = 10'000;

/// Where the frame that a solid is described in lies in W.
struct Placement {
  Vector3d center = Vector3d::Zero();
  Matrix3d rotation = Matrix3d::Identity();

  Vector3d operator()(const Vector3d& p) const { return center + rotation * p; }
};

Placement read_placement(const YamlValue& value, const Units& units, bool center_required) {
  const Matrix3d rotation = find_rotation(value, units).value_or(Matrix3d::Identity());
  if (!center_required && !value.has("center")) return {Vector3d::Zero(), rotation};
  return {units.point(value.get("center", "a point"), 3), rotation};
}

SolidDescription read_box(const YamlValue& value, const Units& units) {
  value.expect_keys({"name", "kind", "center", "size", "rpy", "quaternion", "motion", "envelope"});
  const Placement placed = read_placement(value, units, true);
  const Vector3d size = units.positive_lengths(value.get("size", "3 positive lengths"), 3);
  return {{Box{placed.center, size / 2, placed.rotation}}};
}

/// A cylinder or a capsule, along z of its own frame.
template <typename Revolved>
SolidDescription read_revolved(const YamlValue& value, const Units& units) {
  value.expect_keys(
      {"name", "kind", "center", "radius", "length", "rpy", "quaternion", "motion", "envelope"});
  const Placement placed = read_placement(value, units, true);
  const double radius = units.positive_length(value.get("radius", "a positive length"));
  const double length = units.positive_length(value.get("length", "a positive length"));
  const Vector3d half = length / 2 * Vector3d::UnitZ();
  return {{Revolved{placed(-half), placed(half), radius}}};
}

/// A hull thinner than any length may be could pass unhit through the judge's touching band. It
/// becomes a plate, twice as thick as the least length.
ConvexHull thickened(ConvexHull hull) {
  double thickness = std::numeric_limits<double>::infinity();
  Vector3d across = Vector3d::Zero();
  for (const std::array<int, 3>& triangle : hull.triangles) {
    const auto corner = [&](std::size_t k) -> const Vector3d& {
      return hull.vertices[static_cast<std::size_t>(triangle[k])];
    };
    const Vector3d normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).stableNormalized();
    double low = 0, high = 0;
    for (const Vector3d& p : hull.vertices) {
      low = std::min(low, normal.dot(p - corner(0)));
      high = std::max(high, normal.dot(p - corner(0)));
    }
    if (high - low >= thickness) continue;
    thickness = high - low;
    across = normal;
  }
  if (thickness >= kMinLength) return hull;
  std::vector<Vector3d> points;
  for (const Vector3d& p : hull.vertices) {
    points.emplace_back(p - kMinLength * across);
    points.emplace_back(p + kMinLength * across);
  }
  return convex_hull(points);
}

/// The hull of points in W, refused by the value where they come from.
/// @param what  they are, for messages
ConvexHull hull_of(const YamlValue& value, const std::vector<Vector3d>& points,
                   const std::string& what, const Units& units) {
  for (const Vector3d& p : points) {
    if (!(p.cwiseAbs().maxCoeff() <= kMaxLength)) {
      value.fail("coordinates of at most " + units.show(kMaxLength), units.show(p, 3));
    }
  }
  ConvexHull hull = convex_hull(points);
  if (hull.span < 2) {
    value.fail(what + " that span a plane or more", hull.span == 1 ? "a line" : "one place");
  }
  if (hull.vertices.size() > kMaxCorners) {
    value.fail(fmt::format("{} with a convex hull of at most {} corners", what, kMaxCorners),
               std::to_string(hull.vertices.size()));
  }
  return thickened(std::move(hull));
}

double read_scale(const YamlValue& value) {
  const std::optional<YamlValue> scale = value.find("scale");
  if (!scale) return 1;
  const double factor = scale->number();
  if (!(factor > 0)) scale->fail("a positive number");
  return factor;
}

SolidDescription read_mesh_solid(const YamlValue& value, const Units& units, NamedFiles& files) {
  value.expect_keys(
      {"name", "kind", "file", "scale", "center", "rpy", "quaternion", "motion", "envelope"});
  const Placement placed = read_placement(value, units, false);
  const double factor = read_scale(value) / units.per_metre;
  const YamlValue named = value.get("file", "a mesh file");
  const NamedFiles::File file = files.read(named, kMaxFileBytes);
  SolidDescription solid;
  std::size_t corners = 0;
  double hulls = 0, enclosed = 0;
  bool closed = true;
  for (const MeshPart& part : read_mesh(file.name, file.text)) {
    std::vector<Vector3d> points;
    for (const Vector3d& corner : part.hull.vertices) points.push_back(placed(factor * corner));
    ConvexHull hull = hull_of(named, points, "parts of a mesh", units);
    corners += hull.vertices.size();
    hulls += volume(part.hull);
    enclosed += part.volume.value_or(0);
    closed = closed && part.volume.has_value();
    solid.parts.emplace_back(std::move(hull));
  }
  if (corners > kMaxCornersInAll) {
    named.fail(fmt::format("parts of a mesh with at most {} corners in all", kMaxCornersInAll),
               std::to_string(corners));
  }
  if (closed && enclosed > 0) solid.hull_over_mesh = hulls / enclosed;
  return solid;
}

std::vector<Vector3d> read_point_file(const YamlValue& value, const Units& units,
                                      NamedFiles& files) {
  const NamedFiles::File file = files.read(value, kMaxFileBytes);
  const NumericTable table = parse_numeric_csv(file.name, file.text, {"x,y,z"});
  if (table.rows() > kMaxPoints) {
    value.fail(fmt::format("a file of at most {} points", kMaxPoints),
               std::to_string(table.rows()));
  }
  std::vector<Vector3d> points;
  points.reserve(table.rows());
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const Vector3d p(table(row, 0), table(row, 1), table(row, 2));
    if (!p.allFinite()) {
      throw InputError(fmt::format("{}:{}: expected finite coordinates, got one that is not",
                                   file.name, NumericTable::line(row)));
    }
    points.emplace_back(p / units.per_metre);
  }
  return points;
}

SolidDescription read_points(const YamlValue& value, const Units& units, NamedFiles& files) {
  value.expect_keys(
      {"name", "kind", "points", "file", "center", "rpy", "quaternion", "motion", "envelope"});
  const Placement placed = read_placement(value, units, false);
  const std::optional<YamlValue> list = value.find("points");
  const std::optional<YamlValue> named = value.find("file");
  if (list && named) named->fail("either points or file", "both");
  std::vector<Vector3d> points;
  if (named) {
    points = read_point_file(*named, units, files);
  } else {
    for (const YamlValue& point : value.get("points", "a list of points, or file").list("points")) {
      points.push_back(units.point(point, 3));
    }
  }
  const YamlValue& source = named ? *named : *list;
  if (points.empty()) source.fail("points that span a plane or more", "none");
  for (Vector3d& p : points) p = placed(p);
  return {{hull_of(source, points, "points", units)}};
}

}  // namespace

SolidDescription read_solid(const YamlValue& value, std::string_view kind, const Units& units,
                            NamedFiles& files) {
  if (kind == "box") return read_box(value, units);
  if (kind == "cylinder") return read_revolved<Cylinder>(value, units);
  if (kind == "capsule") return read_revolved<Capsule>(value, units);
  if (kind == "mesh") return read_mesh_solid(value, units, files);
  return read_points(value, units, files);
}

}  // namespace bqsa::harness
