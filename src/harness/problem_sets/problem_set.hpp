/// @file
/// Published sets of planning problems: files of VAMP (MotionBenchMaker) and of Robometrics.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "bqsa/kinematics/serial_chain.hpp"

namespace bqsa::harness {

/// An obstacle of a set, in the frame of the robot's base.
struct SetObstacle {
  enum class Kind { kBox, kCylinder, kSphere };

  std::string name;
  Kind kind = Kind::kBox;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector4d rotation{1, 0, 0, 0};              ///< unit quaternion (w, x, y, z)
  Eigen::Vector3d size = Eigen::Vector3d::Zero();    ///< box: edges [m]
  double radius = 0;                                 ///< cylinder, sphere [m]
  double length = 0;                                 ///< cylinder: along its z [m]
};

/// From one configuration to any of several others, past obstacles.
struct PlanningProblem {
  std::string group;  ///< the scene it belongs to, as the set calls it
  int index = 0;      ///< in the group
  std::vector<SetObstacle> obstacles = {};
  JointVector start = {};               ///< joint values, as the set gives them [rad or m]
  std::vector<JointVector> goals = {};  ///< at least one
};

/// Reads a set, whichever of the formats it has:
///
/// - **VAMP** (`problems.json`, as its resources/problem_tar_to_pkl_json.py makes them of the sets of
///   MotionBenchMaker): `{robot, joints, problems: {GROUP: [{index, start, goals, box: [{name,
///   position, orientation_quat_xyzw, half_extents}], cylinder: [{..., radius, length}], sphere:
///   [{name, position, radius}]}]}}`.
/// - **Robometrics** (`*_set.yaml`): `{GROUP: [{start, goal_ik, obstacles: {cuboid: {NAME: {dims,
///   pose}}, cylinder: {NAME: {radius, height, pose}}, sphere: {NAME: {radius, pose | position}}}}]}`, poses as
///   `[x, y, z, qw, qx, qy, qz]`.
///
/// Metres and radians. Other keys are passed over, other kinds of obstacles are refused: a problem
/// without them would be another one.
/// @throws InputError naming file, line, key, what was expected and what was found
std::vector<PlanningProblem> read_problem_set(const std::filesystem::path& file);

}  // namespace bqsa::harness
