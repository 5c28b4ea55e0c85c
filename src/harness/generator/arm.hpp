/// @file
/// The arms that problems are generated for.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "bqsa/problem.hpp"
#include "harness/generator/random_stream.hpp"

namespace bqsa::harness {

/// An arm with the region in which its problems begin.
struct Arm {
  ChainDescription chain;
  JointLimits limits = {};
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< a point that no joint moves [m]
  double reach = 0;  ///< largest distance of the tip from it, within the limits [m]
  std::vector<double> link_radii = {};  ///< none: links have no radius [m]
  JointVector start_low = {};           ///< start angles are drawn uniformly between these [rad]
  JointVector start_high = {};          ///< [rad]
  std::string name = {};                ///< that its problems have; none: they name no robot
};

/// Links of equal length, kPlanarReach in all, joint angles unlimited, every joint as fast as
/// kPlanarSpeed.
Arm planar_arm(int links);

inline constexpr double kPlanarReach = 2.8;       ///< as the arm of scenarios/planar_7r.yaml [m]
inline constexpr double kPlanarSpeed = 0.785398;  ///< 45 degrees a second [rad/s]

/// The arms of spatial families, in turn: KUKA LBR iiwa 14 and Franka Panda, whose problems do not name
/// them.
/// @param robots  directory that holds kuka_lbr_iiwa14.yaml and franka_panda.yaml
/// @throws InputError if one of the files cannot be used
std::vector<Arm> spatial_arms(const std::filesystem::path& robots);

inline constexpr double kGripper = 0.15;  ///< from the flange to the tip of real arms [m]

/// All arms of robots/ in turn, with the names in their files, each with a gripper and links of nominal radii.
/// @param robots  directory that holds their files
/// @throws InputError if one of the files cannot be used
std::vector<Arm> real_arms(const std::filesystem::path& robots);

/// Six to eight revolute joints: with even chances, links lie along a joint's axis or across it, and
/// axes are parallel or at right angles; 0.9 to 1.4 m in all.
Arm random_arm(RandomStream& random);

}  // namespace bqsa::harness
