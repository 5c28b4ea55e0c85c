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

/// Three corners of a hull that span it well in its plane: far apart, and the third far from the line
/// through the others.
struct WideTriangle {
  Vector3d from, to, aside;

  explicit WideTriangle(const std::vector<Vector3d>& points) : from(points.front()) {
    const auto furthest = [&](auto distance) {
      return *std::ranges::max_element(points, {}, distance);
    };
    from = furthest([&](const Vector3d& p) { return (p - points.front()).squaredNorm(); });
    to = furthest([&](const Vector3d& p) { return (p - from).squaredNorm(); });
    aside = furthest([&](const Vector3d& p) { return height(p); });
  }

  double length() const { return (to - from).norm(); }

  /// Distance of a point from the line.
  double height(const Vector3d& p) const {
    const Vector3d along = (to - from).stableNormalized();
    return (p - from - along.dot(p - from) * along).norm();
  }

  Vector3d normal() const {
    const Vector3d along = (to - from).stableNormalized();
    const Vector3d up = aside - from - along.dot(aside - from) * along;
    return along.cross(up).stableNormalized();
  }
};

struct Thickness {
  double length = std::numeric_limits<double>::infinity();
  Vector3d across = Vector3d::Zero();
};

/// The least extent across one of the hull's triangles, or across its widest one.
Thickness thickness_of(const ConvexHull& hull) {
  Thickness least;
  const auto try_across = [&](const Vector3d& normal) {
    if (!(normal.squaredNorm() > 0)) return;  // of a triangle that rounding has left without height
    double low = 0, high = 0;
    for (const Vector3d& p : hull.vertices) {
      const double height = normal.dot(p - hull.vertices.front());
      low = std::min(low, height);
      high = std::max(high, height);
    }
    if (high - low < least.length) least = {high - low, normal};
  };
  try_across(WideTriangle(hull.vertices).normal());
  for (const std::array<int, 3>& triangle : hull.triangles) {
    const auto corner = [&](std::size_t k) -> const Vector3d& {
      return hull.vertices[static_cast<std::size_t>(triangle[k])];
    };
    try_across((corner(1) - corner(0)).cross(corner(2) - corner(0)).stableNormalized());
  }
  return least;
}

/// A hull thinner than any length may be could pass unhit through the judge's touching band. It
/// becomes a plate, twice as thick as the least length. One that is no line is not thin in a second
/// direction.
ConvexHull thickened(ConvexHull hull) {
  const Thickness thickness = thickness_of(hull);
  if (thickness.length >= kMinLength) return hull;
  std::vector<Vector3d> points;
  for (const Vector3d& p : hull.vertices) {
    points.emplace_back(p - kMinLength * thickness.across);
    points.emplace_back(p + kMinLength * thickness.across);
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
  // Points on a slanted line are on it up to rounding.
  const WideTriangle widest(hull.vertices.empty() ? points : hull.vertices);
  if (hull.span < 2 || widest.height(widest.aside) < kMinLength) {
    value.fail(what + " that span a plane or more",
               widest.length() < kMinLength ? "one place" : "a line");
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
  const double scale = read_scale(value);
  const YamlValue named = value.get("file", "a mesh file");
  const NamedFiles::File file = files.read(named, kMaxFileBytes);
  const double factor = scale / (states_unit(file.name) ? 1 : units.per_metre);
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
