#include "harness/scenario/path_reader.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/numeric_csv.hpp"

namespace bqsa::harness {
namespace {

namespace fs = std::filesystem;

constexpr double kMinDuration = 1e-3;  // [s]
constexpr double kMaxDuration = 1e6;   // [s]
constexpr int kMaxTicks = 1'000'000;
constexpr std::size_t kMaxWaypoints = 100'000;
constexpr std::size_t kMaxWaypointBytes = 100 * kMaxWaypoints;  // four numbers of all digits a line

Arc read_ellipse_arc(const YamlValue& value, const Units& units, int dimension) {
  if (dimension != 2) {
    value.get("kind", "").fail("circle, line, polyline or waypoints, since the robot is spatial");
  }
  value.expect_keys({"kind", "center", "semi_axes", "rotation", "from", "to"});
  const Eigen::VectorXd semi_axes =
      units.positive_lengths(value.get("semi_axes", "2 positive lengths"), 2);
  const std::optional<YamlValue> given = value.find("rotation");
  const double rotation = given ? units.angle(*given) : 0.0;
  const Eigen::Vector3d x_axis(std::cos(rotation), std::sin(rotation), 0);
  const Eigen::Vector3d y_axis(-std::sin(rotation), std::cos(rotation), 0);
  return {.center = units.point(value.get("center", "a point"), dimension),
          .u = semi_axes(0) * x_axis,
          .v = semi_axes(1) * y_axis,
          .from = units.angle(value.get("from", "an angle")),
          .to = units.angle(value.get("to", "an angle"))};
}

Arc read_circle(const YamlValue& value, const Units& units, int dimension) {
  value.expect_keys({"kind", "center", "radius", "axis_u", "axis_v", "from", "to"});
  const double radius = units.positive_length(value.get("radius", "a positive length"));
  const Eigen::Vector3d u = read_unit_vector(value.get("axis_u", "a unit vector"), dimension);
  const YamlValue axis_v = value.get("axis_v", "a unit vector");
  const Eigen::Vector3d v = read_unit_vector(axis_v, dimension);
  if (std::abs(u.dot(v)) > kUnitTolerance) {
    axis_v.fail("a unit vector orthogonal to axis_u",
                fmt::format("one at {:g} degrees to it", std::acos(u.dot(v)) * 180 / EIGEN_PI));
  }
  const Eigen::Vector3d v_orthogonal = (v - u.dot(v) * u).normalized();
  return {.center = units.point(value.get("center", "a point"), dimension),
          .u = radius * u,
          .v = radius * v_orthogonal,
          .from = units.angle(value.get("from", "an angle")),
          .to = units.angle(value.get("to", "an angle"))};
}

Polyline read_line(const YamlValue& value, const Units& units, int dimension) {
  value.expect_keys({"kind", "start_point", "end_point"});
  return constant_speed({units.point(value.get("start_point", "a point"), dimension),
                         units.point(value.get("end_point", "a point"), dimension)});
}

Polyline read_polyline(const YamlValue& value, const Units& units, int dimension) {
  value.expect_keys({"kind", "points"});
  const YamlValue list = value.get("points", "a list of points");
  std::vector<Eigen::Vector3d> points;
  for (const YamlValue& element : list.list("a list of points")) {
    points.push_back(units.point(element, dimension));
  }
  if (points.size() < 2) list.fail("a list of 2 or more points");
  return constant_speed(std::move(points));
}

/// The file that a scenario names, which must lie in the scenario's directory or below.
fs::path file_beside(const YamlValue& value, const fs::path& directory) {
  const fs::path name = value.text();
  std::error_code error;
  const fs::path home = fs::weakly_canonical(directory.empty() ? "." : directory, error);
  const fs::path target = error ? fs::path() : fs::weakly_canonical(home / name, error);
  const fs::path inside = error ? fs::path() : target.lexically_relative(home);
  if (error || name.is_absolute() || inside.empty() || inside == "." || *inside.begin() == "..") {
    value.fail("a file in the scenario's directory");
  }
  return directory / name;
}

/// CSV `t,x,y[,z]` in seconds and the scenario's unit of length, from t = 0 to t = duration.
Polyline read_waypoints(const YamlValue& value, const Units& units, int dimension,
                        const fs::path& directory, double duration) {
  value.expect_keys({"kind", "file"});
  const fs::path file = file_beside(value.get("file", "a CSV file"), directory);
  const NumericTable table =
      read_numeric_csv(file, dimension == 2 ? "t,x,y" : "t,x,y,z", kMaxWaypointBytes);
  const auto fail = [&file](std::size_t row, const std::string& column, const std::string& expected,
                            const std::string& got) {
    throw InputError(fmt::format("{}:{}: {}: expected {}, got {}", file.string(),
                                 NumericTable::line(row), column, expected, got));
  };
  if (table.rows() > kMaxWaypoints) {
    fail(kMaxWaypoints, "t", fmt::format("at most {} waypoints", kMaxWaypoints),
         std::to_string(table.rows()));
  }
  if (table.rows() < 2) {
    fail(table.rows(), "t", "2 or more waypoints", std::to_string(table.rows()));
  }
  constexpr double kTimeTolerance = 1e-9;  // of the duration, for times written with few digits
  Polyline line;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double t = table(row, 0);
    if (!std::isfinite(t)) fail(row, "t", "a finite number", fmt::format("{}", t));
    if (row == 0 && t != 0) fail(row, "t", "0 for the first waypoint", fmt::format("{:g}", t));
    if (row > 0 && !(t > table(row - 1, 0))) {
      fail(row, "t", fmt::format("a time after {:g}", table(row - 1, 0)), fmt::format("{:g}", t));
    }
    const bool last = row + 1 == table.rows();
    if (last && std::abs(t - duration) > kTimeTolerance * duration) {
      fail(row, "t", fmt::format("the task's duration {:g} for the last waypoint", duration),
           fmt::format("{:g}", t));
    }
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (int axis = 0; axis < dimension; ++axis) {
      const double coordinate = table(row, static_cast<std::size_t>(axis) + 1);
      const std::string column(1, "xyz"[axis]);
      if (!std::isfinite(coordinate)) {
        fail(row, column, "a finite number", fmt::format("{}", coordinate));
      }
      p(axis) = coordinate / units.per_metre;
      if (std::abs(p(axis)) > kMaxLength) {
        fail(row, column, "a length of at most " + units.show(kMaxLength), units.show(p(axis)));
      }
    }
    line.points.push_back(p);
    line.knots.push_back(last ? 1.0 : std::min(t / duration, 1.0));
  }
  return line;
}

Path read_path(const YamlValue& value, const Units& units, int dimension, const fs::path& directory,
               double duration) {
  const std::string kind = value.get("kind", "the kind of the path")
                               .choice({"ellipse_arc", "circle", "line", "polyline", "waypoints"});
  if (kind == "ellipse_arc") return read_ellipse_arc(value, units, dimension);
  if (kind == "circle") return read_circle(value, units, dimension);
  if (kind == "line") return read_line(value, units, dimension);
  if (kind == "polyline") return read_polyline(value, units, dimension);
  return read_waypoints(value, units, dimension, directory, duration);
}

}  // namespace

Task read_task(const YamlValue& value, const Units& units, int dimension,
               const fs::path& directory) {
  value.expect_keys({"path", "timing"});
  const YamlValue timing = value.get("timing", "a mapping of duration, ticks, profile");
  timing.expect_keys({"duration", "ticks", "profile"});
  const YamlValue duration = timing.get("duration", "a time in seconds");
  Task task;
  task.duration = duration.number();
  if (!(task.duration > 0)) duration.fail("a positive time in seconds");
  if (task.duration < kMinDuration || task.duration > kMaxDuration) {
    duration.fail(fmt::format("a time from {:g} to {:g} seconds", kMinDuration, kMaxDuration));
  }
  task.ticks = timing.get("ticks", "a whole number").whole_number(1, kMaxTicks);

  const YamlValue path = value.get("path", "a mapping with a kind");
  task.path = read_path(path, units, dimension, directory, task.duration);
  if (const std::optional<YamlValue> profile = timing.find("profile")) {
    const bool linear = profile->choice({"linear", "quintic"}) == "linear";
    if (!linear && path.has("file")) profile->fail("linear, since waypoints carry their own times");
    task.profile = linear ? Profile::kLinear : Profile::kQuintic;
  }
  return task;
}

}  // namespace bqsa::harness
