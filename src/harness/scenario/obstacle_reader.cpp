#include "harness/scenario/obstacle_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "harness/scenario/envelope_reader.hpp"
#include "harness/scenario/motion_reader.hpp"
#include "harness/scenario/solid_reader.hpp"

namespace bqsa::harness {
namespace {

constexpr std::size_t kMaxObstacles = 1000;

/// Moving obstacles times ticks: a state of an obstacle takes 200 bytes.
constexpr std::size_t kMaxStates = 1'000'000;

constexpr std::size_t kMaxCorners = 20'000;

/// Largest ratio of two semi-axes. Up to here the judge's two checkers were seen to agree.
constexpr double kMaxAxisRatio = 1e6;

constexpr std::array<std::string_view, 7> kSpatialKinds = {
    "ellipsoid", "sphere", "box", "cylinder", "capsule", "mesh", "points"};

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
  const std::optional<Eigen::Matrix3d> rotation = find_rotation(value, units);
  return {Ellipsoid(center, semi_axes, rotation.value_or(Eigen::Matrix3d::Identity())),
          rotation.has_value()};
}

RestingObstacle read_sphere(const YamlValue& value, const Units& units) {
  value.expect_keys({"name", "kind", "center", "radius", "motion"});
  const double radius = units.positive_length(value.get("radius", "a positive length"));
  const Eigen::Vector3d center = units.point(value.get("center", "a point"), 3);
  return {Ellipsoid(center, Eigen::Vector3d::Constant(radius)), false};
}

std::string read_kind(const YamlValue& kind, int dimension) {
  if (dimension == 2) {
    for (const std::string_view word : kSpatialKinds) {
      if (kind.is(word)) kind.fail("ellipse, since the robot is planar");
    }
    return kind.choice({"ellipse"});
  }
  if (kind.is("ellipse")) {
    kind.fail("ellipsoid, sphere or a solid, since the robot is spatial");
  }
  return kind.choice({"ellipsoid", "sphere", "box", "cylinder", "capsule", "mesh", "points"});
}

bool is_solid(std::string_view kind) {
  return kind != "ellipse" && kind != "ellipsoid" && kind != "sphere";
}

RestingObstacle read_shape(const YamlValue& value, std::string_view kind, const Units& units) {
  if (kind == "ellipse") return read_ellipse(value, units);
  return kind == "sphere" ? read_sphere(value, units) : read_ellipsoid(value, units);
}

Cover cover_of(const YamlValue& value, const Solid& part, const CoverSettings& settings) {
  try {
    return cover(part, settings);
  } catch (const std::invalid_argument& error) {
    value.fail("a solid that ellipsoids can be put around", error.what());
  }
}

/// Ellipsoids around all parts of a solid.
std::vector<Ellipsoid> envelope_of(const YamlValue& value, const std::vector<Solid>& parts,
                                   const CoverSettings& settings, LedgerEntry& entry) {
  std::vector<Ellipsoid> ellipsoids;
  double volumes = 0, of_ellipsoids = 0;
  for (const Solid& part : parts) {
    const Cover covered = cover_of(value, part, settings);
    ellipsoids.insert(ellipsoids.end(), covered.ellipsoids.begin(), covered.ellipsoids.end());
    if (ellipsoids.size() > kMaxObstacles) break;
    entry.inflation = std::max(entry.inflation, covered.inflation);
    entry.within_bounds = entry.within_bounds && covered.within_bounds;
    volumes += volume(part);
  }
  for (const Ellipsoid& ellipsoid : ellipsoids) {
    const double ratio = ellipsoid.semi_axes().maxCoeff() / ellipsoid.semi_axes().minCoeff();
    if (ratio > kMaxAxisRatio * (1 + 1e-9)) {
      value.fail(fmt::format("a solid within ellipsoids of which the longest semi-axis is at most "
                             "{:g} times the shortest (envelope.least_semi_axis sets a least one)",
                             kMaxAxisRatio),
                 fmt::format("{:g} times", ratio));
    }
    of_ellipsoids += 4 * std::numbers::pi / 3 * ellipsoid.semi_axes().prod();
  }
  entry.ellipsoids = static_cast<int>(ellipsoids.size());
  entry.volume_ratio = of_ellipsoids / volumes;
  return ellipsoids;
}

/// Reads one obstacle after the other.
class ObstacleList {
 public:
  ObstacleList(const Units& units, int dimension, const Task& task, const CoverSettings& envelope,
               NamedFiles& files)
      : units_(units), dimension_(dimension), task_(task), envelope_(envelope), files_(files) {}

  void add(const YamlValue& element) {
    const YamlValue name = element.get("name", "a name");
    if (!names_.insert(name.name()).second) name.fail("a name that no other obstacle has");
    const std::string kind = read_kind(element.get("kind", "the kind of the obstacle"), dimension_);
    result_.truth.push_back({.name = name.name(), .first = static_cast<int>(result_.told.size())});
    if (is_solid(kind)) {
      add_solid(element, kind);
    } else {
      expect_room(element, 1);
      if (element.has("motion")) expect_states(element, 1);
      add_told(name.name(), read_shape(element, kind, units_), element.find("motion"));
    }
  }

  ScenarioObstacles result() { return std::move(result_); }

 private:
  void add_solid(const YamlValue& element, const std::string& kind) {
    TrueObstacle& obstacle = result_.truth.back();
    SolidDescription solid = read_solid(element, kind, units_, files_);
    expect_corners(element, solid.parts);
    const std::optional<YamlValue> motion = element.find("motion");
    if (motion) expect_straight(*motion);
    LedgerEntry entry{.name = obstacle.name,
                      .kind = kind,
                      .parts = static_cast<int>(solid.parts.size()),
                      .hull_over_mesh = solid.hull_over_mesh};
    const CoverSettings settings = read_envelope(element.find("envelope"), units_, envelope_);
    const std::vector<Ellipsoid> ellipsoids = envelope_of(element, solid.parts, settings, entry);
    expect_room(element, ellipsoids.size());
    if (motion) expect_states(element, ellipsoids.size());
    obstacle.parts = std::move(solid.parts);
    obstacle.count = entry.ellipsoids;
    for (std::size_t k = 0; k < ellipsoids.size(); ++k) {
      const std::string name =
          ellipsoids.size() == 1 ? obstacle.name : fmt::format("{}#{}", obstacle.name, k + 1);
      add_told(name, {ellipsoids[k], false}, motion);
    }
    result_.ledger.push_back(std::move(entry));
  }

  /// All pieces of a solid that does not turn go the same way.
  static void expect_straight(const YamlValue& motion) {
    motion.get("kind", "the kind of the motion").choice({"linear"}, {"waypoints"});
    if (const std::optional<YamlValue> spin = motion.find("angular_velocity")) {
      spin->fail("a solid that does not turn", "one that does, which is not supported yet");
    }
  }

  /// Each reading of the judge looks at all corners of a hull.
  void expect_corners(const YamlValue& element, const std::vector<Solid>& parts) {
    for (const Solid& part : parts) {
      if (const auto* const hull = std::get_if<ConvexHull>(&part))
        corners_ += hull->vertices.size();
    }
    if (corners_ <= kMaxCorners) return;
    element.fail(
        fmt::format("meshes and points with hulls of at most {} corners in all", kMaxCorners),
        fmt::format("{} with this one", corners_));
  }

  void expect_room(const YamlValue& element, std::size_t ellipsoids) const {
    if (result_.told.size() + ellipsoids <= kMaxObstacles) return;
    element.fail(fmt::format("at most {} ellipsoids around all obstacles", kMaxObstacles),
                 fmt::format("{} or more with this one", result_.told.size() + ellipsoids));
  }

  void expect_states(const YamlValue& element, std::size_t pieces) {
    moving_pieces_ += pieces;
    if (moving_pieces_ * static_cast<std::size_t>(task_.ticks) <= kMaxStates) return;
    element.fail(fmt::format("moving ellipsoids times ticks of at most {}", kMaxStates),
                 fmt::format("{} times {}", moving_pieces_, task_.ticks));
  }

  void add_told(const std::string& name, const RestingObstacle& at_rest,
                const std::optional<YamlValue>& motion) {
    Obstacle obstacle{name, at_rest.shape};
    if (motion) {
      obstacle.motion = read_motion(*motion, at_rest, units_, dimension_, task_, files_);
      obstacle.shape = obstacle.motion.front();
    }
    result_.told.push_back(std::move(obstacle));
  }

  const Units& units_;
  int dimension_;
  const Task& task_;
  const CoverSettings& envelope_;
  NamedFiles& files_;
  std::set<std::string> names_;
  std::size_t moving_pieces_ = 0;
  std::size_t corners_ = 0;  // of hulls
  ScenarioObstacles result_;
};

}  // namespace

ScenarioObstacles read_obstacles(const std::optional<YamlValue>& value, const Units& units,
                                 int dimension, const Task& task, const CoverSettings& envelope,
                                 NamedFiles& files) {
  if (!value) return {};
  const std::vector<YamlValue> elements = value->list("a list of obstacles");
  if (elements.size() > kMaxObstacles) {
    value->fail(fmt::format("at most {} obstacles", kMaxObstacles),
                std::to_string(elements.size()));
  }
  const auto moving = static_cast<std::size_t>(
      std::count_if(elements.begin(), elements.end(),
                    [](const YamlValue& element) { return element.has("motion"); }));
  const std::size_t states = moving * static_cast<std::size_t>(task.ticks);
  if (states > kMaxStates) {
    value->fail(fmt::format("moving obstacles times ticks of at most {}", kMaxStates),
                fmt::format("{} times {}", moving, task.ticks));
  }
  ObstacleList list(units, dimension, task, envelope, files);
  for (const YamlValue& element : elements) list.add(element);
  return list.result();
}

}  // namespace bqsa::harness
