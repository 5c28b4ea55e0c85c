#include "harness/scenario/motion_reader.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>

namespace bqsa::harness {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Longest time of a waypoint, before or after t = 0 [s].
constexpr double kMaxTime = 1e6;

/// How far a waypoint file may be from the obstacle's keys at t = 0 [m] and [rad].
constexpr double kSamePlace = 1e-6;

constexpr double kHalfTurn = std::numbers::pi;

/// About z by `angle`, all else exactly 0 and 1: what is planar stays so.
Matrix3d turn_in_the_plane(double angle) {
  Matrix3d R = Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(angle).toRotationMatrix();
  return R;
}

double time_of(int tick, const Task& task) { return tick * (task.duration / task.ticks); }

/// Angle per second about a fixed direction of W [rad/s].
Vector3d read_angular_velocity(const YamlValue& value, const Units& units, int dimension) {
  Vector3d w = Vector3d::Zero();
  if (dimension == 2) {
    w.z() = units.angle(value);
    return w;
  }
  int axis = 0;
  for (const YamlValue& element : value.list("an angular velocity [x, y, z]", 3)) {
    w(axis++) = units.angle(element);
  }
  return w;
}

std::vector<Ellipsoid> read_linear(const YamlValue& value, const Ellipsoid& shape,
                                   const Units& units, int dimension, const Task& task) {
  value.expect_keys({"kind", "velocity", "angular_velocity"});
  const YamlValue velocity_value = value.get("velocity", "a velocity");
  const Vector3d velocity = units.point(velocity_value, dimension);
  const Vector3d end = shape.center() + task.duration * velocity;
  if (end.cwiseAbs().maxCoeff() > kMaxLength) {
    velocity_value.fail("a motion to coordinates of at most " + units.show(kMaxLength),
                        "one to " + units.show(end, dimension));
  }
  Vector3d spin = Vector3d::Zero();
  if (const std::optional<YamlValue> given = value.find("angular_velocity")) {
    spin = read_angular_velocity(*given, units, dimension);
    const double turn = spin.norm() * (task.duration / task.ticks);
    if (!(turn < kHalfTurn)) {
      given->fail("less than half a turn between two ticks", units.show_angle(turn));
    }
    if (spin.norm() * task.duration > kMaxAngle) {
      given->fail(fmt::format("a turn of at most {} in all", units.show_angle(kMaxAngle)),
                  units.show_angle(spin.norm() * task.duration));
    }
  }
  const Vector3d axis = spin.norm() > 0 ? Vector3d(spin.normalized()) : Vector3d::UnitZ();
  std::vector<Ellipsoid> states;
  states.reserve(static_cast<std::size_t>(task.ticks) + 1);
  for (int tick = 0; tick <= task.ticks; ++tick) {
    const double t = time_of(tick, task);
    const Matrix3d turn =
        dimension == 2 ? turn_in_the_plane(t * spin.z())
                       : Matrix3d(Eigen::AngleAxisd(t * spin.norm(), axis).toRotationMatrix());
    states.emplace_back(shape.center() + t * velocity, shape.semi_axes(), turn * shape.rotation());
  }
  return states;
}

/// A row of a waypoint file: a place and, where the file has them, angles.
struct Waypoint {
  double t = 0;                        // [s]
  Vector3d center = Vector3d::Zero();  // [m]
  Vector3d angles = Vector3d::Zero();  // about the fixed axes x, y, z; in the plane the last [rad]
};

struct WaypointMotion {
  std::vector<Waypoint> waypoints;
  bool has_angles = false;

  /// In between, places and angles change evenly; before the first and after the last they stay.
  Waypoint at(double t) const {
    const auto above = std::upper_bound(waypoints.begin(), waypoints.end(), t,
                                        [](double time, const Waypoint& w) { return time < w.t; });
    if (above == waypoints.begin()) return waypoints.front();
    if (above == waypoints.end()) return waypoints.back();
    const Waypoint& next = *above;
    const Waypoint& last = *(above - 1);
    const double part = (t - last.t) / (next.t - last.t);
    return {t, (1 - part) * last.center + part * next.center,
            (1 - part) * last.angles + part * next.angles};
  }
};

Matrix3d rotation_of(const Vector3d& angles, int dimension) {
  return dimension == 2 ? turn_in_the_plane(angles.z())
                        : rotation_of_rpy(angles.x(), angles.y(), angles.z());
}

WaypointMotion read_file(const YamlValue& value, const Units& units, int dimension,
                         NamedFiles& files) {
  const bool planar = dimension == 2;
  const WaypointFile file(value, files,
                          planar ? std::vector<std::string>{"t,x,y", "t,x,y,angle"}
                                 : std::vector<std::string>{"t,x,y,z", "t,x,y,z,r,p,y"});
  const auto first_angle = static_cast<std::size_t>(dimension) + 1;
  WaypointMotion motion{{}, file.columns() > first_angle};
  for (std::size_t row = 0; row < file.rows(); ++row) {
    Waypoint waypoint{file.time(row), file.point(row, dimension, units), Vector3d::Zero()};
    if (std::abs(waypoint.t) > kMaxTime) {
      file.fail(row, "t", fmt::format("a time of at most {:g} s", kMaxTime),
                fmt::format("{:g}", waypoint.t));
    }
    if (motion.has_angles && planar) {
      waypoint.angles.z() = file.angle(row, first_angle, "angle", units);
    } else if (motion.has_angles) {
      for (int axis = 0; axis < 3; ++axis) {
        waypoint.angles(axis) = file.angle(row, first_angle + static_cast<std::size_t>(axis),
                                           std::string(1, "rpy"[axis]), units);
      }
    }
    motion.waypoints.push_back(waypoint);
  }
  return motion;
}

void check_beginning(const YamlValue& file, const RestingObstacle& obstacle,
                     const WaypointMotion& motion, const Units& units, int dimension) {
  const Waypoint start = motion.at(0);
  const Vector3d& center = obstacle.shape.center();
  if ((start.center - center).norm() > kSamePlace) {
    file.fail("waypoints that agree with the obstacle's center " + units.show(center, dimension) +
                  " at t = 0",
              units.show(start.center, dimension));
  }
  if (!motion.has_angles || !obstacle.turned) return;
  const Matrix3d R = rotation_of(start.angles, dimension);
  const double turn =
      Eigen::AngleAxisd(Matrix3d(R.transpose() * obstacle.shape.rotation())).angle();
  if (turn > kSamePlace) {
    file.fail("waypoints that agree with the obstacle's rotation at t = 0",
              "one that is turned by " + units.show_angle(turn));
  }
}

std::vector<Ellipsoid> read_waypoints(const YamlValue& value, const RestingObstacle& obstacle,
                                      const Units& units, int dimension, const Task& task,
                                      NamedFiles& files) {
  value.expect_keys({"kind", "file"});
  const YamlValue file = value.get("file", "a CSV file");
  const WaypointMotion motion = read_file(file, units, dimension, files);
  check_beginning(file, obstacle, motion, units, dimension);
  std::vector<Ellipsoid> states;
  states.reserve(static_cast<std::size_t>(task.ticks) + 1);
  Vector3d last_angles = motion.at(0).angles;
  for (int tick = 0; tick <= task.ticks; ++tick) {
    const Waypoint state = motion.at(time_of(tick, task));
    const double turn = (state.angles - last_angles).lpNorm<1>();
    if (!(turn < kHalfTurn)) {
      file.fail("angles that change by less than half a turn between two ticks, all together",
                fmt::format("{} before t = {:.4g} s", units.show_angle(turn), time_of(tick, task)));
    }
    last_angles = state.angles;
    const Matrix3d rotation =
        motion.has_angles ? rotation_of(state.angles, dimension) : obstacle.shape.rotation();
    states.emplace_back(state.center, obstacle.shape.semi_axes(), rotation);
  }
  return states;
}

}  // namespace

std::vector<Ellipsoid> read_motion(const YamlValue& value, const RestingObstacle& obstacle,
                                   const Units& units, int dimension, const Task& task,
                                   NamedFiles& files) {
  const std::string kind =
      value.get("kind", "the kind of the motion").choice({"linear", "waypoints"});
  if (kind == "linear") return read_linear(value, obstacle.shape, units, dimension, task);
  return read_waypoints(value, obstacle, units, dimension, task, files);
}

}  // namespace bqsa::harness
