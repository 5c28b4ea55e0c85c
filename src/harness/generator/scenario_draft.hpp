/// @file
/// A scenario as plain numbers: written as a file, and made into the problem that the file holds.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "bqsa/envelope/solid.hpp"
#include "bqsa/problem.hpp"
#include "harness/judge/true_obstacle.hpp"
#include "harness/scenario/path.hpp"

namespace bqsa::harness {

/// The nearest number of six decimals: what is written of a number, and all that is used of it. The
/// last bits of a computation, which differ from machine to machine, do not survive it.
double rounded(double number);

/// The same of each component.
template <typename Vector>
Vector rounded(Vector numbers) {
  for (double& number : numbers) number = rounded(number);
  return numbers;
}

struct LineDraft {
  Eigen::Vector3d from;  ///< [m]
  Eigen::Vector3d to;    ///< [m]
};

/// center + radius (cos(a) axis_u + sin(a) axis_v), a from 0 to `turn`.
struct CircleDraft {
  Eigen::Vector3d center;  ///< [m]
  double radius = 0;       ///< [m]
  Eigen::Vector3d axis_u;  ///< unit vector to the start
  Eigen::Vector3d axis_v;  ///< unit vector orthogonal to it
  double turn = 0;         ///< [rad]
};

using PathDraft = std::variant<LineDraft, CircleDraft>;

/// Where and how an obstacle moves: evenly along a line and about its centre.
struct MotionDraft {
  Eigen::Vector3d velocity;          ///< [m/s]
  Eigen::Vector3d angular_velocity;  ///< [rad/s]; planar: about z
};

enum class ShapeKind { kEllipsoid, kSphere, kBox, kCylinder, kCapsule };

/// Whether methods are told of something else, an envelope.
inline bool is_solid(ShapeKind kind) {
  return kind != ShapeKind::kEllipsoid && kind != ShapeKind::kSphere;
}

struct ObstacleDraft {
  std::string name = {};
  ShapeKind kind = ShapeKind::kEllipsoid;
  Eigen::Vector3d center;  ///< at t = 0 [m]

  /// How far the shape extends along its own axes either way; planar: two, and the larger of them
  /// again. Of a sphere all are the same, of a cylinder and a capsule the first two [m].
  Eigen::Vector3d semi_axes;
  Eigen::Vector4d
      rotation;  ///< at t = 0: quaternion (w, x, y, z), or for planar (angle, 0, 0, 0) [rad]
  std::optional<MotionDraft> motion = {};
};

/// All numbers of six decimals (`rounded`), but for those of the robot.
struct ScenarioDraft {
  std::string name = {};
  std::string description = {};
  ChainDescription robot;
  JointLimits limits = {};
  std::vector<double> link_radii = {};  ///< none: links have no radius [m]
  std::string robot_name = {};          ///< of a spatial robot; none: the file names no robot
  JointVector start = {};               ///< [rad]
  PathDraft path = {};
  double duration = 0;  ///< [s]
  int ticks = 0;
  std::vector<ObstacleDraft> obstacles = {};
  std::optional<double> reference_clearance = {};  ///< key of that name [m]
};

/// The ellipsoid or sphere of an obstacle at time t [s].
Ellipsoid shape_at(const ObstacleDraft& obstacle, int dimension, double t);

/// The obstacle as the loader makes it from the file; of ellipsoids and spheres.
Obstacle to_obstacle(const ObstacleDraft& draft, int dimension, int ticks, double dt);

/// The obstacle as the loader makes it from the file; of the other kinds.
Solid to_solid(const ObstacleDraft& draft);

/// The problem as the loader makes it from the file, but with one ellipsoid around each solid, where the
/// loader may make several.
Problem to_problem(const ScenarioDraft& draft);

/// What the judge goes by in that problem.
std::vector<TrueObstacle> to_truth(const ScenarioDraft& draft);

/// The file of schema bqsa-scenario/1, in metres and radians.
std::string to_yaml(const ScenarioDraft& draft);

}  // namespace bqsa::harness
