#include "harness/scenario/path_reader.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace bqsa::harness {
namespace {

constexpr double kMinDuration = 1e-3;  // [s]
constexpr double kMaxDuration = 1e6;   // [s]
constexpr int kMaxTicks = 1'000'000;

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

/// Whether the task has an orientation that only the waypoints can say.
bool awaits_waypoints(const Turning& turning) {
  return turning.kind != TaskKind::kPosition && turning.rotations.empty();
}

/// CSV `t,x,y[,z[,qw,qx,qy,qz]]` in seconds and the scenario's unit of length, from t = 0 to t = duration.
/// The quaternions are there if the task's orientation awaits them.
Polyline read_waypoints(const YamlValue& value, const Units& units, int dimension,
                        NamedFiles& files, double duration, Turning& turning) {
  value.expect_keys({"kind", "file"});
  const bool turns = awaits_waypoints(turning);
  const std::string header = dimension == 2 ? "t,x,y" : "t,x,y,z";
  const WaypointFile file(value.get("file", "a CSV file"), files,
                          {turns ? header + ",qw,qx,qy,qz" : header});
  constexpr double kTimeTolerance = 1e-9;  // of the duration, for times written with few digits
  Polyline line;
  for (std::size_t row = 0; row < file.rows(); ++row) {
    const double t = file.time(row);
    if (row == 0 && t != 0) file.fail(row, "t", "0 for the first waypoint", fmt::format("{:g}", t));
    const bool last = row + 1 == file.rows();
    if (last && std::abs(t - duration) > kTimeTolerance * duration) {
      file.fail(row, "t", fmt::format("the task's duration {:g} for the last waypoint", duration),
                fmt::format("{:g}", t));
    }
    line.points.push_back(file.point(row, dimension, units));
    line.knots.push_back(last ? 1.0 : std::min(t / duration, 1.0));
    if (turns) add_waypoint(file, row, line.knots.back(), turning);
  }
  return line;
}

Path read_path(const YamlValue& value, const Units& units, int dimension, NamedFiles& files,
               double duration, Turning& turning) {
  const std::string kind = value.get("kind", "the kind of the path")
                               .choice({"ellipse_arc", "circle", "line", "polyline", "waypoints"});
  if (kind == "ellipse_arc") return read_ellipse_arc(value, units, dimension);
  if (kind == "circle") return read_circle(value, units, dimension);
  if (kind == "line") return read_line(value, units, dimension);
  if (kind == "polyline") return read_polyline(value, units, dimension);
  return read_waypoints(value, units, dimension, files, duration, turning);
}

}  // namespace

Task read_task(const YamlValue& value, const Units& units, int dimension, NamedFiles& files) {
  value.expect_keys({"path", "timing", "orientation"});
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

  const std::optional<YamlValue> orientation = value.find("orientation");
  if (orientation) task.turning = read_orientation(*orientation, units, dimension);
  const YamlValue path = value.get("path", "a mapping with a kind");
  task.path = read_path(path, units, dimension, files, task.duration, task.turning);
  if (awaits_waypoints(task.turning)) {
    orientation->fail("rpy, quaternion, or from and to, since the path has no waypoints", "none");
  }
  if (const std::optional<YamlValue> profile = timing.find("profile")) {
    const bool linear = profile->choice({"linear", "quintic"}) == "linear";
    if (!linear && path.has("file")) profile->fail("linear, since waypoints carry their own times");
    task.profile = linear ? Profile::kLinear : Profile::kQuintic;
  }
  return task;
}

}  // namespace bqsa::harness
