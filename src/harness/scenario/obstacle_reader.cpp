#include "harness/scenario/obstacle_reader.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace bqsa::harness {
namespace {

constexpr std::size_t kMaxObstacles = 1000;

/// Largest ratio of two semi-axes. Up to here the judge's two checkers were seen to agree.
constexpr double kMaxAxisRatio = 1e6;

Eigen::VectorXd read_semi_axes(const YamlValue& value, const Units& units, int size) {
  const YamlValue list = value.get("semi_axes", fmt::format("{} positive lengths", size));
  Eigen::VectorXd semi_axes = units.positive_lengths(list, size);
  const double ratio = semi_axes.maxCoeff() / semi_axes.minCoeff();
  if (ratio > kMaxAxisRatio * (1 + 1e-9)) {
    list.fail(fmt::format("semi-axes of which the longest is at most {:g} times the shortest",
                          kMaxAxisRatio),
              fmt::format("{:g} times", ratio));
  }
  return semi_axes;
}

Ellipsoid read_ellipse(const YamlValue& value, const Units& units) {
  value.expect_keys({"name", "kind", "center", "semi_axes", "rotation"});
  const Eigen::Vector3d center = units.point(value.get("center", "a point"), 2);
  const Eigen::VectorXd semi_axes = read_semi_axes(value, units, 2);
  const std::optional<YamlValue> given = value.find("rotation");
  const double rotation = given ? units.angle(*given) : 0.0;
  return embedded(rotated_ellipse(center.head<2>(), semi_axes, rotation));
}

Ellipsoid read_ellipsoid(const YamlValue& value, const Units& units) {
  value.expect_keys({"name", "kind", "center", "semi_axes", "rpy", "quaternion"});
  const Eigen::Vector3d center = units.point(value.get("center", "a point"), 3);
  const Eigen::VectorXd semi_axes = read_semi_axes(value, units, 3);
  const std::optional<YamlValue> rpy = value.find("rpy");
  const std::optional<YamlValue> quaternion = value.find("quaternion");
  if (rpy && quaternion) quaternion->fail("either rpy or quaternion", "both");
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  if (rpy) rotation = read_rpy(*rpy, units);
  if (quaternion) rotation = read_quaternion(*quaternion);
  return {center, semi_axes, rotation};
}

Ellipsoid read_sphere(const YamlValue& value, const Units& units) {
  value.expect_keys({"name", "kind", "center", "radius"});
  const double radius = units.positive_length(value.get("radius", "a positive length"));
  return {units.point(value.get("center", "a point"), 3), Eigen::Vector3d::Constant(radius)};
}

std::string read_kind(const YamlValue& kind, int dimension) {
  const std::initializer_list<std::string_view> later = {"box", "cylinder", "capsule", "mesh",
                                                         "points"};
  if (dimension == 2) {
    if (kind.is("ellipsoid") || kind.is("sphere")) kind.fail("ellipse, since the robot is planar");
    return kind.choice({"ellipse"}, later);
  }
  if (kind.is("ellipse")) kind.fail("ellipsoid or sphere, since the robot is spatial");
  return kind.choice({"ellipsoid", "sphere"}, later);
}

Ellipsoid read_shape(const YamlValue& value, const Units& units, int dimension) {
  const YamlValue kind = value.get("kind", "the kind of the obstacle");
  const std::string word = read_kind(kind, dimension);
  if (const std::optional<YamlValue> motion = value.find("motion")) {
    motion->fail("an obstacle at rest", "a motion, which is not supported yet");
  }
  if (word == "ellipse") return read_ellipse(value, units);
  return word == "sphere" ? read_sphere(value, units) : read_ellipsoid(value, units);
}

}  // namespace

std::vector<Obstacle> read_obstacles(const YamlValue& value, const Units& units, int dimension) {
  const std::vector<YamlValue> elements = value.list("a list of obstacles");
  if (elements.size() > kMaxObstacles) {
    value.fail(fmt::format("at most {} obstacles", kMaxObstacles), std::to_string(elements.size()));
  }
  std::vector<Obstacle> obstacles;
  std::set<std::string> names;
  for (const YamlValue& element : elements) {
    const YamlValue name = element.get("name", "a name");
    if (!names.insert(name.name()).second) name.fail("a name that no other obstacle has");
    obstacles.push_back({name.name(), read_shape(element, units, dimension)});
  }
  return obstacles;
}

}  // namespace bqsa::harness
