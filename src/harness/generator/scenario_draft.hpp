/// @file
/// A scenario as plain numbers: written as a file, and made into the problem that the file holds.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "bqsa/problem.hpp"
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

struct ObstacleDraft {
  std::string name = {};
  Eigen::Vector3d center;     ///< at t = 0 [m]
  Eigen::Vector3d semi_axes;  ///< planar: two, and the larger of them again [m]
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
  JointVector start = {};  ///< [rad]
  PathDraft path = {};
  double duration = 0;  ///< [s]
  int ticks = 0;
  std::vector<ObstacleDraft> obstacles = {};
};

/// The shape of an obstacle at time t [s].
Ellipsoid shape_at(const ObstacleDraft& obstacle, int dimension, double t);

/// The obstacle as the loader makes it from the file.
Obstacle to_obstacle(const ObstacleDraft& draft, int dimension, int ticks, double dt);

/// The problem as the loader makes it from the file.
Problem to_problem(const ScenarioDraft& draft);

/// The file of schema bqsa-scenario/1, in metres and radians.
std::string to_yaml(const ScenarioDraft& draft);

}  // namespace bqsa::harness
