/// @file
/// The arms that problems are generated for.
#pragma once

#include <Eigen/Core>

#include "bqsa/problem.hpp"

namespace bqsa::harness {

/// An arm with the region in which its problems begin.
struct Arm {
  ChainDescription chain;
  JointLimits limits = {};
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< a point that no joint moves [m]
  double reach = 0;             ///< largest distance of the tip from it, within the limits [m]
  JointVector start_low = {};   ///< start angles are drawn uniformly between these [rad]
  JointVector start_high = {};  ///< [rad]
};

/// Links of equal length, kPlanarReach in all, joint angles unlimited.
Arm planar_arm(int links);

inline constexpr double kPlanarReach = 2.8;  ///< as the arm of scenarios/planar_7r.yaml [m]

}  // namespace bqsa::harness
