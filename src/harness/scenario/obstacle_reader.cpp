#include "harness/scenario/obstacle_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "harness/scenario/motion_reader.hpp"

namespace bqsa::harness {
namespace {

constexpr std::size_t kMaxObstacles = 1000;

/// Moving obstacles times ticks: a state of an obstacle takes 200 bytes.
constexpr std::size_t kMaxStates = 1'000'000;

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

RestingObstacle read_ellipse(const YamlValue& value, const Units& units) {
  value.expect_keys({"name", "kind", "center", "semi_axes", "rotation", "motion"});
  const Eigen::Vector3d center = units.point(value.get("center", "a point"), 2);
  const Eigen::VectorXd semi_axes = read_semi_axes(value, units, 2);
  const std::optional<YamlValue> given = value.find("rotation");
  const double rotation = given ? units.angle(*given) : 0.0;
  return {embedded(rotated_ellipse(center.head<2>(), semi_axes, rotation)), given.has_value()};
}

RestingObstacle read_ellipsoid(const YamlValue& value, const Units& units) {
  value.expect_keys({"name", "kind", "center", "semi_axes", "rpy", "quaternion", "motion"});
  const Eigen::Vector3d center = units.point(value.get("center", "a point"), 3);
  const Eigen::VectorXd semi_axes = read_semi_axes(value, units, 3);
  const std::optional<YamlValue> rpy = value.find("rpy");
  const std::optional<YamlValue> quaternion = value.find("quaternion");
  if (rpy && quaternion) quaternion->fail("either rpy or quaternion", "both");
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  if (rpy) rotation = read_rpy(*rpy, units);
  if (quaternion) rotation = read_quaternion(*quaternion);
  return {Ellipsoid(center, semi_axes, rotation), rpy || quaternion};
}

RestingObstacle read_sphere(const YamlValue& value, const Units& units) {
  value.expect_keys({"name", "kind", "center", "radius", "motion"});
  const double radius = units.positive_length(value.get("radius", "a positive length"));
  const Eigen::Vector3d center = units.point(value.get("center", "a point"), 3);
  return {Ellipsoid(center, Eigen::Vector3d::Constant(radius)), false};
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

RestingObstacle read_shape(const YamlValue& value, const Units& units, int dimension) {
  const YamlValue kind = value.get("kind", "the kind of the obstacle");
  const std::string word = read_kind(kind, dimension);
  if (word == "ellipse") return read_ellipse(value, units);
  return word == "sphere" ? read_sphere(value, units) : read_ellipsoid(value, units);
}

}  // namespace

std::vector<Obstacle> read_obstacles(const YamlValue& value, const Units& units, int dimension,
                                     const Task& task, NamedFiles& files) {
  const std::vector<YamlValue> elements = value.list("a list of obstacles");
  if (elements.size() > kMaxObstacles) {
    value.fail(fmt::format("at most {} obstacles", kMaxObstacles), std::to_string(elements.size()));
  }
  const auto moving = static_cast<std::size_t>(
      std::count_if(elements.begin(), elements.end(),
                    [](const YamlValue& element) { return element.has("motion"); }));
  const std::size_t states = moving * static_cast<std::size_t>(task.ticks);
  if (states > kMaxStates) {
    value.fail(fmt::format("moving obstacles times ticks of at most {}", kMaxStates),
               fmt::format("{} times {}", moving, task.ticks));
  }
  std::vector<Obstacle> obstacles;
  std::set<std::string> names;
  for (const YamlValue& element : elements) {
    const YamlValue name = element.get("name", "a name");
    if (!names.insert(name.name()).second) name.fail("a name that no other obstacle has");
    const RestingObstacle at_rest = read_shape(element, units, dimension);
    Obstacle obstacle{name.name(), at_rest.shape};
    if (const std::optional<YamlValue> motion = element.find("motion")) {
      obstacle.motion = read_motion(*motion, at_rest, units, dimension, task, files);
      obstacle.shape = obstacle.motion.front();
    }
    obstacles.push_back(std::move(obstacle));
  }
  return obstacles;
}

}  // namespace bqsa::harness
